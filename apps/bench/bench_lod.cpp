// swell-bench lod: what level of detail costs, and what each triangulation of the sea leaves out.
#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <span>

#include "apps/bench/bench.h"
#include "apps/bench/lod_comparison.h"
#include "apps/bench/lod_flight.h"
#include "apps/shared/cpu_name.h"
#include "apps/shared/json.h"
#include "apps/shared/options.h"
#include "apps/shared/report.h"
#include "tools/figures/lod_figures.h"

namespace swell::apps {
namespace {

constexpr int kBudgets[] = {1500, 10000, 50000, 200000};

struct LodBench {
  int triangles = 0, frames = 300;  // 0: kBudgets
  double speed_mps = 30.0;
  int operations = 0, groups = 1;
  bool compare = false;
  int threads = available_cpus();
  std::string simd, json, figures;
};

std::vector<FlightRow> measure_flights(const LodBench& bench, Workers& workers) {
  const auto fly = [&](int triangles, double speed_mps) {
    return measure_flight({triangles, bench.frames, speed_mps, bench.operations, bench.groups},
                          workers);
  };
  if (bench.triangles > 0) return {fly(bench.triangles, bench.speed_mps)};
  std::vector<FlightRow> rows;
  for (const int triangles : kBudgets) rows.push_back(fly(triangles, bench.speed_mps));
  rows.push_back(fly(kBudgets[2], 0.0));
  return rows;
}

void write_figures(const std::string& folder) {
  for (const LodFigure& figure : lod_figures()) {
    write_text((std::filesystem::path(folder) / figure.file).string(), figure.svg);
    fmt::print("{}: {} and {} triangles\n", figure.file, figure.left_triangles,
               figure.right_triangles);
  }
}

Json flight_json(const FlightRow& r) {
  return {{"triangles", r.triangles},
          {"speed_mps", r.speed_mps},
          {"lod_ms", r.lod_ms.median},
          {"lod_p95_ms", r.lod_ms.p95},
          {"module_ms", r.module_ms.median},
          {"module_p95_ms", r.module_ms.p95},
          {"ns_per_leaf", r.ns_per_leaf()},
          {"splits", r.splits},
          {"merges", r.merges},
          {"frames", r.frames}};
}

Json comparison_json(std::span<const ComparisonRow> rows) {
  Json json = Json::array();
  for (const ComparisonRow& r : rows)
    json.push_back(
        {{"view", r.view},
         {"triangulation", r.triangulation},
         {"triangles", r.triangles},
         {"height_px",
          {{"median", r.height_px.median}, {"p95", r.height_px.p95}, {"max", r.height_px.max}}},
         {"silhouette_px", {{"mean", r.silhouette_mean_px}, {"max", r.silhouette_px.max}}},
         {"triangulate_ms", r.triangulate_ms}});
  return json;
}

// The first row stands for all where one is asked for.
Json lod_json(std::span<const FlightRow> flights, std::span<const ComparisonRow> comparison) {
  Json json = flight_json(flights.front());
  json["rows"] = Json::array();
  for (const FlightRow& row : flights) json["rows"].push_back(flight_json(row));
  if (!comparison.empty()) json["triangulations"] = comparison_json(comparison);
  json["cpu"] = cpu_name();
  return json;
}

void run_lod_bench(const LodBench& bench) {
  if (!bench.figures.empty()) return write_figures(bench.figures);
  select_simd(bench.simd);
  check_text_place(bench.json);
  Workers workers(bench.threads);
  const std::vector<FlightRow> flights = measure_flights(bench, workers);
  const std::vector<ComparisonRow> comparison =
      bench.compare ? compare_triangulations({}, workers) : std::vector<ComparisonRow>{};
  if (bench.json != "-") {
    fmt::print("{}", flight_table(flights));
    if (bench.compare) fmt::print("\n{}", comparison_table(comparison));
  }
  if (!bench.json.empty()) write_text(bench.json, lod_json(flights, comparison).dump(2) + "\n");
}

}  // namespace

BenchMode add_bench_lod(CommandLine& program) {
  const auto bench = std::make_shared<LodBench>();
  CommandLine line = program.add_mode(
      "lod",
      "Level of detail along a low flight, 60 frames a second, over four sine waves. lod_ms: adapt "
      "the triangulation and extract its mesh; module_ms: that, and heights, normals and texture "
      "coordinates of its vertices. Medians; splits and merges of all frames together. Without "
      "--triangles a table of sizes, the last row with a still camera");
  add_integer(line, "--triangles", bench->triangles, 2, 1000000, "Triangles to keep");
  add_integer(line, "--frames", bench->frames, 1, 1000000, "Frames to measure");
  add_number(line, "--speed", bench->speed_mps, 0.0, 100.0, "Of the flight, m/s; 0 stands still");
  add_integer(line, "--operations", bench->operations, 1, 1000000,
              "Splits and merges a frame at most, the most important first");
  add_integer(line, "--groups", bench->groups, 1, 64,
              "Groups of priorities, one of which is worked out anew in a frame");
  line.add_flag("--compare", bench->compare,
                "Also ROAM, the radial and a uniform grid and the plane of one sea: error in "
                "pixels and time");
  add_machine_options(line, bench->threads, bench->simd);
  add_json_option(line, bench->json);
  line.add_text("--figures", "FOLDER", bench->figures,
                "Measure nothing; draw the paper's figures of triangulations as SVG files");
  return {line, [bench] { run_lod_bench(*bench); }};
}

}  // namespace swell::apps
