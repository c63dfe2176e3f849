// G-buffer of one pixel: what the camera sees there, and where it was in the previous frame. Shared by
// GLSL and C++ like trace.glsl.

struct Seen {
  vec4 position;  // w: distance, < 0 where nothing is seen
  vec4 normal;    // w: roughness
  vec4 albedo;    // w: material
  int motion_x;   // in 1/256 pixel; -32768: unknown
  int motion_y;
};

int fixed_point(float pixels) {
  float scaled = floor(pixels * 256.0f + 0.5f);
  return scaled > 32767.0f ? 32767 : scaled < -32767.0f ? -32767 : int(scaled);
}

Seen see(int x, int y) {
  Seen seen;
  seen.position = vec4(0.0f, 0.0f, 0.0f, -1.0f);
  seen.normal = vec4(0.0f, 0.0f, 0.0f, 0.0f);
  seen.albedo = vec4(0.0f, 0.0f, 0.0f, 0.0f);
  seen.motion_x = -32768;
  seen.motion_y = -32768;
  vec3 direction = camera_direction(float(x), float(y));
  Hit hit = intersect(xyz(eye), direction, 1.0e30f);
  if (hit.primitive < 0) return seen;
  Surface surface = surface_at(xyz(eye), direction, hit);
  vec4 first = scene[4 * hit.primitive];
  vec4 second = scene[4 * hit.primitive + 1];
  seen.position = vec4(surface.position, hit.t);
  seen.normal = vec4(surface.normal, surface.roughness);
  seen.albedo = vec4(surface.albedo, first.w == 0.0f ? second.w : second.y);
  vec3 before = xyz(eye) + direction * hit.t - xyz(previous_eye);
  float depth = dot3(before, xyz(previous_forward));
  if (depth <= 0.0001f) return seen;
  float scale = 1.0f / (depth * pixel_size2);
  float old_x = dot3(before, xyz(previous_right)) * scale + 0.5f * float(screen_width) - 0.5f;
  float old_y = dot3(before, xyz(previous_down)) * scale + 0.5f * float(screen_height) - 0.5f;
  seen.motion_x = fixed_point(float(x) - old_x);
  seen.motion_y = fixed_point(float(y) - old_y);
  return seen;
}

// The colour of a pixel whose G-buffer holds `seen`.
vec3 render(Seen seen) {
  if (seen.position.w < 0.0f) return xyz(sky);
  int material = int(seen.albedo.w);
  vec3 emission = xyz(scene[4 * primitive_count + 3 * material + 1]);
  Surface surface;
  surface.position = xyz(seen.position);
  surface.normal = xyz(seen.normal);
  surface.albedo = xyz(seen.albedo);
  surface.emission = emission;
  surface.roughness = seen.normal.w;
  vec3 outwards = unit3(xyz(eye) - surface.position);
  return emission + trace_from(surface, outwards);
}

// The mean of so many paths. The golden ratio keeps their streams apart.
vec3 render_paths(Seen seen, uint seed) {
  vec3 sum = vec3(0.0f, 0.0f, 0.0f);
  for (int path = 0; path < paths; ++path) {
    stream = seed ^ (uint(path) * 0x9E3779B9u);
    dimension = 0u;
    sum = sum + render(seen);
  }
  return sum * (1.0f / float(paths));
}

// What the sort orders by: the luminance shown, or (sort_by_light) that of the light alone, without the
// surface's own colour and emission. A texture's edge is then no edge to the sort.
float sort_luminance(Seen seen, vec3 colour) {
  if (sort_by_light == 0 || seen.position.w < 0.0f) return luminance_of(colour);
  vec3 emission = xyz(scene[4 * primitive_count + 3 * int(seen.albedo.w) + 1]);
  vec3 light = colour - emission;
  return luminance_of(vec3(light.x * (1.0f / larger(seen.albedo.x, 0.001f)), light.y * (1.0f / larger(seen.albedo.y, 0.001f)),
                           light.z * (1.0f / larger(seen.albedo.z, 0.001f))));
}
