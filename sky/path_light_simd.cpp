#include <algorithm>
#include <cstddef>

#include "sky/air_paths.h"
#include "sky/scattered_light.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sky/path_light_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::sky {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

// A colour in three of four lanes: each lane does what glm::vec3 does for a component.
using DRgb = hn::FixedTag<float, 4>;
using Rgb = hn::Vec<DRgb>;

HWY_INLINE Rgb LoadRgb(const glm::vec3* from) {
  return hn::MaskedLoad(hn::FirstN(DRgb(), 3), DRgb(), &from->x);
}

HWY_INLINE glm::vec3 ColourOf(Rgb rgb) {
  HWY_ALIGN float out[4];
  hn::Store(rgb, DRgb(), out);
  return {out[0], out[1], out[2]};
}

HWY_INLINE Rgb Blend(const glm::vec3* p, float part) {
  const Rgb low = LoadRgb(p);
  return low + part * (LoadRgb(p + 1) - low);
}

HWY_INLINE Rgb Interpolate(const glm::vec3* table, int columns, Between row, Between column) {
  const glm::vec3* const p = table + row.first * columns + column.first;
  const Rgb low = Blend(p, column.part);
  return low + row.part * (Blend(p + columns, column.part) - low);
}

HWY_INLINE double SineAt(const Step& step, LightAngles light) {
  return light.up * step.up + light.ahead * step.ahead;
}

Scattered ScatterOnce(const Atmosphere& atmosphere, const Path& path, LightAngles light) {
  Rgb rayleigh = hn::Zero(DRgb()), mie = rayleigh;
  for (const Step& step : path.steps) {
    const double sine = SineAt(step, light);
    const double seen = part_over_edge(step.height, sine);
    if (seen <= 0.0) continue;
    const Between column =
        transmittance_column(step.height, std::max(sine, step.height.horizon_sine));
    const Rgb arrives =
        static_cast<float>(seen) * Interpolate(atmosphere.transmittance.data(),
                                               kTransmittanceColumns, step.height.row, column);
    rayleigh = rayleigh + LoadRgb(&step.rayleigh) * arrives;
    mie = mie + LoadRgb(&step.mie) * arrives;
  }
  return {ColourOf(rayleigh), ColourOf(mie)};
}

glm::vec3 ScatterAgain(const glm::vec3* mean, const glm::vec3* haze, const Path& path,
                       LightAngles light) {
  Rgb sum = hn::Zero(DRgb());
  for (const Step& step : path.steps) {
    const double sine = SineAt(step, light);
    if (sine < kLowestSine) continue;
    const Between column = source_column(sine);
    sum = sum + LoadRgb(&step.rayleigh) * Interpolate(mean, kSourceSines, step.source, column);
    if (is_in_haze(step))
      sum = sum + LoadRgb(&step.mie) * Interpolate(haze, kSourceSines, step.source, column);
  }
  return ColourOf(sum);
}

glm::vec3 ScatterSources(const PathSources& sources, const ModeCosines& modes,
                         const glm::vec3* haze, const Path& path, LightAngles light) {
  Rgb sum = hn::Zero(DRgb());
  for (std::size_t n = 0; n < path.steps.size(); ++n) {
    const Step& step = path.steps[n];
    const double sine = SineAt(step, light);
    if (sine < kLowestSine) continue;
    const Between column = source_column(sine);
    const std::size_t place = n * static_cast<std::size_t>(sources.air_columns.count) +
                              static_cast<std::size_t>(column.first - sources.air_columns.first);
    Rgb air = hn::Zero(DRgb());
    for (std::size_t m = 0; m < kRayleighModes; ++m)
      air = air + modes[m] * Blend(sources.air[m].data() + place, column.part);
    sum = sum + LoadRgb(&step.rayleigh) * air;
    if (is_in_haze(step))
      sum = sum + LoadRgb(&step.mie) *
                      Interpolate(haze, sources.haze_columns.count, step.source,
                                  {column.first - sources.haze_columns.first, column.part});
  }
  return ColourOf(sum);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::sky
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::sky {

HWY_EXPORT(ScatterOnce);
HWY_EXPORT(ScatterAgain);
HWY_EXPORT(ScatterSources);

Scattered scatter_once(const Atmosphere& atmosphere, const Path& path, LightAngles light) {
  return HWY_DYNAMIC_DISPATCH(ScatterOnce)(atmosphere, path, light);
}

glm::vec3 scatter_again(const glm::vec3* mean, const glm::vec3* haze, const Path& path,
                        LightAngles light) {
  return HWY_DYNAMIC_DISPATCH(ScatterAgain)(mean, haze, path, light);
}

glm::vec3 scatter_sources(const PathSources& sources, const ModeCosines& modes,
                          const glm::vec3* haze, const Path& path, LightAngles light) {
  return HWY_DYNAMIC_DISPATCH(ScatterSources)(sources, modes, haze, path, light);
}

}  // namespace swell::sky
#endif  // HWY_ONCE
