// Maps of slopes (apps/peer/peer_maps.h): `place` is (turns per metre, coordinates under the eye,
// log2 of texels per metre), `scale` turns a sample into slopes and lost variance.
struct Slopes {
  vec2 slope;
  float variance;
};

vec4 sample_map(sampler2D map, vec4 place, vec2 p, float level_m) {
  return textureLod(map, p * place.x + place.yz, level_m + place.w);
}

void add_slopes(sampler2D map, vec4 place, vec4 scale, vec2 p, float level_m, inout Slopes s) {
  vec4 found = sample_map(map, place, p, level_m);
  s.slope += found.rg * scale.x + scale.y;
  s.variance += found.b * scale.z;
}

vec3 normal_of(vec2 slope) {
  float inv_length = inversesqrt(dot(slope, slope) + 1.0);
  return vec3(-slope * inv_length, inv_length);
}
