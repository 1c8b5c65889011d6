// swell-bench terrain: what rays over heights cost, by the size of the map and of the picture; and
// the water boundary of a scene.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "apps/bench/bench.h"
#include "apps/bench/make_boundary.h"
#include "apps/bench/ray_picture.h"
#include "apps/bench/terrain_comparison.h"
#include "apps/shared/cpu_name.h"
#include "apps/shared/options.h"
#include "apps/shared/report.h"
#include "terrain/terrain.h"

namespace swell::apps {
namespace {

struct TerrainBench {
  int largest = 4096, width_px = 1280, height_px = 720, runs = 5;
  bool against_triangles = false;
  int threads = available_cpus();
  std::string simd;
  BoundaryOptions boundary;
};

// [ms]
double time_picture(const terrain::HeightPyramid& map, const TerrainBench& bench, double pitch_deg,
                    bool stops, Workers& workers) {
  const RayPicture picture{bench.width_px, bench.height_px, pitch_deg, stops};
  cast_picture(map, picture, workers);
  std::vector<double> ms;
  for (int n = 0; n < bench.runs; ++n) {
    const Stopwatch clock;
    cast_picture(map, picture, workers);
    ms.push_back(clock.elapsed_ms());
  }
  return spread(ms).median;
}

// Time over the maps' sizes.
void print_maps(const TerrainBench& bench, Workers& workers) {
  fmt::print("{} x {} rays from 700 m over {} km of hills, {} threads; median of {} [ms]\n",
             bench.width_px, bench.height_px, kHillsSide_m * 1e-3, bench.threads, bench.runs);
  fmt::print("{:>8}{:>10}{:>24}{:>24}\n", "", "", "blocks as small as pixels", "down to the posts");
  fmt::print("{:>8}{:>10}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}\n", "cells", "MB", "45 deg", "10 deg",
             "2 deg", "45 deg", "10 deg", "2 deg");
  for (int cells = 512; cells <= bench.largest; cells *= 2) {
    const terrain::HeightPyramid map = make_hills(cells, workers);
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
  const terrain::HeightPyramid map = make_hills(kCells, workers);
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
  if (!bench.boundary.file.empty()) return make_boundary(bench.boundary, bench.threads);
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
                     map = make_hills(n, workers);
                     return BenchMap{n, kHillsSide_m, map.posts};
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
  add_boundary_options(line, bench->boundary);
  line.need("--scene", "--make-boundary");
  return {line, [bench] { run_terrain_bench(*bench); }};
}

}  // namespace swell::apps
