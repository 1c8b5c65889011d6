#include "sky/scattered_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "math/smoothstep.h"
#include "sky/add_parts.h"
#include "sky/layered_light.h"
#include "sky/round_light.h"

namespace swell::sky {
namespace {

// Level layers take the place of a round earth while the light's sine goes from one to the other,
// which are 0 and 1.9 degrees.
constexpr double kRound = 0.0, kLevel = 0.033;

void lay_layers_over(Atmosphere& atmosphere, Workers& workers) {
  const Layers layers = make_layers(atmosphere.air);
  workers.for_each(kSourceSines, [&](std::size_t column, int) {
    const double sine = source_sine(static_cast<int>(column));
    const auto part = static_cast<float>(smoothstep(kRound, kLevel, sine));
    if (part <= 0.0f) return;
    const LayeredLight light = scatter_in_layers(atmosphere, layers, sine);
    const auto blend = [&](const std::vector<glm::vec3>& from, std::vector<glm::vec3>& to) {
      for (std::size_t i = 0; i < from.size(); ++i) {
        glm::vec3& at = to[i * kSourceSines + column];
        at += part * (from[i] - at);
      }
    };
    blend(light.mean, atmosphere.multiple);
    blend(light.uneven, atmosphere.uneven);
    blend(light.haze, atmosphere.haze);
  });
}

// Sines of the light's elevation at a path's steps.
struct Sines {
  double lowest = 1.0, highest = -1.0;

  void add(double from, double to) {
    lowest = std::min(lowest, from);
    highest = std::max(highest, to);
  }
  PathSources::Columns columns() const {
    if (lowest > highest) return {};
    const int first = source_column(lowest).first;
    return {first, source_column(highest).first + 2 - first};
  }
};

// Molecules take light from all sides alike, but for moments (2, m).
void add_air(const Atmosphere& atmosphere, const Path& path, const Harmonics& at,
             PathSources& sources) {
  const auto [first, count] = sources.air_columns;
  for (int m = 0; m < kRayleighModes; ++m) {
    const float part = at[moment_index(2, m)];
    const glm::vec3* const uneven = atmosphere.uneven.data() + std::size_t{kPoints} * m;
    std::vector<glm::vec3>& out = sources.air[m];
    out.reserve(path.steps.size() * count);
    for (const Step& step : path.steps)
      for (int column = first; column < first + count; ++column) {
        const auto at_row = [&](int row) {
          const int i = row * kSourceSines + column;
          return (m == 0 ? atmosphere.multiple[i] : glm::vec3(0.0f)) + part * uneven[i];
        };
        const glm::vec3 low = at_row(step.source.first);
        out.push_back(low + step.source.part * (at_row(step.source.first + 1) - low));
      }
  }
}

void add_haze(const Atmosphere& atmosphere, const Harmonics& at, PathSources& sources) {
  const auto [first, count] = sources.haze_columns;
  sources.haze.resize(static_cast<std::size_t>(kModes * kHazeHeights * count));
  glm::vec3* out = sources.haze.data();
  for (int m = 0; m < kModes; ++m) {
    const int n = moment_index(m, m);
    const std::span<const float> parts(at.data() + n, static_cast<std::size_t>(kDegrees - m));
    const glm::vec3* in = atmosphere.haze.data() + std::size_t{kHazePoints} * n + first;
    for (int height = 0; height < kHazeHeights; ++height, in += kSourceSines, out += count)
      add_parts(parts, in, kHazePoints, static_cast<std::size_t>(count), out);
  }
}

ModeCosines mode_cosines(double cos_azimuth) {
  ModeCosines all;
  double before = cos_azimuth, here = 1.0;
  for (float& cosine : all) {
    cosine = static_cast<float>(here);
    before = std::exchange(here, 2.0 * cos_azimuth * here - before);
  }
  return all;
}

// Sums the haze of all modes.
std::vector<glm::vec3> sum_haze(const PathSources& sources, const ModeCosines& modes) {
  const std::size_t count = sources.haze.size() / kModes;
  std::vector<glm::vec3> haze(count);
  add_parts(modes, sources.haze.data(), count, count, haze.data());
  return haze;
}

}  // namespace

void fill_scattered_light(Atmosphere& atmosphere, Workers& workers) {
  RoundLight light = scatter_on_round_earth(atmosphere, workers);
  atmosphere.multiple = std::move(light.multiple);
  atmosphere.uneven = std::move(light.uneven);
  atmosphere.haze = std::move(light.haze);
  lay_layers_over(atmosphere, workers);
}

PathSources sources_along(const Atmosphere& atmosphere, const Path& path, double light_sine) {
  Sines of_air, of_haze;
  for (const Step& step : path.steps) {
    const double up = light_sine * step.up, ahead = cosine_of(light_sine) * step.ahead;
    of_air.add(up - ahead, up + ahead);
    if (is_in_haze(step)) of_haze.add(up - ahead, up + ahead);
  }
  PathSources sources;
  sources.air_columns = of_air.columns();
  sources.haze_columns = of_haze.columns();
  const Harmonics at = harmonics(path.sine);
  add_air(atmosphere, path, at, sources);
  add_haze(atmosphere, at, sources);
  return sources;
}

glm::vec3 scatter_light_again(const PathSources& sources, double cos_azimuth, const Path& path,
                              LightAngles light) {
  const ModeCosines modes = mode_cosines(cos_azimuth);
  return scatter_sources(sources, modes, sum_haze(sources, modes).data(), path, light);
}

}  // namespace swell::sky
