// A combined method of visualising functionally defined surfaces and three-dimensional textures.
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/bench/picture_difference.h"
#include "apps/papers/paper.h"
#include "apps/papers/svg_plot.h"
#include "scene/file/implicit_file.h"
#include "sky/fog.h"

namespace swell::apps {
namespace {

PaperItem turboprop(PaperStudio& studio) {
  const std::string form = "forms/turboprop.toml";
  const std::filesystem::path file = studio.scene_path(form);
  const auto parts = static_cast<double>(scene::load_implicit(file.string()).parts.size());
  // A stand-in of 192 triangles a part, 50 bytes each.
  const double as_triangles = parts * 192.0 * 50.0;
  const auto bytes = static_cast<double>(std::filesystem::file_size(file));
  const std::string scene = "papers/functions_1";
  PaperItem item{
      "Figure 1",
      "A turboprop of functions over a terrain: in scattered light, in clouds from the side, and "
      "from "
      "above; data a hundred times smaller than polygons, 30 frames a second on a GTX 950 Ti",
      scene + "a.toml, functions_1b.toml, functions_1c.toml",
      {},
      {{"bytes of triangles over those of the file", "", 100.0, as_triangles / bytes,
        Agreement::kAtLeast}},
      "Two threads of a CPU take the place of the card."};
  for (const char* const part : {"a", "b", "c"}) {
    item.pictures.push_back(
        studio.draw(std::string("functions_1") + part, scene + part + ".toml", {}, {}, 12.0));
    item.numbers.push_back({fmt::format("figure 1{}, the paper's rate was 30", part), "frames/s", 5,
                            1e3 / studio.least_frame_ms(scene + part + ".toml", 5),
                            Agreement::kAtLeast});
  }
  return item;
}

// The projected size of an interval on the map picks the level: 2^-level <= L < 2^-(level - 1).
PaperItem level_of_detail(PaperStudio& studio) {
  Sketch sketch;
  for (int level = 0; level < 4; ++level) {
    const double y = 50.0 - 14.0 * level;
    for (int i = 0; i < 1 << level; ++i) {
      const double from = 10.0 + 80.0 * i / (1 << level), to = 10.0 + 80.0 * (i + 1) / (1 << level);
      sketch.lines.push_back({{from + 0.5, y}, {to - 0.5, y}});
    }
    sketch.words.push_back({{91.0, y - 1.0}, fmt::format("{}", level)});
  }
  sketch.lines.push_back({{20.0, 58.0}, {62.0, 4.0}, true});
  return {
      "Figure 2",
      "The projection of an interval picks the level of the pyramid: 2^-level <= L < 2^-(level - "
      "1)",
      "",
      {studio.write("functions_2_levels", sketch_svg(sketch))},
      {},
      "Our rays walk the same pyramid of maxima, from level to level, as far as a pixel is wide."};
}

PaperItem perturbed_area(PaperStudio& studio) {
  const std::string scene = "papers/functions_3.toml";
  return {
      "Figure 3",
      "The area of a perturbation: a table of heights over a base plane, cut off by a threshold",
      scene,
      {studio.draw("functions_3_table", scene)},
      {},
      "The plate is the rectangle of the table, D_p. Rays find both, and no triangle is drawn."};
}

// The same fog by pixels, which is ours, and by the paper's two methods.
struct FogPictures {
  std::vector<std::string> files;
  PictureDifference by_vertex, by_table;  // from that by pixels
};

FogPictures draw_fog(PaperStudio& studio) {
  FogPictures drawn;
  const auto draw = [&](const std::string& method) {
    const std::vector<std::string> sets = {
        "camera.eye_m=[-30,-60,45]", "camera.pitch_deg=-25",     "air.visibility_m=120",
        "air.fog_top_m=20",          "air.scattering=\"paper\"", "air.method=\"" + method + "\""};
    drawn.files.push_back(studio.draw("functions_4_by_" + method, "harbour.toml", sets));
    return studio.picture().rgba;
  };
  const std::vector<std::uint32_t> by_pixel = draw("pixel");
  drawn.by_vertex = picture_difference(by_pixel, draw("vertex"));
  drawn.by_table = picture_difference(by_pixel, draw("table"));
  return drawn;
}

PaperItem light_model(PaperStudio& studio) {
  Sketch sketch;
  sketch.lines = {{{5.0, 45.0}, {95.0, 45.0}, true},
                  {{5.0, 8.0}, {95.0, 8.0}},
                  {{15.0, 22.0}, {75.0, 8.0}},
                  {{75.0, 8.0}, {95.0, 58.0}},
                  {{15.0, 8.0}, {15.0, 22.0}}};
  sketch.words = {{{70.0, 47.0}, "top of the fog, H"},
                  {{40.0, 3.0}, "ground"},
                  {{5.0, 25.0}, "viewer, h"},
                  {{58.0, 9.5}, "alpha"},
                  {{79.0, 9.5}, "beta"},
                  {{86.0, 30.0}, "sun"},
                  {{44.0, 18.0}, "scattered by mu"}};
  const double l = 0.5, mu_rad = 1.0;
  const double phase =
      (1.0 - l) * (1.0 - l) / std::pow(1.0 + l * l - 2.0 * l * std::cos(mu_rad), 1.5);
  // Equations 14 and 15 of a way that goes down, whose fog begins at its top: by numbers.
  const double b = 0.01, height_m = 40.0, top_m = 60.0, alpha_rad = 0.4, beta_rad = 0.7;
  const double way = b * height_m / std::sin(alpha_rad);
  const double expected = std::exp(-b * top_m / std::sin(beta_rad)) * (1.0 - std::exp(-way));
  const double ours = sky::scattered_by_paper({way, b * (top_m - height_m), -std::sin(alpha_rad)},
                                              b * top_m, std::sin(beta_rad));
  FogPictures fog = draw_fog(studio);
  fog.files.insert(fog.files.begin(), studio.write("functions_4_light", sketch_svg(sketch)));
  return {"Figure 4",
          "The model of light: the top of the fog, the ground, the viewer, and the angles; fog by "
          "pixels, by vertices, and by a table of the Z-buffer's first bits",
          "harbour.toml",
          fog.files,
          {{"phase function S, l = 0.5, 1 rad", "", phase, sky::blinn_phase(std::cos(mu_rad), l),
            Agreement::kSame, 1e-12},
           {"scattered light of equation 15, without I_c and S / B", "", expected, ours,
            Agreement::kSame, 1e-9}},
          fmt::format("Scenes have the light of each point through the fog over it unless they say "
                      "air.scattering = \"paper\", and find fog at each pixel unless they have "
                      "another air.method: by vertices these pictures differ from that by up to {} "
                      "codes of 255, by the table by up to {}.",
                      fog.by_vertex.max, fog.by_table.max)};
}

}  // namespace

Paper functions_paper(PaperStudio& studio) {
  return {
      "S. I. Vyatkin, B. S. Dolgovesov: A combined method of visualising functionally defined "
      "surfaces "
      "and three-dimensional textures, 2019",
      {turboprop(studio), level_of_detail(studio), perturbed_area(studio), light_model(studio)}};
}

}  // namespace swell::apps
