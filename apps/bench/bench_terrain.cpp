// swell-bench terrain: what rays over heights cost, by the size of the map and of the picture; and
// the water boundary of a scene.
#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/bench/bench.h"
#include "apps/bench/ray_picture.h"
#include "apps/bench/terrain_comparison.h"
#include "apps/shared/cpu_name.h"
#include "apps/shared/options.h"
#include "apps/shared/report.h"
#include "terrain/terrain.h"
#include "tools/maps/make_boundary.h"

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
double time_picture(const terrain::HeightPyramid& map, const RayPicture& picture, int runs,
                    Workers& workers) {
  cast_picture(map, picture, workers);
  std::vector<double> ms;
  for (int n = 0; n < runs; ++n) {
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
  fmt::print("{:>8}{:>10}{:>24}{:>24}{:>24}\n", "", "", "behind beams", "from the eye",
             "down to the posts");
  fmt::print("{:>8}{:>10}", "cells", "MB");
  for (int n = 0; n < 3; ++n) fmt::print("{:>8}{:>8}{:>8}", "45 deg", "10 deg", "2 deg");
  fmt::print("\n");
  for (int cells = 512; cells <= bench.largest; cells *= 2) {
    const terrain::HeightPyramid map = make_hills(cells, workers);
    fmt::print("{:>8}{:>10.1f}", cells, 2e-6 * double(map.posts.size() + map.maxima.size()));
    for (const auto& [beams, stops] :
         {std::pair(true, true), std::pair(false, true), std::pair(false, false)})
      for (const double pitch_deg : {45.0, 10.0, 2.0})
        fmt::print("{:>8.2f}",
                   time_picture(map, {bench.width_px, bench.height_px, pitch_deg, beams, stops},
                                bench.runs, workers));
    fmt::print("\n");
  }
}

// Time over the pictures' sizes.
void print_pictures(const TerrainBench& bench, Workers& workers) {
  constexpr int kCells = 2048;
  const terrain::HeightPyramid map = make_hills(kCells, workers);
  fmt::print("\nPictures of other sizes, {} cells a side, down by 10 degrees\n", kCells);
  fmt::print("{:>16}{:>24}{:>24}\n", "", "behind beams", "from the eye");
  fmt::print("{:>16}{:>10}{:>14}{:>10}{:>14}\n", "pixels", "ms", "ns a pixel", "ms", "ns a pixel");
  for (const double scale : {0.5, 0.75, 1.0, 1.5, 2.0}) {
    RayPicture picture;
    picture.width_px = static_cast<int>(scale * bench.width_px);
    picture.height_px = static_cast<int>(scale * bench.height_px);
    fmt::print("{:>16}", fmt::format("{} x {}", picture.width_px, picture.height_px));
    for (const bool beams : {true, false}) {
      picture.beams = beams;
      const double ms = time_picture(map, picture, bench.runs, workers);
      fmt::print("{:>10.2f}{:>14.2f}", ms,
                 1e6 * ms / (double(picture.width_px) * picture.height_px));
    }
    fmt::print("\n");
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
  line.need("--bank-normals", "--make-boundary");
  return {line, [bench] { run_terrain_bench(*bench); }};
}

}  // namespace swell::apps
