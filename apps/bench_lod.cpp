// swell-bench lod: the triangulation and the displaced mesh of a sea along a low flight.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "apps/bench.h"
#include "apps/options.h"
#include "apps/report.h"
#include "lod/roam.h"
#include "ocean/sea.h"

namespace swell::apps {
namespace {

constexpr double kFramesPerSecond = 60.0;
constexpr double kPi = std::numbers::pi;

struct LodBench {
  int triangles = 30000, frames = 300;
  int threads = available_cpus();
  std::string simd, json;
};

// The sea of the paper's cheapest model: four sine waves, 1.5 m together.
ocean::SeaDescription four_sines() {
  ocean::SeaDescription sea;
  sea.spectrum = false;
  sea.sines = {{.amplitude_m = 0.8, .wavelength_m = 90.0, .to_rad = 0.3},
               {.amplitude_m = 0.4, .wavelength_m = 41.0, .to_rad = 1.1},
               {.amplitude_m = 0.2, .wavelength_m = 17.0, .to_rad = 5.9},
               {.amplitude_m = 0.1, .wavelength_m = 7.0, .to_rad = 0.7}};
  return sea;
}

// Ten metres above the sea at 20 m/s, once clockwise round a circle in two minutes.
View flight_view(int frame) {
  const double heading_rad = 2.0 * kPi * (frame / kFramesPerSecond) / 120.0;
  const double radius_m = 20.0 * 120.0 / (2.0 * kPi);
  const glm::dvec3 eye(-radius_m * std::cos(heading_rad), radius_m * std::sin(heading_rad), 10.0);
  return make_view(eye, heading_rad, -0.1, 1.0, 0.25f, 1280, 720);
}

struct LodSamples {
  std::vector<double> lod_ms, module_ms;
  lod::AdaptStatistics last;
  std::int64_t splits = 0, merges = 0;
};

// The vertices' places in the plane.
void place_vertices(const lod::Domain& domain, const lod::Mesh& mesh,
                    std::vector<glm::dvec2>& p_world) {
  const double spacing_m = domain.size_m / std::ldexp(1.0, domain.lattice_bits);
  p_world.resize(mesh.lattice.size());
  for (std::size_t i = 0; i < p_world.size(); ++i)
    p_world[i] = domain.min_world + spacing_m * glm::dvec2(mesh.lattice[i]);
}

LodSamples measure(const LodBench& bench) {
  const lod::Domain domain{.min_world = {-2048.0, -2048.0}, .size_m = 4096.0, .lattice_bits = 13};
  lod::Roam roam(domain, bench.triangles);
  const ocean::Sea sea(four_sines());
  ocean::SeaFrame sea_frame;
  Workers workers(bench.threads);
  lod::Mesh mesh;
  std::vector<glm::dvec2> p_world;
  std::vector<float> height_m;
  LodSamples samples;
  const auto bound_m = static_cast<float>(sea.height_bound_m());
  for (int k = -1; k < bench.frames; ++k) {  // frame -1 builds the first triangulation
    const lod::AdaptRequest request{.view = flight_view(k),
                                    .triangle_budget = bench.triangles,
                                    .min_height_m = -bound_m,
                                    .max_height_m = bound_m};
    const Stopwatch module;
    samples.last = roam.adapt(request);
    roam.extract_mesh(mesh);
    const double lod_ms = module.elapsed_ms();
    ocean::advance(sea, k / kFramesPerSecond, sea_frame, workers);
    place_vertices(domain, mesh, p_world);
    height_m.resize(p_world.size());
    ocean::sample_heights(sea_frame, p_world, height_m);
    if (k < 0) continue;
    samples.module_ms.push_back(module.elapsed_ms());
    samples.lod_ms.push_back(lod_ms);
    samples.splits += samples.last.splits;
    samples.merges += samples.last.merges;
  }
  return samples;
}

void run_lod_bench(const LodBench& bench) {
  select_simd(bench.simd);
  check_text_place(bench.json);
  const LodSamples samples = measure(bench);
  const double lod_ms = spread(samples.lod_ms).median;
  const double module_ms = spread(samples.module_ms).median;
  const double ns_per_leaf = lod_ms * 1e6 / samples.last.triangles;
  if (bench.json != "-") {
    fmt::print("{} triangles, {} frames\n", samples.last.triangles, bench.frames);
    fmt::print("level of detail    {:.3f} ms a frame, {:.1f} ns a triangle\n", lod_ms, ns_per_leaf);
    fmt::print("with waves' heights {:.3f} ms a frame\n", module_ms);
    fmt::print("splits {}, merges {}\n", samples.splits, samples.merges);
  }
  const Json json = {{"triangles", samples.last.triangles},
                     {"lod_ms", lod_ms},
                     {"module_ms", module_ms},
                     {"ns_per_leaf", ns_per_leaf},
                     {"splits", samples.splits},
                     {"merges", samples.merges},
                     {"frames", bench.frames}};
  if (!bench.json.empty()) write_text(bench.json, json.dump(2) + "\n");
}

}  // namespace

Subcommand add_bench_lod(CLI::App& app) {
  const auto bench = std::make_shared<LodBench>();
  CLI::App* sub = app.add_subcommand(
      "lod",
      "Level of detail along a low flight at 20 m/s, 60 frames a second. lod_ms: adapt the "
      "triangulation and extract its mesh; module_ms: that and four sine waves at its vertices. "
      "Medians; splits and merges of all frames together");
  add_integer(*sub, "--triangles", bench->triangles, 2, 1000000, "Triangles to keep");
  add_integer(*sub, "--frames", bench->frames, 1, 1000000, "Frames to measure");
  add_machine_options(*sub, bench->threads, bench->simd);
  sub->add_option("--json", bench->json, "Write the numbers as JSON; - is standard output")
      ->type_name("FILE");
  return {sub, [bench] { run_lod_bench(*bench); }};
}

}  // namespace swell::apps
