#include "scene/scattered_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "math/smoothstep.h"
#include "scene/layered_light.h"
#include "scene/round_light.h"

namespace swell::scene {
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
    blend(light.zonal, atmosphere.zonal);
    blend(light.haze, atmosphere.haze);
  });
}

}  // namespace

void fill_scattered_light(Atmosphere& atmosphere, Workers& workers) {
  RoundLight light = scatter_on_round_earth(atmosphere, workers);
  atmosphere.multiple = std::move(light.multiple);
  atmosphere.zonal = std::move(light.zonal);
  atmosphere.haze = std::move(light.haze);
  lay_layers_over(atmosphere, workers);
}

PathSources sources_along(const Atmosphere& atmosphere, const Path& path, double light_sine) {
  const Harmonics at = harmonics(path.sine);
  PathSources sources;
  sources.air = atmosphere.multiple;
  for (std::size_t i = 0; i < sources.air.size(); ++i)
    sources.air[i] += at[moment_index(2, 0)] * atmosphere.zonal[i];

  double lowest = 1.0, highest = -1.0;  // sines of the light's elevation in the haze
  for (const Step& step : path.steps) {
    if (step.source.first >= kHazeHeights - 1) continue;
    const double up = light_sine * step.up, ahead = cosine_of(light_sine) * step.ahead;
    lowest = std::min(lowest, up - ahead);
    highest = std::max(highest, up + ahead);
  }
  if (lowest > highest) return sources;
  sources.first_column = source_column(lowest).first;
  sources.columns = source_column(highest).first + 2 - sources.first_column;
  for (int m = 0; m < kModes; ++m) {
    std::vector<glm::vec3>& out = sources.haze[m];
    out.resize(static_cast<std::size_t>(kHazeHeights * sources.columns));
    for (int l = m; l < kDegrees; ++l) {
      const int n = moment_index(l, m);
      const glm::vec3* in =
          atmosphere.haze.data() + std::size_t{kHazePoints} * n + sources.first_column;
      glm::vec3* to = out.data();
      for (int height = 0; height < kHazeHeights; ++height, in += kSourceSines)
        for (int column = 0; column < sources.columns; ++column) *to++ += at[n] * in[column];
    }
  }
  return sources;
}

glm::vec3 scatter_light_again(const PathSources& sources, double cos_azimuth, const Path& path,
                              LightAngles light) {
  // The columns that this azimuth reads.
  int first = sources.columns, last = 0;
  for (const Step& step : path.steps) {
    if (step.source.first >= kHazeHeights - 1) continue;
    const double sine = light.up * step.up + light.ahead * step.ahead;
    const int column = source_column(sine).first - sources.first_column;
    first = std::min(first, column);
    last = std::max(last, column + 1);
  }
  std::vector<glm::vec3> haze(sources.haze[0].size());
  double before = cos_azimuth, here = 1.0;  // cos((m - 1) phi), cos(m phi)
  for (const std::vector<glm::vec3>& in : sources.haze) {
    const auto part = static_cast<float>(here);
    for (std::size_t row = 0; row < haze.size(); row += static_cast<std::size_t>(sources.columns))
      for (int column = first; column <= last; ++column)
        haze[row + column] += part * in[row + column];
    before = std::exchange(here, 2.0 * cos_azimuth * here - before);
  }
  return scatter_again(
      sources.air,
      [&](Between row, Between column) {
        column.first -= sources.first_column;
        return interpolate(haze.data(), sources.columns, row, column);
      },
      path, light);
}

}  // namespace swell::scene
