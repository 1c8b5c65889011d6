// An approach to the visual imitation of a dynamic sea surface: waves, level of detail, noise.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "apps/bench/lod_flight.h"
#include "apps/papers/paper.h"
#include "apps/papers/shown_water.h"
#include "apps/papers/svg_plot.h"
#include "ocean/open_sea/sea.h"
#include "ocean/spectrum/sea_scale.h"
#include "texture/perlin.h"
#include "tools/figures/lod_figures.h"
#include "tools/figures/wave_figures.h"

namespace swell::apps {
namespace {

constexpr double kGravity_mps2 = 9.81, kWind_mps = 15.0;

PaperItem filter(PaperStudio& studio) {
  const std::string scene = "waves_spectrum_60.toml";
  const ocean::WaveSystem wind = ocean::wave_systems(studio.load(scene).sea).front();
  const double length_m = ocean::peak_wavelength_m(wind);
  const double peak_hz = std::sqrt(kGravity_mps2 / (2.0 * std::numbers::pi * length_m));
  return {"Figure 1",
          "The Pierson-Moskowitz filter in Fourier space, wind of 15 m/s towards 60 degrees",
          scene,
          {studio.write("sea_1_filter", draw_filter(wind, 400))},
          {{"peak frequency 0.13 g / U", "Hz", 0.13 * kGravity_mps2 / kWind_mps, peak_hz,
            Agreement::kSame, 1e-3}},
          ""};
}

PaperItem open_sea(PaperStudio& studio) {
  const std::string scene = "waves_spectrum_60.toml";
  const ocean::SeaDescription described = studio.load(scene).sea;
  const ocean::WaveSystem wind = ocean::wave_systems(described).front();
  const double m0 = ocean::variance_below(wind, std::numeric_limits<double>::infinity());
  return {
      "Figure 2",
      "The open sea by this filter",
      scene,
      {studio.draw("sea_2_open", scene)},
      {{"significant height 0.0246 U^2", "m", 0.0246 * kWind_mps * kWind_mps, 4.0 * std::sqrt(m0),
        Agreement::kSame, 0.02}},
      fmt::format(
          "The waves of this picture are {:.2f} m high: those of one seed, of all lengths that its "
          "patches hold.",
          ocean::Sea(described).significant_height_m())};
}

PaperItem beach(PaperStudio& studio) {
  const std::string file = "waves_beach.toml";
  const ShownWater shown(studio, file);
  const glm::dvec2 middle = shown.middle_m(), half(0.0, 0.5 * shown.side_m());
  const double from = shown.scene.sea.wind_from_rad;
  const MapView view{middle, shown.side_m(), 400, {std::sin(from), std::cos(from)}};
  return {"Figure 3",
          "A coast of linear depth and the waves that run up it, from above and in section",
          file,
          {studio.write("sea_3_above", draw_map(shown.surface, shown.water.terrain(), view)),
           studio.write("sea_3_section",
                        draw_section(shown.surface, shown.water.terrain(), middle - half,
                                     middle + half, "towards the shore"))},
          {},
          ""};
}

double count(int triangles) { return static_cast<double>(triangles); }

std::vector<PaperItem> triangulations(PaperStudio& studio) {
  const std::vector<LodFigure> figures = lod_figures();
  const LodFigure &grid = figures.at(0), &forced = figures.at(1), &split = figures.at(2);
  const std::string grid_file = studio.write("sea_4_grid", grid.svg);
  return {
      {"Figures 4 and 5",
       "A grid of 9 x 9 points in equal triangles, and simplified",
       "",
       {grid_file},
       {{"uniform", "triangles", 256, count(grid.left_triangles)},
        {"simplified", "triangles", 100, count(grid.right_triangles), Agreement::kSame, 3}},
       "Simplified for an eye over the lower left corner; the paper does not say where its was."},
      {"Figure 9",
       "The splitting of one triangle that makes ten new ones",
       "",
       {studio.write("sea_9_forced", forced.svg)},
       {{"new triangles", "", 10, count(forced.right_triangles - forced.left_triangles)}},
       ""},
      {"Figures 8 and 10",
       "Split makes two diamonds' halves into four triangles, Merge takes them back",
       "",
       {studio.write("sea_8_split", split.svg)},
       {{"before", "triangles", 2, count(split.left_triangles)},
        {"after", "triangles", 4, count(split.right_triangles)}},
       ""}};
}

// Level by level a triangle is cut from the middle of its base to its apex.
void add_level(glm::dvec2 a, glm::dvec2 apex, glm::dvec2 b, int level, Sketch& sketch, int& count) {
  if (level == 0) {
    sketch.lines.insert(sketch.lines.end(), {{a, apex}, {apex, b}, {b, a}});
    ++count;
    return;
  }
  const glm::dvec2 middle = 0.5 * (a + b);
  add_level(a, middle, apex, level - 1, sketch, count);
  add_level(apex, middle, b, level - 1, sketch, count);
}

PaperItem bintree_levels(PaperStudio& studio) {
  Sketch sketch;
  PaperItem item{"Figure 6", "Levels 0 to 4 of the triangle bintree", "", {}, {}, ""};
  for (int level = 0; level <= 4; ++level) {
    const double x = 2.0 + 19.5 * level;
    int triangles = 0;
    add_level({x, 20.0}, {x + 9.0, 29.0}, {x + 18.0, 20.0}, level, sketch, triangles);
    sketch.words.push_back({{x + 5.0, 14.0}, fmt::format("level {}", level)});
    item.numbers.push_back({fmt::format("level {}", level), "triangles",
                            static_cast<double>(1 << level), count(triangles)});
  }
  item.pictures = {studio.write("sea_6_levels", sketch_svg(sketch))};
  return item;
}

PaperItem bintree(PaperStudio& studio) {
  Sketch sketch;
  const auto place = [](int level, int i) {
    return glm::dvec2(100.0 * (i + 0.5) / (1 << level), 52.0 - 15.0 * level);
  };
  // The leaves: two of level 1 and 2, four of level 3.
  const auto is_split = [](int level, int i) { return level < 2 ? i == 0 || level == 0 : i == 1; };
  const auto add = [&](const auto& self, int level, int i) -> void {
    const bool split = level < 3 && is_split(level, i);
    sketch.words.push_back({place(level, i) - glm::dvec2(2.0, 3.0), split ? "T" : "[T]"});
    for (int k = 0; split && k < 2; ++k) {
      sketch.lines.push_back({place(level, i) - glm::dvec2(0.0, 4.0), place(level + 1, 2 * i + k)});
      self(self, level + 1, 2 * i + k);
    }
  };
  add(add, 0, 0);
  return {"Figure 7", "A binary tree of triangles; those in brackets are the triangulation",
          "",         {studio.write("sea_7_tree", sketch_svg(sketch))},
          {},         ""};
}

PaperItem noise(PaperStudio& studio) {
  const texture::PerlinNoise smooth(7), linear(7, texture::Interpolation::kLinear);
  Curve points{"random numbers", {}, true}, lines{"linear", {}}, cubic{"cubic", {}};
  double most_off = 0.0;
  for (int i = 0; i <= 12; ++i) {
    points.points.emplace_back(i, smooth.noise1(i));
    most_off = std::max(most_off, std::abs(smooth.noise1(i) - linear.noise1(i)));
  }
  for (int i = 0; i <= 240; ++i) {
    lines.points.emplace_back(0.05 * i, linear.noise1(0.05 * i));
    cubic.points.emplace_back(0.05 * i, smooth.noise1(0.05 * i));
  }
  const std::array curves = {points, lines, cubic};
  return {"Figure 11",
          "From a discrete generator of random numbers to continuous noise by interpolation",
          "",
          {studio.write("sea_11_noise", plot_svg("x", "Noise(x)", curves))},
          {{"by how much interpolations differ on integers", "", 0.0, most_off}},
          ""};
}

PaperItem octaves(PaperStudio& studio) {
  constexpr int kOctaves = 6;
  constexpr double kPersistence = 0.5;
  const texture::PerlinNoise made(7);
  std::vector<Curve> curves;
  double most_off = 0.0;
  for (int octave = 0; octave < kOctaves; ++octave) {
    const double f = 1 << octave, a = std::pow(kPersistence, octave);
    Curve curve{fmt::format("octave {}", octave), {}};
    for (int i = 0; i <= 400; ++i)
      curve.points.emplace_back(0.01 * i, a * made.noise2(0.01 * i * f, 0.0));
    curves.push_back(curve);
  }
  Curve sum{"their sum", {}};
  for (std::size_t i = 0; i <= 400; ++i) {
    double of_octaves = 0.0;
    for (const Curve& curve : curves) of_octaves += curve.points[i].y;
    const double x = 0.01 * static_cast<double>(i);
    const double y = made.fractal2(x, 0.0, kOctaves, kPersistence);
    most_off = std::max(most_off, std::abs(y - of_octaves));
    sum.points.emplace_back(x, y);
  }
  const std::array sums = {sum};
  return {"Figure 12",
          "Six octaves with persistence 0.5, and their sum",
          "",
          {studio.write("sea_12_octaves", plot_svg("x", "octaves", curves)),
           studio.write("sea_12_sum", plot_svg("x", "PerlinNoise(x)", sums))},
          {{"the sum less that of the octaves", "", 0.0, most_off, Agreement::kSame, 1e-12}},
          ""};
}

PaperItem example(PaperStudio& studio) {
  const std::string scene = "papers/sea_13.toml";
  PaperItem item{
      "Figure 13",
      "A piece of sea of 3000 x 2000 m with 1500 triangles: about 17 ms a frame on a Pentium II "
      "of 400 MHz, 9 of them in the module; 3 of 9 in level of detail at 300 MHz",
      scene,
      {studio.draw("sea_13_example", scene)},
      {},
      "Times are the least of 60 frames, here with all light that the paper does not have."};
  const scene::Scene loaded = studio.load(scene);
  const glm::dvec2 size_m = loaded.area.limits_m();
  item.numbers = {{"along", "m", 3000, size_m.x},
                  {"across", "m", 2000, size_m.y},
                  {"drawn", "triangles", 1500,
                   static_cast<double>(studio.statistics().water_triangles), Agreement::kAtMost}};
  const FlightRow flight = measure_flight({.triangles = 1500, .frames = 60}, studio.workers());
  item.numbers.push_back({"level of detail", "ms", 3, flight.lod_ms.median, Agreement::kAtMost});
  item.numbers.push_back({"module", "ms", 9, flight.module_ms.median, Agreement::kAtMost});
  item.numbers.push_back({"frame", "ms", 17, studio.least_frame_ms(scene, 60), Agreement::kAtMost});
  return item;
}

}  // namespace

Paper sea_paper(PaperStudio& studio) {
  Paper paper{
      "Elykov, Belago, Kuzikovsky, Nekrasov: An approach to the visual imitation of a dynamic "
      "sea surface, 2000",
      {filter(studio), open_sea(studio), beach(studio)}};
  std::vector<PaperItem> triangulated = triangulations(studio);
  const std::array rest = {triangulated[0], bintree_levels(studio), bintree(studio),
                           triangulated[2], triangulated[1],        noise(studio),
                           octaves(studio), example(studio)};
  paper.items.insert(paper.items.end(), rest.begin(), rest.end());
  return paper;
}

}  // namespace swell::apps
