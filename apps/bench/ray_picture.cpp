#include "apps/bench/ray_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "math/random.h"
#include "terrain/height_rays.h"

namespace swell::apps {
namespace {

// A ray through each pixel of a row.
struct Row {
  explicit Row(int width_px)
      : x(static_cast<std::size_t>(width_px)),
        y(x),
        z(x),
        z_t(x),
        z_tt(x),
        begin(x.size(), 0.25f),
        end(x.size(), 1e9f),
        t(x) {}
  std::vector<float> x, y, z, z_t, z_tt, begin, end, t;

  terrain::HeightRays rays() const { return {x, y, z, z_t, z_tt, begin, end}; }
};

}  // namespace

terrain::HeightPyramid make_hills(int cells, Workers& workers) {
  const terrain::Grid grid{glm::dvec2(-0.5 * kHillsSide_m), kHillsSide_m / cells, cells + 1,
                           cells + 1};
  std::vector<std::uint16_t> posts(grid.size());
  workers.for_each(static_cast<std::size_t>(cells) + 1, [&](std::size_t j, int) {
    for (int i = 0; i <= cells; ++i) {
      double height = 0.5, amplitude = 0.25;
      for (int n = 8; n <= cells; n *= 2, amplitude *= 0.5) {
        const double x = double(i) * n / cells, y = double(j) * n / cells;
        const auto x0 = static_cast<std::uint64_t>(x), y0 = static_cast<std::uint64_t>(y);
        const auto at = [&](std::uint64_t a, std::uint64_t b) {
          return random_uniform(static_cast<std::uint64_t>(n), (y0 + b) * 32771 + x0 + a) - 0.5;
        };
        const double u = x - double(x0), v = y - double(y0);
        height += amplitude *
                  std::lerp(std::lerp(at(0, 0), at(1, 0), u), std::lerp(at(0, 1), at(1, 1), u), v);
      }
      posts[grid.index(i, static_cast<int>(j))] =
          static_cast<std::uint16_t>(std::clamp(height, 0.0, 1.0) * 65535.0);
    }
  });
  return terrain::make_height_pyramid(grid, 0.0f, 600.0f / 65535.0f, std::move(posts), {}, workers);
}

void cast_picture(const terrain::HeightPyramid& map, const RayPicture& picture, Workers& workers) {
  const double pitch = picture.pitch_deg * 3.14159265358979 / 180.0;
  const double pixel = 2.0 * 0.466 / picture.height_px;  // 50 degrees high
  const auto detail = picture.stops ? static_cast<float>(pixel) : 0.0f;
  std::vector<Row> rows(static_cast<std::size_t>(workers.thread_count()), Row(picture.width_px));
  workers.for_each(static_cast<std::size_t>(picture.height_px), [&](std::size_t j, int thread) {
    Row& row = rows[static_cast<std::size_t>(thread)];
    const double up = (0.5 * picture.height_px - double(j)) * pixel;
    for (int i = 0; i < picture.width_px; ++i) {
      const auto k = static_cast<std::size_t>(i);
      row.x[k] = static_cast<float>(std::cos(pitch) + up * std::sin(pitch));
      row.y[k] = static_cast<float>((0.5 * picture.width_px - i) * pixel);
      row.z[k] = 700.0f;
      row.z_t[k] = static_cast<float>(up * std::cos(pitch) - std::sin(pitch));
    }
    terrain::cast_rays(map, {-6000.0, 120.0}, detail, row.rays(), row.t);
  });
}

}  // namespace swell::apps
