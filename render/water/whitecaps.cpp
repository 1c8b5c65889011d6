#include "render/water/whitecaps.h"

#include <algorithm>

#include "math/elementary.h"
#include "math/smoothstep.h"
#include "render/frame/parts.h"
#include "render/sea/sea_maps.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

// Periods across the wind of the pattern, which has cells of 1/10 and 1/25 of that.
constexpr double kEddies_m = 173.0, kTears_m = 41.0, kLace_m = 9.7;

// stretch: how many times as long cells are along the wind as across it.
FoamLace make_lace(const MaterialInputs& in, glm::dvec2 eye, double period_m, double stretch) {
  const texture::PackedMap2& map = *in.world.textures.foam;
  const double from = in.world.scene.sea.wind_from_rad;
  const glm::dvec2 along(sin(from), cos(from)), across(along.y, -along.x);
  const double map_fx8 = 256.0 * map.size;
  FoamLace lace;
  lace.map = &map;
  lace.x_fx8_per_m = glm::vec2(across * (map_fx8 / period_m));
  lace.y_fx8_per_m = glm::vec2(along * (map_fx8 / (period_m * stretch)));
  lace.x_eye_fx8 = static_cast<float>(map_fx8) * fraction(glm::dot(eye, across) / period_m);
  lace.y_eye_fx8 =
      static_cast<float>(map_fx8) * fraction(glm::dot(eye, along) / (period_m * stretch));
  lace.log2_texels_per_m = static_cast<float>(log(map.size / period_m) * 1.4426950408889634);
  return lace;
}

}  // namespace

Whitecaps make_whitecaps(const MaterialInputs& in, glm::dvec2 eye) {
  Whitecaps whitecaps;
  // Lines of foam along the wind are seen from Beaufort 7 on, 13.9 m/s.
  const double wind_mps = in.world.scene.sea.wind_speed_mps;
  const double gale = smoothstep(11.0, 20.0, wind_mps);
  whitecaps.eddies = make_lace(in, eye, kEddies_m, 1.0);
  whitecaps.tears = make_lace(in, eye, kTears_m, 1.2 + 5.0 * gale);
  whitecaps.lace = make_lace(in, eye, kLace_m, 1.0 + 1.5 * gale);
  const ocean::Whitecaps& sea = *in.world.whitecaps;
  if (in.without.has(Part::kWhitecaps) || sea.patches.empty()) return whitecaps;
  whitecaps.count = static_cast<int>(sea.patches.size());
  float free = 1.0f;
  for (std::size_t p = 0; p < sea.patches.size(); ++p) {
    FoamMap& map = whitecaps.foam[p];
    map.map = &in.sea.foam[p];
    if (in.sea.foam_blocks[p].are_few) map.blocks = &in.sea.foam_blocks[p];
    const double length_m = sea.patches[p].length_m, map_fx8 = 256.0 * map.map->size;
    map.texels_fx8_per_m = static_cast<float>(map_fx8 / length_m);
    map.x_eye_fx8 = static_cast<float>(map_fx8) * fraction(eye.x / length_m);
    map.y_eye_fx8 = static_cast<float>(map_fx8) * fraction(eye.y / length_m);
    map.log2_texels_per_m = static_cast<float>(log(map.map->size / length_m) * 1.4426950408889634);
    map.mean = static_cast<float>(sea.patches[p].cover);
    map.fx8_per_sample = 256 * map.map->size / in.sea.whitecaps.patches[p].wave_samples;
    free *= 1.0f - map.mean;
  }
  whitecaps.least = std::min(0.01f, 0.5f * (1.0f - free));
  whitecaps.crest_per_m = sea.crest_per_m;
  return whitecaps;
}

}  // namespace swell::render
