#include "sky/layered_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "math/elementary.h"
#include "sky/add_parts.h"

namespace swell::sky {
namespace {

constexpr int kLayers = kSourceHeights - 1;
constexpr int kSummedOrders = 10;
constexpr double kLeastOfMode = 0.02;  // modes that shrank to less are left out
constexpr double kStep = 0.003;        // of the sun's sine

// Source: W. H. Press et al., Numerical Recipes, third edition, 2007, section 4.6.
void place_streams(Layers& all) {
  for (int i = 0; i < kHalf; ++i) {
    double x = cos(kPi * (i + 0.75) / (kHalf + 0.5)), slope = 1.0;
    for (int newton = 0; newton < 8; ++newton) {
      double here = 1.0, before = 0.0;
      for (int l = 0; l < kHalf; ++l) {
        const double next = ((2.0 * l + 1.0) * x * here - l * before) / (l + 1);
        before = here;
        here = next;
      }
      slope = kHalf * (x * here - before) / (x * x - 1.0);
      x -= here / slope;
    }
    const auto n = static_cast<std::size_t>(i);
    all.sine[n] = 0.5 + 0.5 * x;
    all.weight[n] = 1.0 / ((1.0 - x * x) * slope * slope);
  }
  for (std::size_t j = 0; j < kStreams; ++j) {
    const Harmonics at = harmonics(j < kHalf ? all.sine[j] : -all.sine[j - kHalf]);
    for (int m = 0; m < kModes; ++m)
      for (int l = m; l < kDegrees; ++l) {
        const auto n = static_cast<std::size_t>(moment_index(l, m));
        all.of_degree[n][j] = at[n];
        all.of_stream[static_cast<std::size_t>(m)][j][static_cast<std::size_t>(l)] =
            at[n] * static_cast<float>(all.weight[j % kHalf]);
      }
  }
}

// The light's way through a layer from its far side to its near one.
struct Way {
  double length_m;
  double far_sine;    // of the ray, on the far side
  bool dips = false;  // it enters on the near side as well
};

// Down to the layer's lower side, which it meets at a sine.
Way way_down(double radius_m, double thick_m, double sine) {
  const double up_m = radius_m * sine;
  const double far_m = std::sqrt(up_m * up_m + thick_m * (2.0 * radius_m + thick_m));
  return {far_m - up_m, far_m / (radius_m + thick_m)};
}

// Up to the layer's upper side; radius_m: of the lower one.
Way way_up(double radius_m, double thick_m, double sine) {
  const double up_m = (radius_m + thick_m) * sine;
  const double far2 = up_m * up_m - thick_m * (2.0 * radius_m + thick_m);
  if (far2 < 0.0) return {2.0 * up_m, -sine, true};
  return {up_m - std::sqrt(far2), std::sqrt(far2) / radius_m};
}

// The parts of even light, and of light that grows from 0, that reach the end of a depth d at
// which they are weakened by exp(-d): the integrals of exp(-d t) and t exp(-d t) over [0, 1].
struct Arrives {
  double even, growing;
};
Arrives arrives(double d, double passes) {
  if (std::abs(d) < 0.01) return {1.0 - d * (0.5 - d / 6.0), 0.5 - d * (1.0 / 3.0 - d / 8.0)};
  return {(1.0 - passes) / d, (1.0 - passes * (1.0 + d)) / (d * d)};
}

// Between sines, light that comes down through thin air goes about as 1 over the sine and a little,
// as its way does.
double turned_part(double sine, double far_sine, double next) {
  constexpr double kLevel = 0.06;
  if (next < sine) return (sine - far_sine) / (sine - next);
  return (sine - far_sine) / (sine - next) * (next + kLevel) / (far_sine + kLevel);
}

// Between two heights.
struct Slab {
  double low_m, thick_m;
  glm::dvec3 lost_per_m;  // in the mean
};

// Makes the layer of channel c. Even light that dips is scattered at two thirds of its depth, in
// the mean.
Layer make_layer(const Air& air, const Slab& slab, int c, const std::array<double, kHalf>& sines,
                 bool up) {
  Layer layer;
  const double radius_m = kEarthRadius_m + slab.low_m;
  for (std::size_t j = 0; j < kHalf; ++j) {
    const double sine = sines[j];
    const Way way = (up ? way_up : way_down)(radius_m, slab.thick_m, sine);
    const double next = up ? (j + 1 < kHalf ? sines[j + 1] : -sine) : (j > 0 ? sines[j - 1] : 1.0);
    const double dip_m = way.dips ? way.length_m * sine / 6.0 : 0.0;
    const double lost_per_m = way.dips
                                  ? air_light(air, slab.low_m + slab.thick_m - dip_m).lost_per_m[c]
                                  : slab.lost_per_m[c];
    const double across_m = way.length_m * std::sqrt(1.0 - sine * sine);
    const double d = lost_per_m * way.length_m, passes = exp(-d);
    Arrives part = arrives(d, passes);
    if (way.dips) part.growing = part.even * dip_m / slab.thick_m;
    layer.turned[j] = static_cast<float>(turned_part(sine, way.far_sine, next));
    layer.depth[j] = static_cast<float>(d);
    layer.passes[j] = static_cast<float>(passes);
    layer.near[j] = static_cast<float>(d * (part.even - part.growing));
    layer.far[j] = static_cast<float>(d * part.growing);
    layer.across_m[j] = static_cast<float>(across_m);
    layer.reach_m[j] = static_cast<float>(across_m * (way.dips ? 0.5 : part.growing / part.even));
    layer.dips = way.dips;
  }
  return layer;
}

template <class T>
using Channels = std::array<T, 3>;
template <class T>
using HeightRows = std::array<Channels<T>, kSourceHeights>;
using Stream = std::array<float, kStreams>;
using Moments = std::array<float, kDegrees>;

// ---- The sun's light

struct SunLight {
  HeightRows<float> arrives, growth;  // by height; d log(arrives) / d sine
  // What of the light it makes arrives at both sides of the layers: it fades within one by a power.
  std::array<Channels<Layer>, kLayers> down, up;
};

// Makes a layer of light that is `here` on its near side and `there` on its far side.
Layer fade(const Layer& layer, double here, double there) {
  Layer out = layer;
  const double a = log(there / here);
  const std::size_t through = layer.dips ? kHalf - 1 : kHalf;
  if (layer.dips) {
    out.near[through] *= static_cast<float>(here);
    out.far[through] *= static_cast<float>(there);
  }
  for (std::size_t j = 0; j < through; ++j) {
    const double x = layer.depth[j], d = x - a;
    const Arrives part = arrives(d, layer.passes[j] * there / here);
    out.near[j] = static_cast<float>(here * x * (part.even - part.growing));
    out.far[j] = static_cast<float>(here * x * part.growing);
    out.reach_m[j] = static_cast<float>(layer.across_m[j] * part.growing / part.even);
  }
  return out;
}

SunLight sun_light(const Atmosphere& atmosphere, const Layers& layers, double sine) {
  SunLight sun;
  for (int i = 0; i < kSourceHeights; ++i) {
    const HeightRow row = height_row_of(source_height_m(i));
    const auto at = [&](double x) {
      return glm::max(disc_transmittance(atmosphere, row, x), 1e-30f);
    };
    const glm::vec3 here = at(sine), more = at(sine + kStep);
    for (int c = 0; c < 3; ++c) {
      sun.arrives[i][c] = here[c];
      sun.growth[i][c] = static_cast<float>(log(double(more[c]) / here[c]) / kStep);
    }
  }
  for (int i = 0; i < kLayers; ++i)
    for (int c = 0; c < 3; ++c) {
      const double low = sun.arrives[i][c], high = sun.arrives[i + 1][c];
      sun.down[i][c] = fade(layers.down[i][c], low, high);
      sun.up[i][c] = fade(layers.up[i][c], high, low);
    }
  return sun;
}

// ---- Modes of light

struct Mode {
  HeightRows<Stream> source, light;
  // How much more light there is where the sun stands higher, towards which the streams come from:
  // times the cosine of the azimuth.
  HeightRows<Stream> drift;
  HeightRows<Moments> moments, sum;
};

// Light along streams, its growth with the sine of the sun's elevation, and that times the way
// across that it has come.
struct StreamLight {
  StreamRow light{}, growth{}, drift_m{};
};
// LowestRay is what StreamLight holds of the lowest stream.
struct LowestRay {
  float light = 0.0f, growth = 0.0f, drift_m = 0.0f;
};

class LayeredSky {
 public:
  LayeredSky(const Layers& layers, double sine) : layers_(layers), sine_(sine), modes_(kModes) {
    for (int l = 0; l < kDegrees; ++l) {
      haze_moment_[l] = static_cast<float>(mie_moment(l));
      rayleigh_moment_[l] = static_cast<float>(rayleigh_moment(l));
    }
  }

  void scatter(const SunLight& sun) {
    growth_ = sun.growth;
    for (int m = 0; m < kModes; ++m) scatter_sun(sun, m);
    finish_order(kModes);
    for (Mode& mode : modes_) mode.sum = mode.moments;
    for (int order = 2; order <= kSummedOrders; ++order) {
      const int count = modes_of(order);
      const HeightRows<Moments> before = modes_[0].moments;
      for (int m = 0; m < count; ++m) scatter_again(m);
      finish_order(count);
      for (int m = 0; m < count; ++m) add(modes_[m].moments, modes_[m].sum);
      if (order == kSummedOrders) add_later_orders(before);
    }
  }

  LayeredLight light() const {
    LayeredLight out{std::vector<glm::vec3>(kSourceHeights),
                     std::vector<glm::vec3>(std::size_t{kRayleighModes} * kSourceHeights),
                     std::vector<glm::vec3>(std::size_t{kMoments} * kHazeHeights)};
    for (int c = 0; c < 3; ++c) {
      for (int i = 0; i < kSourceHeights; ++i) {
        // The mean is half of the integral over the sine, and K_00 the root of a half.
        out.mean[i][c] = modes_[0].sum[i][c][0] * static_cast<float>(std::sqrt(0.5));
        for (int m = 0; m < kRayleighModes; ++m)
          out.uneven[m * kSourceHeights + i][c] = modes_[m].sum[i][c][2] * rayleigh_moment_[2];
      }
      for (int m = 0; m < kModes; ++m)
        for (int l = m; l < kDegrees; ++l)
          for (int i = 0; i < kHazeHeights; ++i)
            out.haze[moment_index(l, m) * kHazeHeights + i][c] =
                modes_[m].sum[i][c][l] * haze_moment_[l];
    }
    return out;
  }

 private:
  // Light that was scattered often is even.
  static int modes_of(int order) {
    int count = 2;
    while (count < kModes && pow(mie_moment(count), order - 1) > kLeastOfMode) ++count;
    return count;
  }

  // Scattered once, or thrown back by the sea.
  void scatter_sun(const SunLight& sun, int m) {
    const Harmonics at_sun = harmonics(sine_);
    Stream rayleigh{}, haze{};
    for (int l = m; l < kDegrees; ++l) {
      const float part = static_cast<float>(mode_norm(m)) * at_sun[moment_index(l, m)];
      const Stream& at = layers_.of_degree[moment_index(l, m)];
      for (int j = 0; j < kStreams; ++j) {
        haze[j] += part * haze_moment_[l] * at[j];
        rayleigh[j] += part * rayleigh_moment_[l] * at[j];
      }
    }
    for (int i = 0; i < kSourceHeights; ++i)
      for (int c = 0; c < 3; ++c) {
        const Scatters& part = layers_.heights[i][c];
        for (int j = 0; j < kStreams; ++j)
          modes_[m].source[i][c][j] = part.rayleigh * rayleigh[j] + part.haze * haze[j];
      }
    Channels<float> sea{};
    for (int c = 0; c < 3 && m == 0; ++c)
      sea[c] = static_cast<float>(kSeaAlbedo / kPi * sine_) * sun.arrives[0][c];
    sweep(sun.down, sun.up, sea, m);
  }

  // Once more.
  void scatter_again(int m) {
    Mode& mode = modes_[m];
    for (int i = 0; i < kSourceHeights; ++i)
      for (int c = 0; c < 3; ++c) {
        const Scatters& part = layers_.heights[i][c];
        const int count = std::max((i < kHazeHeights ? kDegrees : 3) - m, 0);
        Moments moment;
        for (int n = 0; n < count; ++n) {
          const int l = m + n;
          moment[n] = mode.moments[i][c][l] *
                      (part.rayleigh * rayleigh_moment_[l] + part.haze * haze_moment_[l]);
        }
        mode.source[i][c] = {};
        add_parts({moment.data(), static_cast<std::size_t>(count)},
                  layers_.of_degree[moment_index(m, m)].data(), kStreams, kStreams,
                  mode.source[i][c].data());
      }
    Channels<float> sea{};
    for (int c = 0; c < 3 && m == 0; ++c) {
      double sum = 0.0;
      for (int j = 0; j < kHalf; ++j)
        sum += layers_.weight[j] * layers_.sine[j] * double{mode.light[0][c][j]};
      sea[c] = static_cast<float>(2.0 * kSeaAlbedo * sum);
    }
    sweep(layers_.down, layers_.up, sea, m);
  }

  // Light along the streams, down from no light and up from the sea's. What goes up along the
  // lowest one came down further off.
  void sweep(std::span<const Channels<Layer>> down, std::span<const Channels<Layer>> up,
             const Channels<float>& sea, int m) {
    for (int c = 0; c < 3; ++c) {
      StreamLight streams;
      std::array<LowestRay, kSourceHeights> lowest{};  // that goes down
      keep(streams, kLayers, c, 0, m);
      for (int i = kLayers - 1; i >= 0; --i) {
        turn_down(down[i][c].turned, streams);
        cross(down[i][c],
              {modes_[m].source[i][c].data(), modes_[m].source[i + 1][c].data(), growth_[i][c],
               growth_[i + 1][c]},
              streams);
        keep(streams, i, c, 0, m);
        lowest[i] = lowest_of(streams);
      }
      streams = {};
      streams.light.fill(sea[c]);
      streams.growth.fill(sea[c] * growth_[0][c]);
      keep(streams, 0, c, kHalf, m);
      lowest[0] = lowest_of(streams);
      for (int i = 1; i < kSourceHeights; ++i) {
        turn_up(up[i - 1][c].turned, lowest[up[i - 1][c].dips ? i : i - 1], streams);
        cross(up[i - 1][c],
              {modes_[m].source[i][c].data() + kHalf, modes_[m].source[i - 1][c].data() + kHalf,
               growth_[i][c], growth_[i - 1][c]},
              streams);
        keep(streams, i, c, kHalf, m);
      }
    }
  }

  // What is scattered into the streams at both sides of a layer, the near one where they leave it.
  struct Sides {
    const float *near, *far;
    float near_growth, far_growth;
  };

  static LowestRay lowest_of(const StreamLight& streams) {
    return {streams.light.back(), streams.growth.back(), streams.drift_m.back()};
  }

  // Streams come from steeper ones above.
  static void turn_down(const StreamRow& turned, StreamLight& streams) {
    for (StreamRow* row : {&streams.light, &streams.growth, &streams.drift_m})
      for (int j = kHalf - 1; j > 0; --j) (*row)[j] += turned[j] * ((*row)[j - 1] - (*row)[j]);
  }

  // And from flatter ones below, the lowest from what comes down at `level`.
  static void turn_up(const StreamRow& turned, const LowestRay& level, StreamLight& streams) {
    const auto turn = [&](StreamRow& row, float last) {
      for (int j = 0; j < kHalf; ++j)
        row[j] += turned[j] * ((j + 1 < kHalf ? row[j + 1] : last) - row[j]);
    };
    turn(streams.light, level.light);
    turn(streams.growth, level.growth);
    turn(streams.drift_m, level.drift_m);
  }

  static void cross(const Layer& layer, const Sides& source, StreamLight& streams) {
    auto& [light, growth, drift_m] = streams;
    for (int j = 0; j < kHalf; ++j) {
      const float near = source.near[j] * layer.near[j], far = source.far[j] * layer.far[j];
      const float grows = near * source.near_growth + far * source.far_growth;
      drift_m[j] =
          (drift_m[j] + growth[j] * layer.across_m[j]) * layer.passes[j] + grows * layer.reach_m[j];
      growth[j] = growth[j] * layer.passes[j] + grows;
      light[j] = light[j] * layer.passes[j] + near + far;
    }
  }

  void keep(const StreamLight& streams, int i, int c, int first, int m) {
    const auto per_m = static_cast<float>(cosine_of(sine_) / kEarthRadius_m);  // of the sun's sine
    for (int j = 0; j < kHalf; ++j) {
      modes_[m].light[i][c][first + j] = streams.light[j];
      modes_[m].drift[i][c][first + j] = streams.drift_m[j] * per_m;
    }
    if (m > 0) return;
    Mean& mean = means_[i][c];
    if (first == 0) mean = {};
    for (int j = 0; j < kHalf; ++j) {
      mean.light += static_cast<float>(layers_.weight[j]) * streams.light[j];
      mean.growth += static_cast<float>(layers_.weight[j]) * streams.growth[j];
    }
  }

  // Moments of the light with its drift, whose factor cos(phi) makes modes m - 1 and m + 1 of m.
  void finish_order(int count) {
    for (int m = 0; m < count; ++m)
      for (int i = 0; i < kSourceHeights; ++i)
        for (int c = 0; c < 3; ++c) {
          Stream light = modes_[m].light[i][c];
          const float from_lower = m == 1 ? 1.0f : 0.5f;
          for (int j = 0; m > 0 && j < kStreams; ++j)
            light[j] += from_lower * modes_[m - 1].drift[i][c][j];
          for (int j = 0; m + 1 < count && j < kStreams; ++j)
            light[j] += 0.5f * modes_[m + 1].drift[i][c][j];
          modes_[m].moments[i][c] = {};
          add_parts(light, layers_.of_stream[m][0].data() + m, kDegrees,
                    static_cast<std::size_t>(kDegrees - m), modes_[m].moments[i][c].data() + m);
        }
    for (int i = 0; i < kSourceHeights; ++i)
      for (int c = 0; c < 3; ++c)
        growth_[i][c] = means_[i][c].growth / std::max(means_[i][c].light, 1e-35f);
  }

  static void add(const HeightRows<Moments>& more, HeightRows<Moments>& sum) {
    for (int i = 0; i < kSourceHeights; ++i)
      for (int c = 0; c < 3; ++c)
        for (int l = 0; l < kDegrees; ++l) sum[i][c][l] += more[i][c][l];
  }

  // Alike in all azimuths.
  void add_later_orders(const HeightRows<Moments>& before) {
    const HeightRows<Moments>& last = modes_[0].moments;
    for (int i = 0; i < kSourceHeights; ++i)
      for (int c = 0; c < 3; ++c) {
        const float more = later_orders(before[i][c][0], last[i][c][0]);
        for (int l = 0; l < kDegrees; ++l) modes_[0].sum[i][c][l] += more * last[i][c][l];
      }
  }

  struct Mean {
    float light = 0.0f, growth = 0.0f;
  };

  const Layers& layers_;
  double sine_;
  std::vector<Mode> modes_;
  HeightRows<float> growth_;  // of the light to be scattered: d log / d sine
  HeightRows<Mean> means_;    // of the light last scattered
  Moments haze_moment_, rayleigh_moment_;
};

}  // namespace

Layers make_layers(const Air& air) {
  constexpr int kParts = 8;
  Layers all;
  place_streams(all);
  for (int i = 0; i < kSourceHeights; ++i) {
    const AirLight here = air_light(air, source_height_m(i));
    Channels<Scatters> scatters;
    for (int c = 0; c < 3; ++c) {
      const double lost = std::max(here.lost_per_m[c], 1e-14);
      scatters[c] = {static_cast<float>(here.rayleigh_per_m[c] / lost),
                     static_cast<float>(here.mie_per_m[c] / lost)};
    }
    all.heights.push_back(scatters);
    if (i == kLayers) break;
    const double low_m = source_height_m(i), thick_m = source_height_m(i + 1) - low_m;
    Slab slab{low_m, thick_m, glm::dvec3(0.0)};
    for (int n = 0; n < kParts; ++n)
      slab.lost_per_m +=
          air_light(air, low_m + thick_m * (n + 0.5) / kParts).lost_per_m / double{kParts};
    Channels<Layer> down, up;
    for (int c = 0; c < 3; ++c) {
      down[c] = make_layer(air, slab, c, all.sine, false);
      up[c] = make_layer(air, slab, c, all.sine, true);
    }
    all.down.push_back(down);
    all.up.push_back(up);
  }
  return all;
}

LayeredLight scatter_in_layers(const Atmosphere& atmosphere, const Layers& layers, double sine) {
  LayeredSky sky(layers, sine);
  sky.scatter(sun_light(atmosphere, layers, sine));
  return sky.light();
}

}  // namespace swell::sky
