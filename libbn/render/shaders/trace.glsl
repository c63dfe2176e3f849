// The renderer's arithmetic: camera, intersection, materials, light transport.
//
// This one text is compiled twice, as GLSL and as C++ (inside struct Tracer of plain_passes.cpp), so it keeps
// to what both languages share: no swizzles, no built-in vector functions, f on every float literal.
// Only +, -, *, 1/x, sqrt and comparisons are used, which IEEE fixes; sine and cosine are polynomials
// of our own. So a device that rounds like IEEE and is kept from contracting renders the same bits.
//
// The includer provides: scene[] (vec4, layout below), seeds' sampling through bn_sample(), the frame's
// constants, and vec3/vec4.
//
// scene[]: primitives of 4 vec4 each, then materials of 3 vec4 each, then lights of 1 vec4 each, then texels.
//   quad      (corner, 0) (edge_u, material) (edge_v, 0) (unit normal, area)
//   sphere    (centre, 1) (radius, material, 0, 0) - -
//   material  (albedo, roughness; < 0: diffuse) (emission, 0) (second albedo, texture cells along u and v packed)
//             with an image: its third is (first texel, width, height, -1)
//   light     (primitive, 0, 0, 0)
//   texel     (albedo, 0)

// --- vectors -----------------------------------------------------------------------------------

float dot3(vec3 a, vec3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
vec3 cross3(vec3 a, vec3 b) {
  return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
vec3 unit3(vec3 a) { return a * (1.0f / sqrt(dot3(a, a))); }
float larger(float a, float b) { return a > b ? a : b; }

struct Pair {
  float sine;
  float cosine;
};

// Sine and cosine of `turn` whole turns, 0 <= turn < 1. Error below 1e-6: a direction needs no more.
Pair sine_cosine(float turn) {
  float quarters = floor(turn * 4.0f + 0.5f);
  float x = (turn * 4.0f - quarters) * 1.57079632679f;
  float x2 = x * x;
  float s = x * (1.0f + x2 * (-0.16666667f + x2 * (0.0083333310f + x2 * -0.00019840874f)));
  float c = 1.0f + x2 * (-0.5f + x2 * (0.041666642f + x2 * (-0.0013888397f + x2 * 0.000024760495f)));
  int quadrant = int(quarters) & 3;
  Pair result;
  result.sine = quadrant == 0 ? s : quadrant == 1 ? c : quadrant == 2 ? -s : -c;
  result.cosine = quadrant == 0 ? c : quadrant == 1 ? -s : quadrant == 2 ? -c : s;
  return result;
}

// From the frame whose z axis is `normal` to the world (Duff et al., "Building an orthonormal basis,
// revisited", JCGT 6(1), 2017).
vec3 to_world(vec3 local, vec3 normal) {
  float sign = normal.z >= 0.0f ? 1.0f : -1.0f;
  float a = -1.0f / (sign + normal.z);
  float b = normal.x * normal.y * a;
  vec3 tangent = vec3(1.0f + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
  vec3 bitangent = vec3(b, sign + normal.y * normal.y * a, -normal.y);
  return tangent * local.x + bitangent * local.y + normal * local.z;
}

// --- intersection --------------------------------------------------------------------------------

struct Hit {
  float t;        // along the ray; < 0: nothing
  int primitive;
  float u;        // on a quad
  float v;
};

// The nearest primitive with 0 < t < limit.
Hit intersect(vec3 origin, vec3 direction, float limit) {
  Hit hit;
  hit.t = -1.0f;
  hit.primitive = -1;
  hit.u = 0.0f;
  hit.v = 0.0f;
  float nearest = limit;
  for (int i = 0; i < primitive_count; ++i) {
    vec4 first = scene[4 * i];
    vec3 relative = origin - xyz(first);
    if (first.w == 0.0f) {
      vec4 normal = scene[4 * i + 3];
      float slope = dot3(direction, xyz(normal));
      if (slope == 0.0f) continue;
      float t = -dot3(relative, xyz(normal)) * (1.0f / slope);
      if (!(t > 0.0f && t < nearest)) continue;
      vec3 edge_u = xyz(scene[4 * i + 1]);
      vec3 edge_v = xyz(scene[4 * i + 2]);
      vec3 inside = relative + direction * t;
      float u = dot3(inside, edge_u) * (1.0f / dot3(edge_u, edge_u));  // edges are at right angles
      float v = dot3(inside, edge_v) * (1.0f / dot3(edge_v, edge_v));
      if (u < 0.0f || u > 1.0f || v < 0.0f || v > 1.0f) continue;
      nearest = t;
      hit.t = t;
      hit.primitive = i;
      hit.u = u;
      hit.v = v;
    } else {
      float radius = scene[4 * i + 1].x;
      float b = dot3(relative, direction);
      float c = dot3(relative, relative) - radius * radius;
      float root = b * b - c;
      if (root < 0.0f) continue;
      root = sqrt(root);
      float t = -b - root > 0.0f ? -b - root : -b + root;
      if (!(t > 0.0f && t < nearest)) continue;
      nearest = t;
      hit.t = t;
      hit.primitive = i;
    }
  }
  return hit;
}

// What a ray finds there.
struct Surface {
  vec3 position;   // moved off the surface to the side the ray came from
  vec3 normal;     // on that side
  vec3 albedo;
  vec3 emission;
  float roughness; // < 0: diffuse
};

Surface surface_at(vec3 origin, vec3 direction, Hit hit) {
  vec4 first = scene[4 * hit.primitive];
  vec4 second = scene[4 * hit.primitive + 1];
  bool quad = first.w == 0.0f;
  vec3 point = origin + direction * hit.t;
  vec3 normal = quad ? xyz(scene[4 * hit.primitive + 3]) : (point - xyz(first)) * (1.0f / second.x);
  if (dot3(normal, direction) > 0.0f) normal = normal * -1.0f;
  int at = 4 * primitive_count + 3 * int(quad ? second.w : second.y);
  vec4 base = scene[at];
  vec4 pattern = scene[at + 2];
  vec3 albedo = xyz(base);
  if (pattern.w > 0.0f) {
    float along_u = floor(pattern.w * (1.0f / 1024.0f));
    float along_v = pattern.w - along_u * 1024.0f;
    int cell = int(floor(hit.u * along_u)) + int(floor(hit.v * along_v));
    if ((cell & 1) != 0) albedo = xyz(pattern);
  } else if (pattern.w < 0.0f) {
    // The nearest texel; row 0 is on top, where v is 1.
    int columns = int(pattern.y);
    int rows = int(pattern.z);
    int column = int(hit.u * pattern.y);
    int row = int((1.0f - hit.v) * pattern.z);
    column = column < columns ? column : columns - 1;
    row = row < rows ? row : rows - 1;
    albedo = xyz(scene[int(pattern.x) + row * columns + column]);
  }
  Surface surface;
  surface.position = point + normal * 0.0005f;
  surface.normal = normal;
  surface.albedo = albedo;
  surface.emission = xyz(scene[at + 1]);
  surface.roughness = base.w;
  return surface;
}

// --- materials -----------------------------------------------------------------------------------

float sample_next() {
  float value = bn_sample(stream, dimension);
  dimension = dimension + 1u;
  return value;
}

// Value times cosine, and the density with which bsdf_sample() finds the direction.
struct Scatter {
  vec3 value;
  float density;
};

// Lambert, or GGX with Smith's masking and Schlick's reflectance (Walter et al., EGSR 2007).
Scatter bsdf(Surface surface, vec3 outwards, vec3 inwards) {
  Scatter scatter;
  scatter.value = vec3(0.0f, 0.0f, 0.0f);
  scatter.density = 0.0f;
  float cosine_in = dot3(surface.normal, inwards);
  float cosine_out = dot3(surface.normal, outwards);
  if (cosine_in <= 0.0f || cosine_out <= 0.0f) return scatter;
  if (surface.roughness < 0.0f) {
    scatter.density = cosine_in * 0.31830988618f;
    scatter.value = surface.albedo * scatter.density;
    return scatter;
  }
  vec3 middle = unit3(outwards + inwards);
  float cosine_middle = larger(dot3(surface.normal, middle), 0.0001f);
  float cosine_half = larger(dot3(outwards, middle), 0.0001f);
  float a = surface.roughness * surface.roughness;
  float a2 = a * a;
  float d = cosine_middle * cosine_middle * (a2 - 1.0f) + 1.0f;
  float distribution = a2 * (1.0f / (3.14159265359f * d * d));
  float mask_in = cosine_out * sqrt(cosine_in * cosine_in * (1.0f - a2) + a2);
  float mask_out = cosine_in * sqrt(cosine_out * cosine_out * (1.0f - a2) + a2);
  float m = 1.0f - cosine_half;
  float schlick = m * m * m * m * m;
  vec3 reflectance = surface.albedo + (vec3(1.0f, 1.0f, 1.0f) - surface.albedo) * schlick;
  scatter.value = reflectance * (distribution * cosine_in * (0.5f / (mask_in + mask_out)));
  scatter.density = distribution * cosine_middle * (0.25f / cosine_half);
  return scatter;
}

vec3 bsdf_sample(Surface surface, vec3 outwards) {
  float u = sample_next();
  float v = sample_next();
  Pair around = sine_cosine(v);
  if (surface.roughness < 0.0f) {
    float r = sqrt(u);
    return to_world(vec3(r * around.cosine, r * around.sine, sqrt(larger(1.0f - u, 0.0f))), surface.normal);
  }
  float a = surface.roughness * surface.roughness;
  float cosine2 = (1.0f - u) * (1.0f / (1.0f + (a * a - 1.0f) * u));
  float r = sqrt(larger(1.0f - cosine2, 0.0f));
  vec3 middle = to_world(vec3(r * around.cosine, r * around.sine, sqrt(cosine2)), surface.normal);
  return middle * (2.0f * dot3(outwards, middle)) - outwards;
}

// --- light transport -------------------------------------------------------------------------------

// Density, over directions from `origin`, with which direct_light() finds the light at `hit`.
float light_density(int primitive, vec3 direction, float distance2) {
  vec4 normal = scene[4 * primitive + 3];
  float slope = dot3(direction, xyz(normal));
  slope = slope < 0.0f ? -slope : slope;
  if (slope < 0.000001f) return 0.0f;
  return distance2 * (1.0f / (slope * normal.w * float(light_count)));
}

// One light, one point on it, weighted against the BSDF's own sample by the balance heuristic (Veach
// and Guibas 1995).
vec3 direct_light(Surface surface, vec3 outwards) {
  float which = sample_next();
  float u = sample_next();
  float v = sample_next();
  int light = int(which * float(light_count));
  if (light >= light_count) light = light_count - 1;
  int primitive = int(scene[4 * primitive_count + 3 * material_count + light].x);
  vec3 point = xyz(scene[4 * primitive]) + xyz(scene[4 * primitive + 1]) * u + xyz(scene[4 * primitive + 2]) * v;
  vec3 towards = point - surface.position;
  float distance2 = dot3(towards, towards);
  float distance = sqrt(distance2);
  vec3 direction = towards * (1.0f / distance);
  Scatter scatter = bsdf(surface, outwards, direction);
  float density = light_density(primitive, direction, distance2);
  if (scatter.density <= 0.0f || density <= 0.0f) return vec3(0.0f, 0.0f, 0.0f);
  if (intersect(surface.position, direction, distance * 0.9995f).primitive >= 0) return vec3(0.0f, 0.0f, 0.0f);
  int material = int(scene[4 * primitive + 1].w);
  vec3 emission = xyz(scene[4 * primitive_count + 3 * material + 1]);
  return emission * scatter.value * (1.0f / (density + scatter.density));
}

// Light that a surface sends to `outwards`, without its own emission, after up to `bounces` scatterings.
vec3 trace_from(Surface surface, vec3 outwards) {
  vec3 radiance = vec3(0.0f, 0.0f, 0.0f);
  vec3 weight = vec3(1.0f, 1.0f, 1.0f);
  for (int bounce = 0; bounce < bounces; ++bounce) {
    if (light_count > 0) radiance = radiance + weight * direct_light(surface, outwards);
    vec3 direction = bsdf_sample(surface, outwards);
    Scatter scatter = bsdf(surface, outwards, direction);
    if (scatter.density <= 0.0f) break;
    weight = weight * scatter.value * (1.0f / scatter.density);
    Hit hit = intersect(surface.position, direction, 1.0e30f);
    if (hit.primitive < 0) {
      radiance = radiance + weight * vec3(sky.x, sky.y, sky.z);
      break;
    }
    Surface next = surface_at(surface.position, direction, hit);
    float emitted = larger(next.emission.x, larger(next.emission.y, next.emission.z));
    if (emitted > 0.0f) {
      float density = light_density(hit.primitive, direction, hit.t * hit.t);
      radiance = radiance + weight * next.emission * (scatter.density * (1.0f / (scatter.density + density)));
    }
    outwards = direction * -1.0f;
    surface = next;
  }
  return radiance;
}

// --- camera ----------------------------------------------------------------------------------------

// Through the middle of a pixel. right and down are scaled so that a pixel is one unit of each.
vec3 camera_direction(float x, float y) {
  return unit3(vec3(forward.x, forward.y, forward.z) + vec3(right.x, right.y, right.z) * (x + 0.5f - 0.5f * float(screen_width)) +
               vec3(down.x, down.y, down.z) * (y + 0.5f - 0.5f * float(screen_height)));
}

float luminance_of(vec3 colour) { return 0.2126f * colour.x + 0.7152f * colour.y + 0.0722f * colour.z; }
