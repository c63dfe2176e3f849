// Shared by GLSL and C++ like trace.glsl.
uint display_byte(float value) {
  float shown = value > 0.0f ? sqrt(value * (1.0f / (1.0f + value))) : 0.0f;
  return uint(shown * 255.0f + 0.5f);
}
