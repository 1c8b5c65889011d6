// swell-bench sea-state: how high the waves that are drawn are, and whether that is the sea state
// that the scene asked for; or the same of every code of both scales.
#include <fmt/core.h>

#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>

#include "apps/bench/bench.h"
#include "apps/shared/json.h"
#include "apps/shared/notices.h"
#include "apps/shared/options.h"
#include "apps/shared/report.h"
#include "math/random.h"
#include "ocean/spectrum/sea_scale.h"
#include "scene/water.h"

namespace swell::apps {
namespace {

constexpr int kTimes = 64, kPoints = 1024;
constexpr double kTimeStep_s = 61.7;  // no multiple of a wave's period, over an hour

struct SeaStateBench {
  SceneChoice scene;
  std::string json;
  bool table = false;
};

// What the scene's code allows.
struct Expected {
  std::string_view scale, name;
  int code;
  double low_m, high_m;  // of the significant height
};

std::optional<Expected> expected_state(const scene::Scene& scene) {
  if (scene.douglas) {
    const ocean::SeaScaleStep step = ocean::douglas_step(*scene.douglas);
    return Expected{"douglas", step.name, *scene.douglas, step.low, step.high};
  }
  if (!scene.beaufort) return std::nullopt;
  const ocean::SeaScaleStep step = ocean::beaufort_step(*scene.beaufort);
  const double gravity = scene.sea.gravity_mps2;
  return Expected{"beaufort", step.name, *scene.beaufort,
                  ocean::developed_height_m(step.low, gravity),
                  ocean::developed_height_m(step.high, gravity)};
}

bool is_inside(const Expected& expected, double height_m) {
  if (expected.code == 0) return height_m <= expected.high_m;
  return height_m > expected.low_m && height_m <= expected.high_m;
}

// Points on the water where the sea does not fade: not on the outer tenth of the area.
std::vector<glm::dvec2> open_water_points(const scene::Scene& scene, const scene::Water& water) {
  std::vector<glm::dvec2> points;
  for (std::uint64_t i = 0; i < kPoints; ++i) {
    const glm::dvec2 unit(random_uniform(2, 2 * i), random_uniform(2, 2 * i + 1));
    const glm::dvec2 p = scene.area.centre_m + 0.8 * (unit - 0.5) * scene.area.size_m;
    float ground_m = -1.0f;
    if (water.terrain()) terrain::sample_heights(*water.terrain(), {&p, 1}, {&ground_m, 1});
    if (ground_m < 0.0f) points.push_back(p);
  }
  return points;
}

// 4 standard deviations of the surface's height over place and time.
double measured_height_m(const scene::Scene& scene) {
  const scene::Water water(scene);
  const std::vector<glm::dvec2> points = open_water_points(scene, water);
  if (points.empty()) return 0.0;
  std::vector<float> heights(points.size());
  Workers workers(1);
  ocean::SeaFrame frame;
  double sum = 0.0, squares = 0.0;
  for (int n = 0; n < kTimes; ++n) {
    water.at(n * kTimeStep_s, frame, workers).heights(points, heights);
    for (const double height : heights) sum += height, squares += height * height;
  }
  const double count = static_cast<double>(kTimes) * static_cast<double>(points.size());
  const double mean = sum / count;
  return 4.0 * std::sqrt(std::max(0.0, squares / count - mean * mean));
}

Json sea_state_json(const scene::Scene& scene, const std::optional<Expected>& expected,
                    double height_m) {
  const int wmo = ocean::douglas_code(height_m);
  Json json = {{"scene", scene.name},
               {"significant_height_m", height_m},
               {"wind_speed_mps", scene.sea.wind_speed_mps},
               {"wmo_code", wmo},
               {"wmo_name", ocean::douglas_step(wmo).name}};
  if (!expected) return json;
  json["scale"] = expected->scale;
  json["code"] = expected->code;
  json["name"] = expected->name;
  const Json high = std::isfinite(expected->high_m) ? Json(expected->high_m) : Json(nullptr);
  json["band_m"] = {expected->low_m, high};
  json["inside"] = is_inside(*expected, height_m);
  return json;
}

std::string band_text(const Expected& expected) {
  return fmt::format("{} {} ({}), {:.3g} to {:.3g} m", expected.scale, expected.code, expected.name,
                     expected.low_m, expected.high_m);
}

void run_scene(const SeaStateBench& bench) {
  const scene::Scene scene = load_scene(bench.scene);
  const double height_m = measured_height_m(scene);
  const std::optional<Expected> expected = expected_state(scene);
  const Json json = sea_state_json(scene, expected, height_m);
  if (bench.json != "-")
    fmt::print("{}: significant wave height {:.3g} m, WMO code {} ({}){}\n", scene.name, height_m,
               json["wmo_code"].get<int>(), json["wmo_name"].get<std::string>(),
               expected ? "; asked for " + band_text(*expected) : "");
  if (!bench.json.empty()) write_text(bench.json, json.dump(2) + "\n");
  if (expected && !is_inside(*expected, height_m))
    throw std::runtime_error(
        fmt::format("{}: sea state, got a significant height of {:.3g} m, "
                    "allowed {}",
                    bench.scene.path, height_m, band_text(*expected)));
}

// A scene with nothing but a code, on an area larger than the longest waves.
Json measured_code(const std::string& scale, int code) {
  const scene::Scene scene = scene::parse_scene(
      fmt::format("[sea]\n{} = {}\nsize_m = [12000, 12000]\n", scale, code), "sea-state");
  Json json = sea_state_json(scene, expected_state(scene), measured_height_m(scene));
  const double wind = scene.sea.wind_speed_mps;
  const double gravity = scene.sea.gravity_mps2;
  json["peak_period_s"] = wind > 0.0 ? wind / (0.13 * gravity) : 0.0;
  json["peak_wavelength_m"] = ocean::peak_wavelength_m(wind, gravity);
  return json;
}

std::string table_line(const Json& row) {
  const Json& band = row["band_m"];
  const double low = band[0].get<double>();
  const std::string limits = band[1].is_null()
                                 ? fmt::format("over {:.3g}", low)
                                 : fmt::format("{:.3g} to {:.3g}", low, band[1].get<double>());
  return fmt::format("| {} | {} | {} | {:.3g} | {:.1f} | {:.1f} | {:.0f} |\n",
                     row["code"].get<int>(), row["name"].get<std::string>(), limits,
                     row["significant_height_m"].get<double>(), row["wind_speed_mps"].get<double>(),
                     row["peak_period_s"].get<double>(), row["peak_wavelength_m"].get<double>());
}

void run_table(const SeaStateBench& bench) {
  Json rows = Json::array();
  for (int code = 0; code <= ocean::kMaxDouglas; ++code)
    rows.push_back(measured_code("douglas", code));
  for (int number = 0; number <= ocean::kMaxBeaufort; ++number)
    rows.push_back(measured_code("beaufort", number));
  std::string scale;
  for (const Json& row : rows) {
    if (bench.json == "-") break;
    if (scale != row["scale"].get<std::string>())
      fmt::print(
          "{}| {} | name | Hs of the code, m | Hs drawn, m | wind U10, m/s | peak, s | "
          "peak, m |\n|---|---|---|---|---|---|---|\n",
          scale.empty() ? "" : "\n", row["scale"].get<std::string>());
    scale = row["scale"];
    fmt::print("{}", table_line(row));
  }
  if (!bench.json.empty()) write_text(bench.json, rows.dump(2) + "\n");
  for (const Json& row : rows)
    if (!row["inside"].get<bool>())
      throw std::runtime_error(fmt::format("sea state, got one outside its band: {}", row.dump()));
}

void run_sea_state(const SeaStateBench& bench) {
  if (bench.table == !bench.scene.path.empty())
    throw OptionError(bench.table
                          ? "command line: --table, got it with --scene, allowed one of them"
                          : "command line: --scene, got none, allowed it or --table");
  check_text_place(bench.json);
  bench.table ? run_table(bench) : run_scene(bench);
}

}  // namespace

BenchMode add_bench_sea_state(CommandLine& program) {
  const auto bench = std::make_shared<SeaStateBench>();
  CommandLine line = program.add_mode(
      "sea-state", "Wave height of a scene's sea; fails if it is not the sea state asked for");
  add_scene_options(line, bench->scene);
  line.add_flag("--table", bench->table, "Measure every code of both scales instead");
  add_json_option(line, bench->json);
  return {line, [bench] { run_sea_state(*bench); }};
}

}  // namespace swell::apps
