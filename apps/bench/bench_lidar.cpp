// swell-bench lidar: how many points a second the scene gives to lidars at its camera.
#include <fmt/core.h>

#include <memory>
#include <string>
#include <vector>

#include "apps/bench/bench.h"
#include "apps/shared/cpu_name.h"
#include "apps/shared/json.h"
#include "apps/shared/notices.h"
#include "apps/shared/options.h"
#include "apps/shared/report.h"
#include "math/elementary.h"
#include "render/measure/lidar_patterns.h"
#include "render/world/world.h"
#include "render/world_view.h"

namespace swell::apps {
namespace {

struct LidarBench {
  SceneChoice scene;
  std::string simd, json;
  int threads = available_cpus();
};

struct Pattern {
  std::string name;
  std::vector<render::LidarBeam> beams;
};

// One of each model that turns, and a grid of as many columns.
std::vector<Pattern> all_patterns() {
  constexpr int kColumns = 1024;
  std::vector<Pattern> patterns;
  for (const render::SpinningModel& model : render::spinning_models())
    patterns.push_back({std::string(model.name), spinning_beams(model, {.columns = kColumns})});
  patterns.push_back({"grid", render::grid_beams({.width = kColumns,
                                                  .height = 64,
                                                  .width_rad = radians(70.0),
                                                  .height_rad = radians(25.0)})});
  return patterns;
}

// Where the scene's camera is at time 0, level, ahead as it looks.
render::SensorPose camera_pose(const render::World& world, Workers& workers) {
  ocean::SeaFrame sea;
  const View view = render::world_view(world, 0.0, 64, 36, sea, workers);
  const glm::dvec3 ahead = view.forward;
  return {view.eye_world, glm::angleAxis(atan2(ahead.y, ahead.x), glm::dvec3(0.0, 0.0, 1.0))};
}

// Of one scan each 0.1 s, whose first one is not counted.
Json row_of(const Pattern& pattern, const render::SensorPose& pose, render::Lidar& lidar,
            Workers& workers) {
  constexpr int kScans = 20;
  std::vector<render::LidarReturn> returns(pattern.beams.size());
  std::vector<double> scan_ms;
  std::size_t met = 0;
  for (int n = 0; n <= kScans; ++n) {
    const Stopwatch watch;
    lidar.scan({.t_s = 0.1 * n, .begin = pose, .beams = pattern.beams}, returns, workers);
    if (n == 0) continue;
    scan_ms.push_back(watch.elapsed_ms());
    for (const render::LidarReturn& r : returns) met += std::isfinite(r.range_m) ? 1 : 0;
  }
  const Spread ms = spread(scan_ms);
  const auto beams = static_cast<double>(pattern.beams.size());
  return {{"pattern", pattern.name},
          {"points", pattern.beams.size()},
          {"met", static_cast<double>(met) / (beams * kScans)},
          {"scan_ms", {{"median", ms.median}, {"p95", ms.p95}, {"max", ms.max}}},
          {"points_per_s", std::round(beams / (ms.median * 1e-3))}};
}

void run_lidar_bench(const LidarBench& bench) {
  select_simd(bench.simd);
  check_text_place(bench.json);
  const render::World world(load_scene(bench.scene), bench.threads);
  Workers workers(bench.threads);
  const render::SensorPose pose = camera_pose(world, workers);
  const Stopwatch making;
  render::Lidar lidar(world, workers);
  Json json = {{"scene", world.scene().name},
               {"threads", bench.threads},
               {"cpu", cpu_name()},
               {"making_ms", making.elapsed_ms()},
               {"patterns", Json::array()}};
  for (const Pattern& pattern : all_patterns()) {
    json["patterns"].push_back(row_of(pattern, pose, lidar, workers));
    const Json& row = json["patterns"].back();
    if (bench.json != "-")
      fmt::print("{}, {}: {:.2f} ms a scan of {} points ({:.0f} % met), {:.3g} points a second\n",
                 world.scene().name, pattern.name, row["scan_ms"]["median"].get<double>(),
                 pattern.beams.size(), 100.0 * row["met"].get<double>(),
                 row["points_per_s"].get<double>());
  }
  if (!bench.json.empty()) write_text(bench.json, json.dump(2) + "\n");
}

}  // namespace

BenchMode add_bench_lidar(CommandLine& program) {
  const auto bench = std::make_shared<LidarBench>();
  CommandLine line = program.add_mode("lidar", "Lidars at a scene's camera");
  add_scene_options(line, bench->scene);
  line.require("--scene");
  add_machine_options(line, bench->threads, bench->simd);
  add_json_option(line, bench->json);
  return {line, [bench] { run_lidar_bench(*bench); }};
}

}  // namespace swell::apps
