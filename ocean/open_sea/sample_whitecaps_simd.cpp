// Foam of the open sea as it is asked for.
#include <algorithm>
#include <array>
#include <cmath>

#include "math/check.h"
#include "ocean/open_sea/patch_tiles-inl.h"
#include "ocean/open_sea/whitecaps.h"

namespace swell::ocean {
namespace {

// Bilinear between texels of a map that repeats: value(texel).
float value_at_texels(glm::dvec2 texels, auto value) {
  constexpr int n = kFoamMapSize;
  const glm::dvec2 corner = glm::floor(texels);
  const glm::vec2 part(texels - corner);
  const auto index = [](double x) { return static_cast<std::size_t>(x - n * std::floor(x / n)); };
  const std::array<std::size_t, 2> x = {index(corner.x), index(corner.x + 1.0)};
  const std::array<std::size_t, 2> y = {n * index(corner.y), n * index(corner.y + 1.0)};
  const auto at = [&](int i, int j) { return value(y[j] + x[i]); };
  return glm::mix(glm::mix(at(0, 0), at(1, 0), part.x), glm::mix(at(0, 1), at(1, 1), part.x),
                  part.y);
}

float foam_at_texels(const WhitecapFrame::Patch& patch, float past, glm::dvec2 texels) {
  return value_at_texels(texels, [&](std::size_t texel) {
    return glm::mix(foam_of_code(patch.before[texel]), foam_of_code(patch.after[texel]), past);
  });
}

// Foam of trains, and what they leave of that of short waves.
struct OnTrains {
  float foam = 0.0f, short_part = 1.0f;
};

OnTrains on_trains_at(const WhitecapFrame& frame, glm::dvec2 p_world) {
  const TrainSquare& trains = *frame.trains;
  const glm::dvec2 texels = (p_world - trains.min_world) * (kFoamMapSize / trains.size_m);
  const auto is_inside = [](double x) { return x >= 0.0 && x <= kFoamMapSize - 1.0; };
  if (!is_inside(texels.x) || !is_inside(texels.y)) return {};
  return {value_at_texels(texels,
                          [&](std::size_t at) {
                            const float foam =
                                glm::mix(foam_of_trains(frame.trains_before[at]),
                                         foam_of_trains(frame.trains_after[at]), frame.past);
                            return std::min(trains.part[at] * foam, 1.0f);
                          }),
          value_at_texels(texels, [&](std::size_t at) { return trains.short_part[at]; })};
}

}  // namespace
}  // namespace swell::ocean

HWY_BEFORE_NAMESPACE();
namespace swell::ocean {
namespace HWY_NAMESPACE {

// Foam of tiles that are blended: in the mean what it is without, since the squares of their
// weights add up to 1.
static float foam_at(const WhitecapFrame::Patch& patch, float past, glm::dvec2 p_world) {
  using D = hn::CappedTag<float, 1>;
  const hn::RebindToSigned<D> di;
  const glm::dvec2 periods = p_world / patch.length_m, period = glm::floor(periods);
  const glm::dvec2 inside = periods - period;
  if (!patch.tiling.on) return foam_at_texels(patch, past, inside * double{kFoamMapSize});
  const D d;
  const SquarePlace<D> place = {
      hn::Set(di, tile_number(period.x)), hn::Set(di, tile_number(period.y)),
      hn::Set(d, static_cast<float>(inside.x)), hn::Set(d, static_cast<float>(inside.y))};
  float foam = 0.0f;
  ForEachTile(d, patch.tiling, patch.wave_samples, place, [&](auto by, const auto& tile) HWY_ATTR {
    const glm::dvec2 moved(hn::GetLane(by.x), hn::GetLane(by.y));
    const float weight = hn::GetLane(tile.weight);
    foam += weight * weight *
            foam_at_texels(patch, past,
                           double{kFoamMapSize} * (inside + moved / double(patch.wave_samples)));
  });
  return foam;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::ocean
HWY_AFTER_NAMESPACE();

namespace swell::ocean {

void sample_whitecaps(const WhitecapFrame& frame, std::span<const glm::dvec2> p_world,
                      std::span<const float> height_m, std::span<float> foam,
                      std::span<const float> ceded) {
  SWELL_CHECK(p_world.size() == foam.size() && height_m.size() == foam.size(),
              "{} points, {} heights, {} foam", p_world.size(), height_m.size(), foam.size());
  for (std::size_t k = 0; k < p_world.size(); ++k) {
    const float kept = 1.0f - (ceded.empty() ? 0.0f : ceded[k]);
    const OnTrains trains = frame.trains ? on_trains_at(frame, p_world[k]) : OnTrains{0.0f, kept};
    float free = 1.0f;
    for (std::size_t p = 0; p < frame.patches.size(); ++p) {
      float part = HWY_NAMESPACE::foam_at(frame.patches[p], frame.past, p_world[k]);
      if (p == 0)
        part = std::min(part * kept + trains.foam, 1.0f);
      else
        part = std::min(part * foam_on_crest(height_m[k], frame.crest_per_m), 1.0f) *
               trains.short_part;
      free *= 1.0f - part;
    }
    foam[k] = 1.0f - free;
  }
}

}  // namespace swell::ocean
