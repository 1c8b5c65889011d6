#include "render/sky/cloud_volume.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "math/for_each_row.h"
#include "math/random.h"
#include "texture/improved_noise.h"

namespace swell::render {
namespace {

constexpr int kVolumeSide = 1 << CloudVolume::kSideLog2;
constexpr int kDetailSide = 1 << CloudVolume::kDetailSideLog2;
constexpr int kLayerLevels = 32, kPlacedLevels = 64;
constexpr double kBaseEdge_m = 60.0;  // over which a cloud's flat lower side becomes dense

std::uint8_t to_byte(double part) {
  return static_cast<std::uint8_t>(std::clamp(part, 0.0, 1.0) * 255.0 + 0.5);
}

std::uint8_t form_byte(double form) {
  return to_byte((form - kFormLow) / static_cast<double>(kFormHigh - kFormLow));
}

// Round forms with creases between them: the magnitude of noise, in octaves.
// Source: K. Perlin, An Image Synthesizer, 1985 (turbulence).
std::vector<std::uint8_t> make_detail(std::uint64_t seed, Workers& workers) {
  constexpr int n = kDetailSide, kFirst = 4, kOctaves = 3;
  constexpr double kMost = 1.0;  // of the sum: hardly ever more
  const texture::ImprovedNoise noise(seed);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(n) * n * n);
  for_each_row(n * n, workers, [&](int row) {
    for (int x = 0; x < n; ++x) {
      double sum = 0.0, gain = 1.0;
      for (int octave = 0, cells = kFirst; octave < kOctaves; ++octave, cells *= 2, gain *= 0.5) {
        const double scale = static_cast<double>(cells) / n;
        sum +=
            gain * std::abs(noise.noise3(scale * x, scale * (row % n), scale * (row / n), cells));
      }
      bytes[static_cast<std::size_t>(row) * n + x] = to_byte(sum / kMost);
    }
  });
  return bytes;
}

// Returns the detail between its points, as a part of its greatest value; x, y and z in periods.
double detail_at(const std::vector<std::uint8_t>& bytes, double x, double y, double z) {
  constexpr int n = kDetailSide;
  const auto split = [](double v, int& cell) {
    const double scaled = (v - std::floor(v)) * n;
    cell = static_cast<int>(scaled) & (n - 1);
    return scaled - std::floor(scaled);
  };
  int i = 0, j = 0, k = 0;
  const double s = split(x, i), t = split(y, j), u = split(z, k);
  const auto at = [&](int di, int dj, int dk) {
    return static_cast<double>(bytes[static_cast<std::size_t>(
        (((k + dk) & (n - 1)) * n + ((j + dj) & (n - 1))) * n + ((i + di) & (n - 1)))]);
  };
  const auto edge = [&](int dj, int dk) { return std::lerp(at(0, dj, dk), at(1, dj, dk), s); };
  const auto face = [&](int dk) { return std::lerp(edge(0, dk), edge(1, dk), t); };
  return std::lerp(face(0), face(1), u) / 255.0;
}

// What a small part of the detail's mean is.
constexpr double kMeanDetail = 0.33;

// ---- A layer

// Noise of mean 0 and deviation 1 over a layer's columns, which repeats.
std::vector<double> make_columns(std::uint64_t seed, Workers& workers) {
  constexpr int kOctaves = 4;
  const texture::ImprovedNoise noise(seed);
  std::vector<double> columns(static_cast<std::size_t>(kVolumeSide) * kVolumeSide);
  for_each_row(kVolumeSide, workers, [&](int y) {
    for (int x = 0; x < kVolumeSide; ++x) {
      double sum = 0.0, gain = 1.0;
      int cells = scene::kCloudPeriods;
      for (int octave = 0; octave < kOctaves; ++octave, cells *= 2, gain *= 0.5) {
        const double scale = static_cast<double>(cells) / kVolumeSide;
        sum += gain * noise.noise3(scale * x, scale * y, 0.37 + 11.0 * octave, cells);
      }
      columns[static_cast<std::size_t>(y) * kVolumeSide + x] = sum;
    }
  });
  double mean = 0.0, variance = 0.0;
  for (const double v : columns) mean += v / static_cast<double>(columns.size());
  for (double& v : columns) {
    v -= mean;
    variance += v * v / static_cast<double>(columns.size());
  }
  for (double& v : columns) v /= std::sqrt(variance);
  return columns;
}

// The value that so much of a set lies under.
double quantile(std::vector<double> values, double part) {
  const auto n = static_cast<std::size_t>(part * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(n), values.end());
  return values[n];
}

// The small form's byte at a voxel's place and a point of its height.
std::uint8_t bulge_byte(const std::vector<std::uint8_t>& detail, int x, int y, int point) {
  constexpr int n = kDetailSide, wrap = n - 1;
  return detail[static_cast<std::size_t>(((point & wrap) * n + (y & wrap)) * n + (x & wrap))];
}

// A layer's form by its parts, without columns.
struct LayerParts {
  const CloudVolume& volume;
  const std::vector<std::uint8_t>& detail;

  double point_of(double level) const {
    return level * static_cast<double>(volume.level_m) / volume.voxel_m;
  }
  double at(int x, int y, int level) const {
    const double point = point_of(level);
    const int low = static_cast<int>(point);
    const double bulge =
        std::lerp(static_cast<double>(bulge_byte(detail, x, y, low)),
                  static_cast<double>(bulge_byte(detail, x, y, low + 1)), point - low);
    return static_cast<double>(volume.bulge) * bulge / 255.0 - risen(level);
  }
  // The most between a level and the next.
  double most(int x, int y, int level) const {
    int bulge = 0;
    const int last = static_cast<int>(point_of(level + 1)) + 1;
    for (int point = static_cast<int>(point_of(level)); point <= last; ++point)
      bulge = std::max(bulge, int{bulge_byte(detail, x, y, point)});
    return static_cast<double>(volume.bulge) * bulge / 255.0 - risen(level);
  }
  double risen(int level) const {
    const double height = static_cast<double>(level) / (volume.form.levels - 1);
    const double lean = std::lerp(height, 1.0, static_cast<double>(volume.towers));
    return static_cast<double>(volume.rise) * height * lean * lean;
  }
  // Where the base and the top end it, above a level and below the next.
  double limit(int level) const {
    const int levels = volume.form.levels - 1 - level;
    return static_cast<double>(volume.limit_per_m * volume.level_m) * std::min(level + 1, levels);
  }
};

void pack_columns(const std::vector<double>& columns, CloudVolume& volume) {
  double most = 0.0;
  for (const double column : columns) most = std::max(most, std::abs(column));
  volume.column_step = static_cast<float>(most / 32767.0);
  const auto at = [&](int x, int y) {
    const std::size_t column =
        static_cast<std::size_t>(y & (kVolumeSide - 1)) * kVolumeSide + (x & (kVolumeSide - 1));
    const double steps = std::nearbyint(columns[column] / most * 32767.0);
    return std::uint32_t{static_cast<std::uint16_t>(static_cast<std::int16_t>(steps))};
  };
  volume.columns.reserve(static_cast<std::size_t>(kVolumeSide) * (kVolumeSide + 1));
  for (int y = 0; y < kVolumeSide; ++y)
    for (int x = 0; x <= kVolumeSide; ++x) volume.columns.push_back(at(x, y) | at(x, y + 1) << 16);
}

// Noise over the plane says where clouds stand, how high they tower follows from it, and round
// forms bulge their sides and tops. Fills `most` with the forms' greatest values between a level
// and the next.
void make_layer(const scene::CloudField& field, const std::vector<std::uint8_t>& detail,
                CloudVolume& volume, Workers& workers, std::vector<std::uint8_t>& most) {
  constexpr double kBulge = 1.5;  // of the round forms, in deviations of the noise
  const double per_edge = kEdge_m * 6.0 / field.size_m;  // deviations in kEdge_m of a cloud's side
  std::vector<double> columns = make_columns(field.seed, workers);
  const double cover = std::clamp(field.cover, 0.0, 1.0);
  const double rise =
      std::max(quantile(columns, 0.9995) - quantile(columns, 1.0 - cover) + 0.25 * kBulge, 0.7);
  const double cut = static_cast<double>(volume.cut) * (1.0 - kMeanDetail);
  volume.bulge = static_cast<float>(kBulge / per_edge);
  volume.rise = static_cast<float>(rise / per_edge);
  volume.towers = static_cast<float>(field.towers);
  volume.limit_per_m = static_cast<float>((1.0 + cut) / kBaseEdge_m);

  // As many columns as asked for have a cloud where small forms cut as deep as they do on average.
  const LayerParts parts{volume, detail};
  const int levels = volume.form.levels;
  std::vector<double> greatest(columns.size());
  for_each_row(kVolumeSide, workers, [&](int y) {
    for (int x = 0; x < kVolumeSide; ++x) {
      double part = -1e9;
      for (int level = 0; level < levels; ++level)
        if (level * static_cast<double>(volume.level_m) >= kBaseEdge_m)
          part = std::max(part, parts.at(x, y, level));
      const std::size_t column = static_cast<std::size_t>(y) * kVolumeSide + x;
      greatest[column] = columns[column] / per_edge + part;
    }
  });
  double threshold = quantile(greatest, 1.0 - cover) - (cut + 0.72);
  if (cover >= 1.0) threshold = -1e3;
  if (cover <= 0.0) threshold = 1e3;
  for (double& column : columns) column = column / per_edge - threshold;
  pack_columns(columns, volume);
  for_each_row(levels * kVolumeSide, workers, [&](int row) {
    const int level = row / kVolumeSide, y = row % kVolumeSide;
    for (int x = 0; x < kVolumeSide; ++x) {
      const double form =
          columns[static_cast<std::size_t>(y) * kVolumeSide + x] + parts.most(x, y, level);
      most[static_cast<std::size_t>(row) * kVolumeSide + x] =
          form_byte(std::min(form, parts.limit(level)));
    }
  });
}

// ---- Placed clouds

// Where p lies in an ellipsoid: 1 in its middle, 0 on its surface, less outside.
struct Ellipsoid {
  glm::dvec3 middle_m, radius_m;
  double factor = 1.0;

  double operator()(glm::dvec3 p) const {
    const glm::dvec3 q = (p - middle_m) / radius_m;
    return 1.0 - glm::dot(q, q);
  }
};

// F' = F + sum of f_i R_i, R_i = Q_i^3 where Q_i >= 0, else 0.
struct PerturbedForm {
  Ellipsoid base;
  std::vector<Ellipsoid> perturbations;

  double operator()(glm::dvec3 p) const {
    double sum = base(p);
    for (const Ellipsoid& perturbation : perturbations) {
      const double q = std::max(perturbation(p), 0.0);
      sum += perturbation.factor * q * q * q;
    }
    return sum;
  }
};

PerturbedForm make_form(const scene::Cumulus& cloud, double base_m) {
  const glm::dvec3 radius(0.42 * cloud.width_m, 0.42 * cloud.width_m, 0.8 * cloud.height_m);
  PerturbedForm form{{{cloud.position_m, base_m}, radius}, {}};
  for (int n = 0; n < cloud.lobes; ++n) {
    const auto dice = [&](int k) {
      return random_uniform(cloud.seed, static_cast<std::uint64_t>(8 * n + k));
    };
    const SinCos azimuth = sin_cos_turns(dice(0));
    const double up = 0.1 + 0.85 * dice(1), across = std::sqrt(1.0 - up * up);
    const glm::dvec3 direction(across * azimuth.cos, across * azimuth.sin, up);
    const glm::dvec3 lobe = radius * std::lerp(0.3, 0.55, dice(2));
    form.perturbations.push_back(
        {form.base.middle_m + 0.85 * direction * radius, lobe, std::lerp(0.5, 1.6, dice(3))});
  }
  return form;
}

void make_placed(const scene::CloudField& field, const std::vector<std::uint8_t>& detail,
                 const CloudVolume& volume, Workers& workers, std::vector<std::uint8_t>& bytes) {
  std::vector<PerturbedForm> forms;
  for (const scene::Cumulus& cloud : field.cumulus) forms.push_back(make_form(cloud, field.base_m));
  const double cut = static_cast<double>(volume.cut) * (1.0 - kMeanDetail);
  for_each_row(volume.form.levels * kVolumeSide, workers, [&](int row) {
    const int level = row / kVolumeSide, y = row % kVolumeSide;
    const double z_m = level * static_cast<double>(volume.level_m);
    for (int x = 0; x < kVolumeSide; ++x) {
      const glm::dvec3 p(volume.corner_m + volume.voxel_m * glm::dvec2(x, y), field.base_m + z_m);
      double most = kFormLow;
      for (const PerturbedForm& form : forms) {
        const glm::dvec3 radius_m = form.base.radius_m;
        const glm::dvec2 aside = glm::abs(glm::dvec2(p - form.base.middle_m));
        if (aside.x > 1.8 * radius_m.x || aside.y > 1.8 * radius_m.y) continue;
        const double size_m = 0.5 * (radius_m.x + radius_m.z);
        const double bulges_m = 1.7 * size_m;
        const double bulge = detail_at(detail, p.x / bulges_m, p.y / bulges_m, p.z / bulges_m);
        most = std::max(
            most, (form(p) + field.raggedness * (bulge - kMeanDetail)) * 0.5 * size_m / kEdge_m);
      }
      const bool at_rim = x == 0 || y == 0 || x == kVolumeSide - 1 || y == kVolumeSide - 1;
      const double limits = at_rim ? kFormLow : z_m / kBaseEdge_m * (1.0 + cut);
      bytes[static_cast<std::size_t>(row) * kVolumeSide + x] = form_byte(std::min(most, limits));
    }
  });
}

// The square and the height that hold the placed clouds.
void fit_placed(const scene::CloudField& field, CloudVolume& volume) {
  glm::dvec2 low(1e9), high(-1e9);
  double height_m = 0.0;
  for (const scene::Cumulus& cloud : field.cumulus) {
    const double reach_m = 0.75 * cloud.width_m;
    low = glm::min(low, cloud.position_m - reach_m);
    high = glm::max(high, cloud.position_m + reach_m);
    height_m = std::max(height_m, 1.15 * cloud.height_m);
  }
  const double side_m = std::max(high.x - low.x, high.y - low.y);
  volume.repeats = false;
  volume.voxel_m = side_m / (kVolumeSide - 1);
  volume.corner_m = 0.5 * (low + high) - 0.5 * side_m;
  volume.top_m = volume.base_m + static_cast<float>(height_m);
}

// ---- What is known of forms

// Each cell's greatest of its own byte and those of the two next to it along an axis, whose cells
// lie `stride` apart and are `count`.
void widen(std::vector<std::uint8_t>& cells, std::size_t stride, std::size_t count, bool wraps) {
  const std::size_t span = stride * count;
  std::vector<std::uint8_t> line(span);
  for (std::size_t begin = 0; begin < cells.size(); begin += span) {
    std::copy_n(cells.begin() + static_cast<std::ptrdiff_t>(begin), span, line.begin());
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t before = i > 0 ? i - 1 : wraps ? count - 1 : 0;
      const std::size_t after = i + 1 < count ? i + 1 : wraps ? 0 : i;
      for (std::size_t k = 0; k < stride; ++k)
        cells[begin + i * stride + k] =
            line[before * stride + k] | line[i * stride + k] | line[after * stride + k];
    }
  }
}

// Cells that hold a cloud; then how far it is to the next one of those, by widening them one cell
// at a time. most: of the form at each point of the lattice up to the next level.
void find_empty(const std::vector<std::uint8_t>& most, CloudVolume& volume) {
  constexpr int kCell = CloudVolume::kCell, n = CloudVolume::kCells, kMostSteps = 12;
  const int levels = volume.form.levels, cell_levels = (levels + kCell - 1) / kCell;
  volume.cell_levels = cell_levels;
  std::vector<std::uint8_t> near(static_cast<std::size_t>(n) * n * cell_levels, 0);
  const auto mark = [&](int x, int y, int z) {
    near[(static_cast<std::size_t>(z) * n + static_cast<std::size_t>(y & (n - 1))) * n +
         static_cast<std::size_t>(x & (n - 1))] = 1;
  };
  const std::uint8_t none = form_byte(static_cast<double>(volume.least_form) - 0.04);
  for (int z = 0; z < levels; ++z)
    for (int y = 0; y < kVolumeSide; ++y)
      for (int x = 0; x < kVolumeSide; ++x) {
        if (most[(static_cast<std::size_t>(z) * kVolumeSide + y) * kVolumeSide + x] <= none)
          continue;
        // Samples in the cells on either side of this point see it.
        for (const int cy : {(y - 1) >> CloudVolume::kCellLog2, y >> CloudVolume::kCellLog2})
          for (const int cx : {(x - 1) >> CloudVolume::kCellLog2, x >> CloudVolume::kCellLog2})
            mark(cx, cy, z >> CloudVolume::kCellLog2);
      }
  std::vector<std::uint8_t> distance(near.size(), 0);
  for (int step = 0; step < kMostSteps; ++step) {
    for (std::size_t i = 0; i < near.size(); ++i)
      distance[i] = static_cast<std::uint8_t>(distance[i] + 1 - near[i]);
    widen(near, 1, n, true);
    widen(near, n, n, true);
    widen(near, static_cast<std::size_t>(n) * n, static_cast<std::size_t>(cell_levels), false);
  }
  distance.resize(distance.size() + 7, 0);
  volume.empty = std::move(distance);
}

void find_light(glm::vec3 to_light, Workers& workers, CloudVolume& volume) {
  constexpr int n = 1 << CloudVolume::kLightSideLog2;
  const int levels = volume.form.levels;
  std::vector<std::uint16_t> light(static_cast<std::size_t>(n) * n * levels);
  for_each_row(levels * n, workers, [&](int row) {
    write_cloud_light_row(volume, to_light, row / n, row % n,
                          light.data() + static_cast<std::ptrdiff_t>(row) * n);
  });
  const auto at = [&](int x, int y, int z) {
    const int level = std::min(z, levels - 1);
    return std::uint32_t{light[static_cast<std::size_t>((level * n + y) * n + (x & (n - 1)))]};
  };
  volume.light.reserve(static_cast<std::size_t>(n + 1) * n * levels);
  for (int z = 0; z < levels; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x <= n; ++x) volume.light.push_back(at(x, y, z) | at(x, y, z + 1) << 16);
  volume.sunlight.resize(static_cast<std::size_t>(kVolumeSide) * kVolumeSide);
  for_each_row(kVolumeSide, workers, [&](int y) {
    write_cloud_sunlight_row(volume, to_light, y,
                             volume.sunlight.data() + static_cast<std::ptrdiff_t>(y) * kVolumeSide);
  });
  double sum = 0.0;
  for (const float v : volume.sunlight) sum += static_cast<double>(v);
  volume.mean_sunlight =
      volume.repeats ? static_cast<float>(sum / static_cast<double>(volume.sunlight.size())) : 1.0f;
}

}  // namespace

CornerVolume pack_corners(int side_log2, int levels, const std::vector<std::uint8_t>& bytes) {
  CornerVolume volume{side_log2, levels, {}};
  const int n = volume.side(), wrap = n - 1;
  const auto at = [&](int x, int y, int z) {
    const int level = std::min(z, levels - 1);
    return std::uint32_t{
        bytes[(static_cast<std::size_t>(level) * n + (y & wrap)) * n + (x & wrap)]};
  };
  volume.entries.reserve(static_cast<std::size_t>(n + 1) * n * levels);
  for (int z = 0; z < levels; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x <= n; ++x)
        volume.entries.push_back(at(x, y, z) | at(x, y, z + 1) << 8 | at(x, y + 1, z) << 16 |
                                 at(x, y + 1, z + 1) << 24);
  return volume;
}

CloudVolume build_cloud_volume(const scene::CloudField& field, glm::vec3 to_light,
                               Workers& workers) {
  CloudVolume volume;
  const bool is_layer = field.kind == scene::CloudKind::kLayer;
  volume.base_m = static_cast<float>(field.base_m);
  volume.top_m = static_cast<float>(field.top_m);
  volume.voxel_m = scene::kCloudPeriods * field.size_m / kVolumeSide;
  if (!is_layer) fit_placed(field, volume);
  volume.form.levels = is_layer ? kLayerLevels : kPlacedLevels;
  volume.form.side_log2 = CloudVolume::kSideLog2;
  volume.level_m = (volume.top_m - volume.base_m) / static_cast<float>(volume.form.levels - 1);
  volume.cut = static_cast<float>(3.0 * field.raggedness);
  volume.extinction_per_m = static_cast<float>(field.extinction_per_m);
  volume.threshold = static_cast<float>(field.threshold);

  std::vector<std::uint8_t> detail = make_detail(field.seed + 1, workers);
  // A few greatest values would have rays look for clouds where hardly ever are some.
  const double most_detail = quantile({detail.begin(), detail.end()}, 0.99) / 255.0;
  for (std::uint8_t& byte : detail) byte = std::min(byte, to_byte(most_detail));
  volume.least_form = volume.cut * static_cast<float>(1.0 - most_detail);
  // As many levels as needed to wrap: one more.
  std::vector<std::uint8_t> wrapped = detail;
  wrapped.insert(wrapped.end(), detail.begin(),
                 detail.begin() + static_cast<std::ptrdiff_t>(kDetailSide) * kDetailSide);
  volume.detail = pack_corners(CloudVolume::kDetailSideLog2, kDetailSide + 1, wrapped);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(kVolumeSide) * kVolumeSide *
                                  volume.form.levels);
  if (is_layer) {
    make_layer(field, detail, volume, workers, bytes);
  } else {
    make_placed(field, detail, volume, workers, bytes);
    volume.form = pack_corners(CloudVolume::kSideLog2, volume.form.levels, bytes);
    constexpr std::size_t kLevel = static_cast<std::size_t>(kVolumeSide) * kVolumeSide;
    for (std::size_t i = 0; i + kLevel < bytes.size(); ++i)
      bytes[i] = std::max(bytes[i], bytes[i + kLevel]);
  }
  find_empty(bytes, volume);
  find_light(to_light, workers, volume);
  return volume;
}

}  // namespace swell::render
