// Maps of slopes (tools/peer/peer_maps.h): `place` is (turns per metre, coordinates under the eye,
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

// The tiles of a patch, as ocean/open_sea/patch_tiles-inl.h. `tiles`: the eye's period along both
// axes, the seed's upper and lower 16 bits.
vec2 offset_of_tile(ivec2 tile, vec4 tiles, int samples) {
  uvec2 place = uvec2((tile + ivec2(tiles.xy)) & 0xffff);
  uint bits = (place.y << 16 | place.x) ^ (uint(tiles.z) << 16 | uint(tiles.w));
  bits = (bits ^ bits >> 16) * 0x7feb352du;
  bits = (bits ^ bits >> 15) * 0x846ca68bu;
  bits ^= bits >> 16;
  return vec2(bits & uint(samples - 1), bits >> 16 & uint(samples - 1)) / float(samples);
}

// Weights of the tile at `place` in [0, 1] and of the one behind the nearer border.
vec2 blend_along(float place) {
  float t = max(0.5 - 8.0 * min(place, 1.0 - place), 0.0);
  float share = t * t * (3.0 - 2.0 * t);
  return cos(vec2(share, 1.0 - share) * 1.5707963);
}

void add_tiled_slopes(sampler2D map, vec4 place, vec4 scale, vec4 tiles, vec2 p, float level_m,
                      inout Slopes s) {
  int samples = textureSize(map, 0).x;
  vec2 uv = p * place.x + place.yz, at = uv - 0.5 / float(samples);
  vec4 found = vec4(0.0);
  int row = int(floor(at.y));
  float y = fract(at.y);
  vec2 rows = blend_along(y);
  for (int r = 0; r < 2; ++r) {
    float moved = at.x + 0.5 * float((row + int(tiles.y)) & 1);
    int column = int(floor(moved));
    float x = fract(moved);
    vec2 columns = blend_along(x);
    for (int c = 0; c < 2; ++c) {
      float weight = rows[r] * columns[c];
      if (weight > 0.0) {
        vec2 offset = offset_of_tile(ivec2(column, row), tiles, samples);
        vec4 here = textureLod(map, uv + offset, level_m + place.w);
        found += vec4((here.rg * scale.x + scale.y) * weight, c + r > 0 ? 0.0 : here.b, 0.0);
      }
      column += x < 0.5 ? -1 : 1;
    }
    row += y < 0.5 ? -1 : 1;
  }
  s.slope += found.rg;
  s.variance += found.b * scale.z;
}

vec3 normal_of(vec2 slope) {
  float inv_length = inversesqrt(dot(slope, slope) + 1.0);
  return vec3(-slope * inv_length, inv_length);
}
