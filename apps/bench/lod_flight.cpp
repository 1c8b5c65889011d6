#include "apps/bench/lod_flight.h"

#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "apps/bench/bench.h"
#include "apps/bench/frame_run.h"
#include "lod/roam.h"
#include "ocean/open_sea/sea.h"
#include "texture/uv_noise.h"

namespace swell::apps {
namespace {

constexpr double kRound_s = 120.0;
constexpr double kPi = std::numbers::pi;
constexpr double kTexture_m = 8.0;  // period of the texture on the sea
constexpr double kNoise_m = 23.0;   // period of the noise that bends its coordinates
constexpr float kNoiseAmplitude = 0.04f;

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

View flight_view(double speed_mps, int frame) {
  const double turned_rad =
      speed_mps > 0.0 ? 2.0 * kPi * (frame / kFramesPerSecond) / kRound_s : 0.0;
  const double radius_m = speed_mps * kRound_s / (2.0 * kPi);
  const glm::dvec3 eye(-radius_m * std::cos(turned_rad), radius_m * std::sin(turned_rad), 10.0);
  return make_view(eye, turned_rad, -0.1, 1.0, 0.25f, 1280, 720);
}

// What a graphics library would be given of each vertex.
struct Vertices {
  std::vector<glm::dvec2> p_world;
  std::vector<float> height_m, slope_x, slope_y;
  std::vector<glm::vec3> normal;
  std::vector<glm::vec2> uv;

  void resize(std::size_t count) {
    p_world.resize(count);
    height_m.resize(count);
    slope_x.resize(count);
    slope_y.resize(count);
    normal.resize(count);
    uv.resize(count);
  }
};

void place(const lod::Domain& domain, const lod::Mesh& mesh, Vertices& v) {
  v.resize(mesh.lattice.size());
  for (std::size_t i = 0; i < v.p_world.size(); ++i) v.p_world[i] = domain.point(mesh.lattice[i]);
}

// Smooth normals: of the waves' own slopes, so that they do not change with the triangles.
void set_normals(const ocean::SeaFrame& sea, Vertices& v) {
  ocean::sample_slopes(sea, v.p_world, v.slope_x, v.slope_y);
  for (std::size_t i = 0; i < v.normal.size(); ++i) {
    const float x = v.slope_x[i], y = v.slope_y[i];
    v.normal[i] = glm::vec3(-x, -y, 1.0f) / std::sqrt(x * x + y * y + 1.0f);
  }
}

// (u, v) = (x, y) / period + amplitude (cos, sin)(noise(x, y, t)).
class TextureCoordinates {
 public:
  void set(double t_s, Vertices& v) {
    noise_.evaluate(0.25 * t_s, cos_, sin_);
    for (std::size_t i = 0; i < v.uv.size(); ++i) {
      const glm::dvec2 cells = v.p_world[i] * (kSize / kNoise_m), low = glm::floor(cells);
      const glm::vec2 offset(bilinear(cos_, glm::ivec2(low), glm::vec2(cells - low)),
                             bilinear(sin_, glm::ivec2(low), glm::vec2(cells - low)));
      const glm::dvec2 straight = v.p_world[i] / kTexture_m;
      v.uv[i] = glm::vec2(straight - glm::floor(straight)) + kNoiseAmplitude * offset;
    }
  }

 private:
  static constexpr int kSize = texture::UvNoiseOptions{}.size;

  static float bilinear(const std::vector<float>& grid, glm::ivec2 p, glm::vec2 t) {
    const auto at = [&](int x, int y) {
      return grid[static_cast<std::size_t>((y & (kSize - 1)) * kSize + (x & (kSize - 1)))];
    };
    const float low = glm::mix(at(p.x, p.y), at(p.x + 1, p.y), t.x);
    return glm::mix(low, glm::mix(at(p.x, p.y + 1), at(p.x + 1, p.y + 1), t.x), t.y);
  }

  texture::UvNoise noise_{{}};
  std::vector<float> cos_ = std::vector<float>(kSize * kSize), sin_ = cos_;
};

}  // namespace

FlightRow measure_flight(const Flight& flight, Workers& workers) {
  const lod::Domain domain{.min_world = {-2048.0, -2048.0}, .size_m = 4096.0, .lattice_bits = 13};
  lod::Roam roam(domain, flight.triangles);
  const ocean::Sea sea(four_sines());
  ocean::SeaFrame sea_frame;
  TextureCoordinates texture_coordinates;
  lod::Mesh mesh;
  std::uint64_t mesh_revision = 0;
  Vertices vertices;
  FlightRow row{.speed_mps = flight.speed_mps, .frames = flight.frames};
  std::vector<double> lod_ms, module_ms;
  const auto bound_m = static_cast<float>(sea.height_bound_m());
  for (int k = -1; k < flight.frames; ++k) {  // frame -1 builds the first triangulation
    const double t_s = k / kFramesPerSecond;
    lod::AdaptRequest request;
    request.view = flight_view(flight.speed_mps, k);
    request.triangle_budget = flight.triangles;
    request.limits.priority_groups = flight.groups;
    if (flight.operations > 0 && k >= 0) request.limits.max_operations = flight.operations;
    request.min_height_m = -bound_m;
    request.max_height_m = bound_m;
    const Stopwatch stopwatch;
    const lod::AdaptStatistics statistics = roam.adapt(request);
    roam.update_mesh(mesh, mesh_revision);
    const double lod_end_ms = stopwatch.elapsed_ms();
    ocean::advance(sea, t_s, sea_frame, workers);
    place(domain, mesh, vertices);
    ocean::sample_heights(sea_frame, vertices.p_world, vertices.height_m);
    set_normals(sea_frame, vertices);
    texture_coordinates.set(t_s, vertices);
    const double module_end_ms = stopwatch.elapsed_ms();
    if (k < 0) continue;
    lod_ms.push_back(lod_end_ms);
    module_ms.push_back(module_end_ms);
    row.triangles = statistics.triangles;
    row.splits += statistics.splits;
    row.merges += statistics.merges;
  }
  row.lod_ms = spread(lod_ms);
  row.module_ms = spread(module_ms);
  return row;
}

std::string flight_table(std::span<const FlightRow> rows) {
  std::string text =
      fmt::format("{:>9} {:>9} {:>9} {:>9} {:>11} {:>10} {:>9} {:>9} {:>9}\n", "triangles",
                  "camera", "lod ms", "p95", "ns/triangle", "module ms", "p95", "splits", "merges");
  for (const FlightRow& r : rows) {
    const std::string camera = r.speed_mps > 0.0 ? fmt::format("{} m/s", r.speed_mps) : "still";
    text += fmt::format(
        "{:>9} {:>9} {:>9.3f} {:>9.3f} {:>11.1f} {:>10.3f} {:>9.3f} {:>9.1f} {:>9.1f}\n",
        r.triangles, camera, r.lod_ms.median, r.lod_ms.p95, r.ns_per_leaf(), r.module_ms.median,
        r.module_ms.p95, static_cast<double>(r.splits) / r.frames,
        static_cast<double>(r.merges) / r.frames);
  }
  return text +
         "lod: triangulation and mesh. module: lod, waves, vertices, normals, texture "
         "coordinates. Splits and merges a frame.\n";
}

}  // namespace swell::apps
