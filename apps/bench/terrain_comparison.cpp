#include "apps/bench/terrain_comparison.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "apps/bench/picture_difference.h"
#include "apps/shared/report.h"
#include "render/frame.h"
#include "scene/camera.h"

namespace swell::apps {
namespace {

constexpr double kSeaLevel_m = 120.0;  // the sea covers the valleys

// A picture of heights that scenes can name, north on top; gone with the object.
class HeightFile {
 public:
  explicit HeightFile(const BenchMap& map)
      : path_(std::filesystem::temp_directory_path() / "swell_bench_terrain.pgm") {
    std::ofstream file(path_, std::ios::binary);
    file << "P5\n" << map.cells << " " << map.cells << "\n65535\n";
    const auto posts = static_cast<std::size_t>(map.cells);
    std::string row(2 * posts, '\0');
    for (std::size_t j = posts; j-- > 0;) {
      for (std::size_t i = 0; i < posts; ++i) {
        const std::uint16_t post = map.posts[j * (posts + 1) + i];
        row[2 * i] = static_cast<char>(post >> 8);
        row[2 * i + 1] = static_cast<char>(post & 0xff);
      }
      file << row;
    }
    if (!file) throw std::runtime_error(path_.string() + ": cannot be written");
  }
  ~HeightFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  HeightFile(const HeightFile&) = delete;
  HeightFile& operator=(const HeightFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

scene::Scene scene_over(const HeightFile& file, const BenchMap& map) {
  scene::Scene scene;
  scene.name = "terrain";
  scene.terrain.emplace();
  scene.terrain->height_image = file.path();
  scene.terrain->metres_per_pixel = map.side_m / map.cells;
  scene.terrain->low_m = -kSeaLevel_m;
  scene.terrain->high_m = 600.0 - kSeaLevel_m;
  return scene;
}

struct BudgetFlight {
  double frame_ms = 0.0;  // median
  render::Target last;
};

// A metre a frame, 580 m over the sea, down by 10 degrees.
BudgetFlight fly(const TerrainComparison& comparison, const render::World& world, int triangles) {
  Workers workers(comparison.threads);
  render::Workspace workspace;
  render::FrameOptions options;
  options.edge_samples = 0;
  options.terrain_triangles = triangles;
  BudgetFlight flight;
  std::vector<double> ms;
  for (int k = 0; k < comparison.frames + 2; ++k) {
    const View view = make_view(
        {-6000.0 + k, 120.0, 700.0 - kSeaLevel_m}, camera_axes(radians(90.0), radians(-10.0), 0.0),
        lens_of_fov(radians(50.0), comparison.width_px, comparison.height_px), 0.25f,
        comparison.width_px, comparison.height_px);
    const render::FrameStatistics statistics =
        render::render_frame(world, view, 5.0, options, workspace, flight.last, workers);
    if (k >= 2) ms.push_back(statistics.frame_ms);
  }
  flight.frame_ms = spread(ms).median;
  return flight;
}

}  // namespace

void compare_terrains(const TerrainComparison& comparison, std::span<const int> cells,
                      const std::function<BenchMap(int cells)>& make_map) {
  fmt::print(
      "\nWhole frames of {} x {}, {} threads, 580 m over a sea in the same hills; median of {} "
      "[ms], and mean difference from 500,000 triangles [of 255]\n",
      comparison.width_px, comparison.height_px, comparison.threads, comparison.frames);
  fmt::print("{:>8}{:>18}{:>9}{:>18}{:>9}{:>9}\n", "cells", "30,000 triangles", "differ",
             "500,000 triangles", "rays", "differ");
  std::vector<int> won;
  for (const int n : cells) {
    const BenchMap map = make_map(n);
    const HeightFile file(map);
    scene::Scene scene = scene_over(file, map);
    const render::World triangles(scene, comparison.threads);
    scene.detail.terrain_method = scene::TerrainMethod::kRays;
    const render::World rays(scene, triangles, comparison.threads);
    const BudgetFlight few = fly(comparison, triangles, 30000),
                       many = fly(comparison, triangles, 500000),
                       by_rays = fly(comparison, rays, 0);
    fmt::print("{:>8}{:>18.2f}{:>9.3f}{:>18.2f}{:>9.2f}{:>9.3f}\n", n, few.frame_ms,
               picture_difference(few.last.rgba, many.last.rgba).mean, many.frame_ms,
               by_rays.frame_ms, picture_difference(by_rays.last.rgba, many.last.rgba).mean);
    if (by_rays.frame_ms < many.frame_ms) won.push_back(n);
  }
  if (!won.empty())
    fmt::print("Rays take less time than 500,000 triangles over {} cells a side\n",
               fmt::join(won, ", "));
}

}  // namespace swell::apps
