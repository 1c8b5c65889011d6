// swell-bench terrain: what rays over heights cost, by the size of the map and of the picture.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
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

// Of a picture from 700 m up, looking east, down by pitch_deg. [ms]
double time_picture(const terrain::HeightPyramid& map, const TerrainBench& bench, double pitch_deg,
                    bool stops, Workers& workers) {
  const double pitch = pitch_deg * 3.14159265358979 / 180.0;
  const double pixel = 2.0 * 0.466 / bench.height_px;  // 50 degrees high
  const auto detail = stops ? static_cast<float>(pixel) : 0.0f;
  std::vector<std::unique_ptr<Row>> rows;
  for (int n = 0; n < workers.thread_count(); ++n)
    rows.push_back(std::make_unique<Row>(bench.width_px));
  const auto draw = [&] {
    workers.for_each(static_cast<std::size_t>(bench.height_px), [&](std::size_t j, int thread) {
      Row& row = *rows[static_cast<std::size_t>(thread)];
      const double up = (0.5 * bench.height_px - double(j)) * pixel;
      for (int i = 0; i < bench.width_px; ++i) {
        const auto k = static_cast<std::size_t>(i);
        row.x[k] = static_cast<float>(std::cos(pitch) + up * std::sin(pitch));
        row.y[k] = static_cast<float>((0.5 * bench.width_px - i) * pixel);
        row.z[k] = 700.0f;
        row.z_t[k] = static_cast<float>(up * std::cos(pitch) - std::sin(pitch));
      }
      terrain::cast_rays(map, {-6000.0, 120.0}, detail, row.rays(), row.t);
    });
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
  fmt::print("{:>8}{:>10}{:>24}{:>24}\n", "", "", "blocks as small as pixels", "down to the posts");
  fmt::print("{:>8}{:>10}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}\n", "cells", "MB", "45 deg", "10 deg",
             "2 deg", "45 deg", "10 deg", "2 deg");
  for (int cells = 512; cells <= bench.largest; cells *= 2) {
    const terrain::HeightPyramid map = make_map(cells, workers);
    fmt::print("{:>8}{:>10.1f}", cells, 2e-6 * double(map.posts.size() + map.maxima.size()));
    for (const bool stops : {true, false})
      for (const double pitch_deg : {45.0, 10.0, 2.0})
        fmt::print("{:>8.2f}", time_picture(map, bench, pitch_deg, stops, workers));
    fmt::print("\n");
  }
}

// Time over the pictures' sizes.
void print_pictures(const TerrainBench& bench, Workers& workers) {
  constexpr int kCells = 2048;
  const terrain::HeightPyramid map = make_map(kCells, workers);
  fmt::print("\nPictures of other sizes, {} cells a side, down by 10 degrees\n", kCells);
  fmt::print("{:>16}{:>8}{:>14}\n", "pixels", "ms", "ns a pixel");
  for (const double scale : {0.5, 0.75, 1.0, 1.5, 2.0}) {
    TerrainBench other = bench;
    other.width_px = static_cast<int>(scale * bench.width_px);
    other.height_px = static_cast<int>(scale * bench.height_px);
    const double ms = time_picture(map, other, 10.0, true, workers);
    fmt::print("{:>16}{:>8.2f}{:>14.2f}\n", fmt::format("{} x {}", other.width_px, other.height_px),
               ms, 1e6 * ms / (double(other.width_px) * other.height_px));
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
