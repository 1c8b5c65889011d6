// Foam, as render/water/foam-inl.h.
uniform sampler2D foam_pattern;
uniform vec4 foam_place, foam_scale;
uniform vec3 foam_light;

float foam_cover(vec2 p, float level_m, float foam) {
  const float soft = 0.3;
  float code = sample_map(foam_pattern, foam_place, p, level_m).r * foam_scale.x + foam_scale.y;
  float threshold = 0.5 * code + 0.5;
  float cover = clamp((foam * (1.0 + soft) - threshold) * (1.0 / soft), 0.0, 1.0);
  return foam > 0.02 ? cover : 0.0;
}

vec3 add_foam(float cover, vec3 light) { return mix(light, foam_light, 0.92 * cover); }
