// swell-bench query: how many heights of the drawn water a program can ask for in a second.
#include <fmt/core.h>
#include <time.h>

#include <memory>

#include "apps/bench/bench.h"
#include "apps/shared/cpu_name.h"
#include "apps/shared/json.h"
#include "apps/shared/notices.h"
#include "apps/shared/options.h"
#include "apps/shared/report.h"
#include "math/random.h"
#include "scene/water.h"

namespace swell::apps {
namespace {

struct QueryBench {
  SceneChoice scene;
  std::string simd, json;
  int threads = available_cpus();
  int points = 65536;
};

std::string model_name(const scene::Scene& scene, const scene::Water& water) {
  if (water.coast()) return scene.coast.model == scene::CoastModel::kBlend ? "blend" : "trains";
  const bool spectrum = !ocean::wave_systems(scene.sea).empty();
  if (spectrum && !scene.sea.sines.empty()) return "spectrum+sines";
  if (spectrum) return "spectrum";
  return scene.sea.sines.empty() ? "flat" : "sines";
}

// Points spread over the sea's area, or 3000 x 2000 m of a larger one, in no order.
std::vector<glm::dvec2> scattered_points(const scene::SeaArea& area, int count) {
  const glm::dvec2 size_m = glm::min(area.limits_m(), glm::dvec2(3000.0, 2000.0));
  std::vector<glm::dvec2> points(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec2 unit(random_uniform(1, 2 * i), random_uniform(1, 2 * i + 1));
    points[i] = area.centre_m + (unit - 0.5) * size_m;
  }
  return points;
}

// CPU time of the calling thread: what other programs do meanwhile does not count.
double thread_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

// The median time of `call` by a clock in ms, repeated for that long.
double median_ms(double run_ms, FunctionRef<double()> clock_ms, FunctionRef<void()> call) {
  std::vector<double> call_ms;
  const Stopwatch run;
  do {
    const double start_ms = clock_ms();
    call();
    call_ms.push_back(clock_ms() - start_ms);
  } while (run.elapsed_ms() < run_ms || call_ms.size() < 5);
  return spread(call_ms).median;
}

// Heights a second of what the surface is made of, each alone, on one thread.
Json layer_rates(const scene::Water& water, const ocean::SeaFrame& frame,
                 std::span<const glm::dvec2> points) {
  std::vector<float> height_m(points.size());
  Json rates = Json::object();
  const auto add = [&](const char* layer, FunctionRef<void()> call) {
    const double call_ms = median_ms(
        200.0, [] { return thread_ms(); }, call);
    rates[layer] = std::round(static_cast<double>(points.size()) / (call_ms * 1e-3));
  };
  if (!frame.patches.empty() || !frame.sines.empty())
    add(frame.patches.empty() ? "sines" : "spectrum",
        [&] { ocean::sample_heights(frame, points, height_m); });
  if (water.coast())
    add("trains", [&] { ocean::sample_trains(water.coast()->trains, 0.0, points, height_m); });
  return rates;
}

void run_query_bench(const QueryBench& bench) {
  select_simd(bench.simd);
  check_text_place(bench.json);
  const scene::Scene scene = load_scene(bench.scene);
  const Stopwatch building;
  const scene::Water water(scene);
  const double setup_ms = building.elapsed_ms();
  ocean::SeaFrame frame;
  Workers workers(bench.threads);
  const scene::WaterSurface surface = water.at(0.0, frame, workers);
  const std::vector<glm::dvec2> points = scattered_points(scene.area, bench.points);
  std::vector<float> height_m(points.size());
  const double ms = median_ms(
      200.0, [] { return thread_ms(); }, [&] { surface.heights(points, height_m); });
  const double advance_ms = median_ms(
      50.0, [&] { return building.elapsed_ms(); },
      [&] { ocean::advance(water.sea(), 0.0, frame, workers); });

  const auto per_s = [&](double call_ms) { return std::round(bench.points / (call_ms * 1e-3)); };
  const Json json = {{"points_per_s", per_s(ms)},
                     {"model", model_name(scene, water)},
                     {"layers_per_s", layer_rates(water, frame, points)},
                     {"points", bench.points},
                     {"scene", scene.name},
                     {"query_ms", ms},
                     {"setup_ms", setup_ms},
                     {"advance_ms", advance_ms},
                     {"cpu", cpu_name()}};
  if (bench.json != "-") {
    fmt::print(
        "{}: {:.3g} heights a second on one core, model {}; a new time {:.2f} ms, set-up "
        "{:.0f} ms\n",
        scene.name, json["points_per_s"].get<double>(), json["model"].get<std::string>(),
        advance_ms, setup_ms);
    for (const auto& [layer, rate] : json["layers_per_s"].items())
      fmt::print("  {} alone: {:.3g} heights a second\n", layer, rate.get<double>());
  }
  if (!bench.json.empty()) write_text(bench.json, json.dump(2) + "\n");
}

}  // namespace

BenchMode add_bench_query(CommandLine& program) {
  const auto bench = std::make_shared<QueryBench>();
  CommandLine line = program.add_mode("query", "Heights of a scene's sea at scattered points");
  add_scene_options(line, bench->scene);
  line.require("--scene");
  add_machine_options(line, bench->threads, bench->simd);
  add_integer(line, "--points", bench->points, 1, 16777216, "Points of one query");
  add_json_option(line, bench->json);
  return {line, [bench] { run_query_bench(*bench); }};
}

}  // namespace swell::apps
