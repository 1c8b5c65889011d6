// Modelling interactive water surfaces: periodic maps, the radial grid, shores, rivers.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/papers/paper.h"
#include "apps/papers/shore_layers.h"
#include "apps/papers/shown_water.h"
#include "apps/papers/svg_plot.h"
#include "lod/radial_grid.h"
#include "ocean/coast/surf_fronts.h"
#include "ocean/inland/river_network.h"
#include "ocean/open_sea/periodic_map.h"
#include "terrain/boundary.h"
#include "terrain/height_grid.h"
#include "tools/figures/wave_figures.h"

namespace swell::apps {
namespace {

using enum render::Part;

// From above, with the water of the network's first branching: Q_i = w_i / (sum of w_j) Q_0.
PaperItem network(PaperStudio& studio) {
  const std::string file = "river.toml";
  const ShownWater shown(studio, file);
  PaperItem item{"Figure 1",
                 "A hydrographic network; where channels part, the water does by their widths, and "
                 "none is lost",
                 file,
                 {studio.write("maps_1_network", draw_map(shown.surface, shown.water.terrain(),
                                                          {{300.0, 600.0}, 1000.0, 480, {0, 1}}))},
                 {},
                 ""};
  const ocean::RiverNetwork rivers(shown.scene.rivers, shown.scene.lakes);
  for (const ocean::Joint& joint : rivers.joints()) {
    if (joint.joins) continue;
    const double before = rivers.discharge_m2_s(joint.on, joint.s_m - 0.5);
    const double after = rivers.discharge_m2_s(joint.on, joint.s_m + 0.5);
    item.numbers.push_back({"water of both arms over that before", "", 1.0,
                            (after + joint.discharge_m2_s) / before, Agreement::kSame, 1e-6});
  }
  return item;
}

PaperItem height_map(PaperStudio& studio) {
  const ocean::PeriodicMap map = ocean::make_periodic_map({});
  texture::Image8 image{map.size, map.size, 1, {}};
  float most_jump = 0.0f;
  const auto at = [&](int frame, std::size_t i) {
    return static_cast<float>(
        map.height[static_cast<std::size_t>(frame) * map.frame_samples() + i]);
  };
  const float range = static_cast<float>(map.peak) / map.height_scale;
  for (std::size_t i = 0; i < map.frame_samples(); ++i) {
    image.pixels.push_back(
        static_cast<std::uint8_t>(std::clamp(127.5f * (1.0f + at(0, i) / range), 0.0f, 255.0f)));
    most_jump = std::max(most_jump, std::abs(at(map.frames - 1, i) - at(0, i)));
  }
  float most_step = 0.0f;
  for (int frame = 1; frame < map.frames; ++frame)
    for (std::size_t i = 0; i < map.frame_samples(); ++i)
      most_step = std::max(most_step, std::abs(at(frame, i) - at(frame - 1, i)));
  return {"Figure 2",
          "A map of heights that is periodic in space and in time, from a cellular automaton",
          "",
          {studio.write("maps_2_heights", image)},
          {{"from the last frame to the first over the largest step between frames", "", 1.0,
            static_cast<double>(most_jump / most_step), Agreement::kAtMost}},
          ""};
}

PaperItem radial_grid(PaperStudio& studio) {
  const View view = make_view({0.0, 0.0, 5.0}, 0.0, 0.0, 1.0, 0.25f, 640, 360);
  const lod::RadialLayout layout = lod::radial_layout(view, 20000);
  const double n4 = std::pow(layout.rings - 1, 4);
  const double a1 = (layout.last_m - layout.first_m) / n4;
  Sketch sketch;
  for (int ring = layout.first_ring; ring < layout.rings; ring += 4) {
    const double r = (layout.first_m + a1 * std::pow(ring, 4)) / layout.last_m * 100.0;
    for (int j = 0; j < 24; ++j) {
      const auto place = [&](double radius, int column) {
        const double turn = 3.14159265 * (0.25 + 0.5 * column / 24.0);
        return glm::dvec2(50.0 + 0.6 * radius * std::cos(turn), 0.6 * radius * std::sin(turn));
      };
      sketch.lines.push_back({place(r, j), place(r, j + 1)});
      const double next = (layout.first_m + a1 * std::pow(ring + 4, 4)) / layout.last_m * 100.0;
      sketch.lines.push_back({place(r, j), place(std::min(next, 100.0), j)});
    }
  }
  return {"Figure 3",
          "A radial grid for samples from the map: r = a0 + a1 i^4, from 10 cm to 40 km",
          "",
          {studio.write("maps_3_grid", sketch_svg(sketch))},
          {{"r_0", "m", 0.1, layout.first_m}, {"r_(N-1)", "m", 40000.0, layout.last_m}},
          "Every fourth ring is drawn."};
}

PaperItem grid_in_use(PaperStudio& studio) {
  const std::string scene = "open_ocean.toml";
  const std::array<std::string, 2> level = {"detail.triangulation=radial",
                                            "detail.water_triangles=6000"};
  const std::array<std::string, 4> above = {level[0], level[1], "camera.eye_m[2]=60",
                                            "camera.pitch_deg=-60"};
  return {"Figure 4",
          "The grid in the program, in perspective and from above",
          scene,
          {studio.draw("maps_4_perspective", scene, level, {.wireframe = true}),
           studio.draw("maps_4_above", scene, above, {.wireframe = true})},
          {},
          ""};
}

PaperItem backs(PaperStudio& studio) {
  const std::string scene = "open_ocean.toml";
  std::vector<std::string> sets = {"sea.map_set=ocean", "wind.speed_mps=12", "camera.eye_m[2]=2",
                                   "camera.pitch_deg=-2"};
  const std::string seen = studio.draw("maps_5_seen", scene, sets);
  sets.emplace_back("water.back_sides=tilted");
  return {"Figure 5",
          "Back sides of waves, too bright where their lighting takes the water for flat; normals "
          "that are tilted "
          "a little to the viewer mend it",
          scene,
          {seen, studio.draw("maps_5_tilted", scene, sets)},
          {},
          "The first is as scenes are without the tilt: of rough water the slopes are shown that "
          "an eye sees of it, which "
          "leaves little to mend."};
}

// From the shore out to where the fronts end, at x_m on the scene's coast.
double shore_at(const scene::Water& water, double x_m) {
  const terrain::Grid& grid = water.terrain()->grid;
  double y_m = grid.min_world.y + grid.size_m();
  while (y_m > grid.min_world.y && terrain::height_at(*water.terrain(), {x_m, y_m}) < 0.0)
    y_m -= 0.5;
  return y_m;
}

std::vector<PaperItem> shores(PaperStudio& studio) {
  const std::string scene = "papers/maps_7.toml";
  const ShownWater shown(studio, scene);
  const double x_m = -60.0, y_m = shore_at(shown.water, x_m);
  const ocean::SurfFronts& fronts = *shown.water.fronts();
  const double reach_m = fronts.zone.reach_m;
  const MapView view{{x_m, y_m + 3.2 * reach_m}, 8.5 * reach_m, 480, {0, 1}};
  const std::array<std::string, 3> from_above = {
      fmt::format("camera.eye_m=[{}, {}, {}]", x_m, y_m + 0.6 * reach_m, 1.6 * reach_m),
      "camera.heading_deg=0", "camera.pitch_deg=-89"};
  return {{"Figure 6",
           "The layers of a shore, all by one texture of the water boundary: banks with their "
           "normals, swash, four fronts of surf, caustics, deep water",
           scene,
           {studio.write("maps_6_layers", draw_shore_layers(shown.water, kShown_s, view)),
            studio.write("maps_6_normals", terrain::bank_normals(*shown.water.shore())),
            studio.draw("maps_6_fronts", scene, from_above)},
           {{"fronts, one a component of a vector", "", 4.0, double{ocean::kSurfFronts}}},
           ""},
          {"Figure 7",
           "The function that draws a front of waves near a shore: a long back and a face that "
           "steepens",
           scene,
           {studio.write("maps_7_function", plot_front_function()),
            studio.write("maps_7_surf",
                         draw_section(shown.surface, shown.water.terrain(),
                                      {x_m, y_m + 2.2 * reach_m}, {x_m, y_m - 15.0}, "surf")),
            studio.draw("maps_7_shore", scene)},
           {},
           "The paper gives the function as a drawing; ours has its own formula."}};
}

}  // namespace

Paper maps_paper(PaperStudio& studio) {
  Paper paper{"R. M. Gabdrakhmanov: Modelling interactive water surfaces",
              {network(studio), height_map(studio), radial_grid(studio), grid_in_use(studio),
               backs(studio)}};
  const std::vector<PaperItem> items = shores(studio);
  paper.items.insert(paper.items.end(), items.begin(), items.end());
  return paper;
}

}  // namespace swell::apps
