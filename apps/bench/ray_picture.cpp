#include "apps/bench/ray_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "math/random.h"
#include "terrain/height_rays.h"

namespace swell::apps {
namespace {

constexpr int kBeam_px = 8;  // a side of a beam's square of rays, as in a frame

// A ray through each pixel of kBeam_px rows, square after square, and a beam around each square.
struct Band {
  explicit Band(int width_px)
      : beams(static_cast<std::size_t>((width_px + kBeam_px - 1) / kBeam_px)),
        x(beams * kBeam_px * kBeam_px),
        y(x),
        z(x),
        z_t(x),
        z_tt(x),
        begin(x),
        end(x.size(), 1e9f),
        t(x),
        x_low(beams),
        x_high(beams),
        y_low(beams),
        y_high(beams),
        beam_z(beams),
        beam_z_t(beams),
        beam_z_tt(beams),
        floor(beams, -1e9f),
        beam_begin(beams, kBegin),
        t_free(beams) {}

  // Rays begin where their beam may meet something.
  void begin_behind_beams(const terrain::HeightPyramid& map, glm::dvec2 from_world) {
    constexpr std::size_t kRays = kBeam_px * kBeam_px;
    for (std::size_t n = 0; n < beams; ++n) {
      const auto low_and_high = [&](const std::vector<float>& values, float& low, float& high) {
        const auto [first, last] = std::ranges::minmax(std::span(values).subspan(n * kRays, kRays));
        low = first, high = last;
      };
      float z_t_high;
      low_and_high(x, x_low[n], x_high[n]);
      low_and_high(y, y_low[n], y_high[n]);
      low_and_high(z_t, beam_z_t[n], z_t_high);
      beam_z[n] = z[n * kRays];
    }
    terrain::cast_beams(
        map, from_world,
        {x_low, x_high, y_low, y_high, beam_z, beam_z_t, beam_z_tt, floor, beam_begin}, t_free);
    for (std::size_t k = 0; k < begin.size(); ++k) begin[k] = t_free[k / kRays];
  }

  terrain::HeightRays rays() const { return {x, y, z, z_t, z_tt, begin, end}; }

  static constexpr float kBegin = 0.25f;
  std::size_t beams;
  std::vector<float> x, y, z, z_t, z_tt, begin, end, t;
  std::vector<float> x_low, x_high, y_low, y_high, beam_z, beam_z_t, beam_z_tt, floor, beam_begin,
      t_free;
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
  const glm::dvec2 from_world(-6000.0, 120.0);
  const double pitch = picture.pitch_deg * 3.14159265358979 / 180.0;
  const double pixel = 2.0 * 0.466 / picture.height_px;  // 50 degrees high
  const auto detail = picture.stops ? terrain::kBlock_px * static_cast<float>(pixel) : 0.0f;
  std::vector<Band> bands(static_cast<std::size_t>(workers.thread_count()), Band(picture.width_px));
  const auto draw_band = [&](std::size_t number, int thread) {
    Band& band = bands[static_cast<std::size_t>(thread)];
    for (std::size_t k = 0; k < band.x.size(); ++k) {
      const int in_square = static_cast<int>(k) % (kBeam_px * kBeam_px);
      const int i = static_cast<int>(k) / (kBeam_px * kBeam_px) * kBeam_px + in_square % kBeam_px;
      const int j = static_cast<int>(number) * kBeam_px + in_square / kBeam_px;
      const double up = (0.5 * picture.height_px - j) * pixel;
      band.x[k] = static_cast<float>(std::cos(pitch) + up * std::sin(pitch));
      band.y[k] = static_cast<float>((0.5 * picture.width_px - i) * pixel);
      band.z[k] = 700.0f;
      band.z_t[k] = static_cast<float>(up * std::cos(pitch) - std::sin(pitch));
      band.begin[k] = Band::kBegin;
    }
    if (picture.beams) band.begin_behind_beams(map, from_world);
    terrain::cast_rays(map, from_world, detail, band.rays(), band.t);
  };
  workers.for_each(static_cast<std::size_t>((picture.height_px + kBeam_px - 1) / kBeam_px),
                   draw_band);
}

}  // namespace swell::apps
