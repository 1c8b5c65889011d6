// swell-bench terrain: what rays over heights cost, by the size of the map and of the picture.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "apps/bench/bench.h"
#include "apps/bench/terrain_comparison.h"
#include "apps/shared/cpu_name.h"
#include "apps/shared/options.h"
#include "apps/shared/report.h"
#include "math/random.h"
#include "terrain/height_rays.h"
#include "terrain/terrain.h"

namespace swell::apps {
namespace {

constexpr double kSide_m = 16384.0;  // of every map

struct TerrainBench {
  int largest = 4096, width_px = 1280, height_px = 720, runs = 5;
  bool against_triangles = false;
  int threads = available_cpus();
  std::string simd;
};

// Hills up to 600 m high, rough down to the posts: octaves of bilinear noise, 0.57 times as high
// each.
terrain::HeightPyramid make_map(int cells, Workers& workers) {
  const terrain::Grid grid{glm::dvec2(-0.5 * kSide_m), kSide_m / cells, cells + 1, cells + 1};
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

// How rays find their way.
struct Search {
  bool beams;  // begin behind beams; else at the eye
  bool stops;  // at blocks as small as pixels; else go down to the posts
};

// Of a picture from 700 m up, looking east, down by pitch_deg. [ms]
double time_picture(const terrain::HeightPyramid& map, const TerrainBench& bench, double pitch_deg,
                    Search search, Workers& workers) {
  const glm::dvec2 from_world(-6000.0, 120.0);
  const double pitch = pitch_deg * 3.14159265358979 / 180.0;
  const double pixel = 2.0 * 0.466 / bench.height_px;  // 50 degrees high
  const auto detail = search.stops ? static_cast<float>(pixel) : 0.0f;
  std::vector<std::unique_ptr<Band>> bands;
  for (int n = 0; n < workers.thread_count(); ++n)
    bands.push_back(std::make_unique<Band>(bench.width_px));
  const auto draw_band = [&](std::size_t number, int thread) {
    Band& band = *bands[static_cast<std::size_t>(thread)];
    for (std::size_t k = 0; k < band.x.size(); ++k) {
      const int in_square = static_cast<int>(k) % (kBeam_px * kBeam_px);
      const int i = static_cast<int>(k) / (kBeam_px * kBeam_px) * kBeam_px + in_square % kBeam_px;
      const int j = static_cast<int>(number) * kBeam_px + in_square / kBeam_px;
      const double up = (0.5 * bench.height_px - j) * pixel;
      band.x[k] = static_cast<float>(std::cos(pitch) + up * std::sin(pitch));
      band.y[k] = static_cast<float>((0.5 * bench.width_px - i) * pixel);
      band.z[k] = 700.0f;
      band.z_t[k] = static_cast<float>(up * std::cos(pitch) - std::sin(pitch));
      band.begin[k] = Band::kBegin;
    }
    if (search.beams) band.begin_behind_beams(map, from_world);
    terrain::cast_rays(map, from_world, detail, band.rays(), band.t);
  };
  const auto draw = [&] {
    workers.for_each(static_cast<std::size_t>((bench.height_px + kBeam_px - 1) / kBeam_px),
                     draw_band);
  };
  draw();
  std::vector<double> ms;
  for (int n = 0; n < bench.runs; ++n) {
    const Stopwatch clock;
    draw();
    ms.push_back(clock.elapsed_ms());
  }
  return spread(ms).median;
}

// Time over the maps' sizes.
void print_maps(const TerrainBench& bench, Workers& workers) {
  fmt::print("{} x {} rays from 700 m over {} km of hills, {} threads; median of {} [ms]\n",
             bench.width_px, bench.height_px, kSide_m * 1e-3, bench.threads, bench.runs);
  fmt::print("{:>8}{:>10}{:>24}{:>24}{:>24}\n", "", "", "behind beams", "from the eye",
             "down to the posts");
  fmt::print("{:>8}{:>10}", "cells", "MB");
  for (int n = 0; n < 3; ++n) fmt::print("{:>8}{:>8}{:>8}", "45 deg", "10 deg", "2 deg");
  fmt::print("\n");
  for (int cells = 512; cells <= bench.largest; cells *= 2) {
    const terrain::HeightPyramid map = make_map(cells, workers);
    fmt::print("{:>8}{:>10.1f}", cells, 2e-6 * double(map.posts.size() + map.maxima.size()));
    for (const Search search : {Search{true, true}, Search{false, true}, Search{false, false}})
      for (const double pitch_deg : {45.0, 10.0, 2.0})
        fmt::print("{:>8.2f}", time_picture(map, bench, pitch_deg, search, workers));
    fmt::print("\n");
  }
}

// Time over the pictures' sizes.
void print_pictures(const TerrainBench& bench, Workers& workers) {
  constexpr int kCells = 2048;
  const terrain::HeightPyramid map = make_map(kCells, workers);
  fmt::print("\nPictures of other sizes, {} cells a side, down by 10 degrees\n", kCells);
  fmt::print("{:>16}{:>24}{:>24}\n", "", "behind beams", "from the eye");
  fmt::print("{:>16}{:>10}{:>14}{:>10}{:>14}\n", "pixels", "ms", "ns a pixel", "ms", "ns a pixel");
  for (const double scale : {0.5, 0.75, 1.0, 1.5, 2.0}) {
    TerrainBench other = bench;
    other.width_px = static_cast<int>(scale * bench.width_px);
    other.height_px = static_cast<int>(scale * bench.height_px);
    fmt::print("{:>16}", fmt::format("{} x {}", other.width_px, other.height_px));
    for (const bool beams : {true, false}) {
      const double ms = time_picture(map, other, 10.0, {beams, true}, workers);
      fmt::print("{:>10.2f}{:>14.2f}", ms, 1e6 * ms / (double(other.width_px) * other.height_px));
    }
    fmt::print("\n");
  }
}

void run_terrain_bench(const TerrainBench& bench) {
  select_simd(bench.simd);
  Workers workers(bench.threads);
  print_maps(bench, workers);
  print_pictures(bench, workers);
  if (!bench.against_triangles) return;
  std::vector<int> cells;
  for (int n = 512; n <= std::min(bench.largest, terrain::kMaxImageSide); n *= 2)
    cells.push_back(n);
  terrain::HeightPyramid map;
  compare_terrains({bench.width_px, bench.height_px, 2 * bench.runs, bench.threads}, cells,
                   [&](int n) {
                     map = make_map(n, workers);
                     return BenchMap{n, kSide_m, map.posts};
                   });
}

}  // namespace

BenchMode add_bench_terrain(CommandLine& program) {
  const auto bench = std::make_shared<TerrainBench>();
  CommandLine line = program.add_mode(
      "terrain",
      "Rays over maps of heights, one a pixel: time by the map's cells a side, from 512 on, with "
      "the camera down by 45, 10 and 2 degrees");
  add_integer(line, "--cells", bench->largest, 512, 16384, "Of the largest map, a side");
  add_integer(line, "--width", bench->width_px, 1, 16384, "Of the picture, in pixels");
  add_integer(line, "--height", bench->height_px, 1, 16384, "Of the picture, in pixels");
  line.add_flag(
      "--against-triangles", bench->against_triangles,
      "Draw whole frames, too, by rays and with triangles, over maps of up to 4096 cells");
  add_integer(line, "--runs", bench->runs, 1, 1000, "Pictures to time");
  add_machine_options(line, bench->threads, bench->simd);
  return {line, [bench] { run_terrain_bench(*bench); }};
}

}  // namespace swell::apps
