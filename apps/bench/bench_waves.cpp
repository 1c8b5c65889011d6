// swell-bench waves: figures of a scene's waves, for those who want to see what the models do.
#include <fmt/core.h>

#include <cmath>
#include <memory>
#include <string>

#include "apps/bench/bench.h"
#include "apps/shared/notices.h"
#include "apps/shared/options.h"
#include "apps/shared/output_file.h"
#include "apps/shared/picture_file.h"
#include "apps/shared/report.h"
#include "math/elementary.h"
#include "ocean/spectrum/sea_scale.h"
#include "texture/image/image_io.h"
#include "tools/figures/wave_figures.h"
#include "tools/maps/make_map.h"

namespace swell::apps {
namespace {

using Pair = std::vector<double>;

struct WaveFigures {
  SceneChoice scene;
  std::string filter, map, section;
  double t_s = 0.0, side_m = 0.0;  // side 0: that of the terrain, or the sea's shorter one
  int pixels = 480;
  Pair centre_m, from_m, to_m;  // empty if not given
  MapOptions made;
};

// As a point; `otherwise` if it was not given.
glm::dvec2 point(const char* name, const Pair& value, glm::dvec2 otherwise) {
  if (value.empty()) return otherwise;
  for (const double x : value)
    if (!(std::abs(x) <= 1e6))
      throw OptionError(
          fmt::format("command line: {}, got {}, allowed -1000000 to 1000000 m", name, x));
  return {value[0], value[1]};
}

void check_figure_files(const WaveFigures& figures) {
  if (figures.filter.empty() && figures.map.empty() && figures.section.empty())
    throw OptionError(
        "command line: got no figure to draw, allowed --filter, --map, --section, --make-map");
  if (figures.scene.path.empty())
    throw OptionError("command line: --scene, got none, allowed a scene file");
  if (!figures.filter.empty()) check_picture_file(figures.filter);
  if (!figures.map.empty()) check_picture_file(figures.map);
  check_text_place(figures.section);
}

void write_image(const texture::Image8& image, const std::filesystem::path& path) {
  write_output(path, texture::encode_image(image, path.extension().string()));
}

void write_filter(const WaveFigures& figures, const scene::Scene& scene) {
  const ocean::SeaDescription& sea = scene.sea;
  const std::vector<ocean::WaveSystem> systems = ocean::wave_systems(sea);
  if (systems.empty())
    throw OptionError(fmt::format(
        "command line: --filter, got it for {}, which has no spectrum, allowed scenes with one",
        figures.scene.path));
  write_image(draw_filter(systems.front(), figures.pixels), figures.filter);
  const double length_m = ocean::peak_wavelength_m(systems.front());
  fmt::print("{}: peak at {:.4g} rad/m, a wavelength of {:.4g} m\n", figures.filter,
             2.0 * kPi / length_m, length_m);
}

glm::dvec2 shown_size_m(const scene::SeaArea& area) {
  return glm::min(area.limits_m(), glm::dvec2(4000.0));
}

void write_map(const WaveFigures& figures, const scene::Scene& scene, const scene::Water& water,
               const scene::WaterSurface& surface) {
  const terrain::HeightGrid* terrain = water.terrain();
  const glm::dvec2 centre =
      terrain ? terrain->grid.min_world + 0.5 * terrain->grid.size_m() : scene.area.centre_m;
  const glm::dvec2 size_m = shown_size_m(scene.area);
  const double widest = terrain ? terrain->grid.size_m() : std::min(size_m.x, size_m.y);
  const double from = scene.sea.wind_from_rad;
  const MapView view{point("--centre", figures.centre_m, centre),
                     figures.side_m > 0.0 ? figures.side_m : widest,
                     figures.pixels,
                     {sin(from), cos(from)}};
  write_image(draw_map(surface, terrain, view), figures.map);
  fmt::print("{}: {:g} x {:g} m around ({:g}, {:g}), north up\n", figures.map, view.side_m,
             view.side_m, view.centre_m.x, view.centre_m.y);
}

void write_section(const WaveFigures& figures, const scene::Scene& scene, const scene::Water& water,
                   const scene::WaterSurface& surface) {
  const glm::dvec2 half(0.5 * shown_size_m(scene.area).x, 0.0);
  const glm::dvec2 from = point("--from", figures.from_m, scene.area.centre_m - half);
  const glm::dvec2 to = point("--to", figures.to_m, scene.area.centre_m + half);
  if (from == to)
    throw OptionError("command line: --to, got the same point as --from, allowed another one");
  const std::string title = fmt::format("{}, t = {:g} s", scene.name, figures.t_s);
  write_text(figures.section, draw_section(surface, water.terrain(), from, to, title));
}

void run_waves(const WaveFigures& figures) {
  if (!figures.made.file.empty()) return make_map(figures.made);
  check_figure_files(figures);
  const scene::Scene scene = load_scene(figures.scene);
  if (!figures.filter.empty()) write_filter(figures, scene);
  if (figures.map.empty() && figures.section.empty()) return;
  const scene::Water water(scene);
  ocean::SeaFrame frame;
  Workers workers(1);
  const scene::WaterSurface surface = water.at(figures.t_s, frame, workers);
  if (!figures.map.empty()) write_map(figures, scene, water, surface);
  if (!figures.section.empty()) write_section(figures, scene, water, surface);
}

}  // namespace

BenchMode add_bench_waves(CommandLine& program) {
  const auto figures = std::make_shared<WaveFigures>();
  CommandLine line = program.add_mode("waves", "Figures of a scene's waves, and maps of waves");
  add_scene_options(line, figures->scene);
  add_number(line, "--time", figures->t_s, -1e9, 1e9, "Seconds since the scene's start");
  line.add_text("--filter", "F.png", figures->filter,
                "Write the spectrum as a filter of wave vectors");
  line.add_text("--map", "F.png", figures->map, "Write the surface from above");
  line.add_pair("--centre", figures->centre_m, "Middle of the map");
  add_number(line, "--side", figures->side_m, 0.0, 1e6, "Metres along each side; 0: all there is");
  add_integer(line, "--pixels", figures->pixels, 2, 4096, "Side of filter and map");
  line.add_text("--section", "F.svg", figures->section, "Write surface and floor along a line");
  line.add_pair("--from", figures->from_m, "Where the section begins");
  line.add_pair("--to", figures->to_m, "Where it ends");
  add_map_options(line, figures->made);
  for (const char* figure : {"--scene", "--filter", "--map", "--section"})
    line.exclude("--make-map", figure);
  return {line, [figures] { run_waves(*figures); }};
}

}  // namespace swell::apps
