// Simulation of Real-time Water Surface Based on Cg and OpenGL: what water of two triangles shows.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "apps/bench/optics_table.h"
#include "apps/papers/paper.h"
#include "apps/papers/svg_plot.h"
#include "render/sea/ripple_sequence.h"
#include "render/view/refracted_image.h"

namespace swell::apps {
namespace {

constexpr double kIndex = 1.333, kHalfTurn_rad = 0.5 * std::numbers::pi;
const std::string kHarbour = "harbour.toml", kBumpScene = "papers/optics_water.toml",
                  kTextureScene = "papers/optics_texture.toml";
const std::array<std::string, 3> kFlat = {"sea.amplitude_scale=0", "water.distortion=0",
                                          "wind.speed_mps=0"};

render::FrameOptions without(std::initializer_list<render::Part> parts) {
  return {.without = parts};
}

using enum render::Part;

// Rays from a point, bent or mirrored at a level.
PaperItem principle(PaperStudio& studio) {
  Sketch sketch;
  const glm::dvec2 meets(50.0, 30.0);
  const double air_rad = 0.8, water_rad = std::asin(std::sin(air_rad) / kIndex);
  const auto from_vertical = [&](double angle_rad, double length) {
    return meets + length * glm::dvec2(std::sin(angle_rad), std::cos(angle_rad));
  };
  sketch.lines = {{{5.0, 30.0}, {95.0, 30.0}},
                  {{50.0, 5.0}, {50.0, 55.0}, true},
                  {from_vertical(-air_rad, 30.0), meets},
                  {meets, from_vertical(air_rad, 30.0)},
                  {meets, from_vertical(std::numbers::pi - water_rad, 25.0)}};
  sketch.words = {{{20.0, 50.0}, "A"},
                  {{74.0, 50.0}, "mirrored"},
                  {{8.0, 8.0}, "bent: sin(air) = 1.333 sin(water)"}};
  return {"Figure 1", "The principle of reflection and refraction",
          "",         {studio.write("optics_1_principle", sketch_svg(sketch))},
          {},         ""};
}

PaperItem mirrored_things(PaperStudio& studio) {
  const std::string scene = "pool.toml";
  return {"Figure 2",
          "What the reflection image holds: things wholly above the water are mirrored, those that "
          "cross "
          "it mirrored and clipped, those below left out",
          scene,
          {studio.draw("optics_2_pool", scene),
           studio.draw("optics_2_reflection", scene, {}, without({kRefraction}))},
          {},
          ""};
}

PaperItem indices(PaperStudio& studio) {
  return {"Table 1",
          "Indices of refraction: vacuum 1, air 1.0003, water 1.333, glass 1.5",
          "",
          {},
          {{"water", "", 1.333, studio.load(kHarbour).water.refraction_index}},
          "Air counts as a vacuum, as in the paper's own formula 6; glass is not drawn."};
}

PaperItem depth_ratio(PaperStudio& studio) {
  Curve snell{"by Snell's law", {}, true}, lines{"two lines", {}};
  double most_off = 0.0;
  for (int i = 0; i <= 157; ++i) {
    const double theta = std::min(0.01 * i, kHalfTurn_rad);
    const double s = std::sin(theta) / kIndex;
    const double exact = std::cos(theta) / (kIndex * std::sqrt(1.0 - s * s));
    const auto k = static_cast<double>(render::paper_depth_ratio(static_cast<float>(theta)));
    snell.points.emplace_back(theta, exact);
    lines.points.emplace_back(theta, k);
    most_off = std::max(most_off, std::abs(k - exact));
  }
  const auto at = [](double theta) {
    return static_cast<double>(render::paper_depth_ratio(static_cast<float>(theta)));
  };
  const std::array curves = {snell, lines};
  return {
      "Figure 3",
      "k, the apparent over the true depth, falls from 0.75 to 0; k = 0.75 - 0.16 theta up to 0.8, "
      "then "
      "1.26 - 0.8 theta",
      "",
      {studio.write("optics_3_ratio", plot_svg("theta [rad]", "k", curves))},
      {{"k straight down", "", 0.75, at(0.0), Agreement::kSame, 1e-6},
       {"k at 0.8", "", 0.75 - 0.16 * 0.8, at(0.8), Agreement::kSame, 1e-6},
       {"k at 1.2", "", 1.26 - 0.8 * 1.2, at(1.2), Agreement::kSame, 1e-6},
       {"k along the surface", "", 0.0, at(kHalfTurn_rad), Agreement::kSame, 0.005}},
      fmt::format("The lines are off Snell's law by {:.3f} at most; scenes have it unless they say "
                  "water.refraction = \"paper\".",
                  most_off)};
}

// The figures of one effect each.
std::vector<PaperItem> effects(PaperStudio& studio) {
  return {{"Figure 4",
           "Reflection alone: lerp(waterTexture, image, weight)",
           kTextureScene,
           {studio.draw("optics_4_reflection", kTextureScene, kFlat,
                        without({kRefraction, kSequence, kRipples, kGlitter, kCaustics}))},
           {},
           ""},
          {"Figure 5",
           "Refraction alone: the same with the image of what lies under the water",
           kTextureScene,
           {studio.draw("optics_5_refraction", kTextureScene, kFlat,
                        without({kReflection, kSequence, kRipples, kGlitter, kCaustics}))},
           {},
           ""}};
}

// Details in grey as the colours of deep and of shallow water.
texture::Image8 coloured(const texture::Image8& grey) {
  constexpr std::array<double, 3> kDeep = {20.0, 75.0, 95.0}, kShallow = {60.0, 150.0, 150.0};
  texture::Image8 rgb{grey.width, grey.height, 3, {}};
  for (const std::uint8_t value : grey.pixels)
    for (std::size_t c = 0; c < 3; ++c)
      rgb.pixels.push_back(
          static_cast<std::uint8_t>(std::lround(std::lerp(kDeep[c], kShallow[c], value / 255.0))));
  return rgb;
}

// Files have the north on top.
texture::Image8 turned(const texture::Image8& image) {
  texture::Image8 picture{image.width, image.height, image.channels, {}};
  const auto row = static_cast<std::ptrdiff_t>(image.width) * image.channels;
  for (int y = image.height - 1; y >= 0; --y)
    picture.pixels.insert(picture.pixels.end(), image.pixels.begin() + y * row,
                          image.pixels.begin() + (y + 1) * row);
  return picture;
}

// Pairs of details and normals as files, drawn as the paper's were.
std::vector<PaperItem> bumps(PaperStudio& studio) {
  constexpr int kFrames = 16;
  const std::string frames = fmt::format("ripples.frames={}", kFrames);
  const texture::BumpSequence sequence = render::build_ripple_sequence(
      studio.load(kBumpScene, std::span(&frames, 1)), studio.workers());
  std::vector<std::string> details, normals;
  for (std::size_t n = 0; n < kFrames; ++n) {
    details.push_back(studio.write(fmt::format("optics_6_detail_{:04}", n),
                                   turned(coloured(sequence.details[n]))));
    normals.push_back(
        studio.write(fmt::format("optics_6_normals_{:04}", n), turned(sequence.normals[n])));
  }
  const auto set_files = [&](std::string_view key, std::string_view name) {
    return fmt::format("ripples.{}=\"{}\"", key, studio.picture_path(name).string());
  };
  const std::array<std::string, 4> pairs = {
      frames, set_files("sequence", "optics_6_normals_%04d.png"),
      set_files("detail", "optics_6_detail_%04d.png"), "ripples.pictures=\"normals\""};
  return {{"Figure 6",
           "The pictures of the bump mapping: detail and normals, one pair of a sequence",
           kBumpScene,
           {details.front(), normals.front()},
           {},
           "Made from the heights of a small sea; the paper's details were painted."},
          {"Figure 7",
           "Bumps alone: dot(normal, light) times the detail, from such pairs of files",
           kBumpScene,
           {studio.draw("optics_7_bumps", kBumpScene, pairs,
                        without({kReflection, kRefraction, kGlitter}))},
           {},
           ""},
          {"Figure 8",
           "Distorted by waves, T' = T + C0 T N",
           "papers/optics_distortion.toml",
           {studio.draw("optics_8_distortion", "papers/optics_distortion.toml")},
           {},
           ""}};
}

PaperItem caustics(PaperStudio& studio) {
  const std::array<std::string, 5> from_above = {
      "camera.eye_m=[-15, -330, 5]", "camera.pitch_deg=-89", "sky.sun_elevation_deg=60",
      "water.absorption_per_m=[0, 0, 0]", "water.body_colour=[0, 0, 0]"};
  return {
      "Figure 9",
      "The picture of caustics, thrown on what lies under water",
      "lagoon.toml",
      {studio.draw("optics_9_caustics", "lagoon.toml", from_above,
                   without({kReflection, kGlitter, kRipples}))},
      {},
      "The waves that are drawn make it, frame by frame; the paper's is a sequence of pictures."};
}

PaperItem combined(PaperStudio& studio) {
  return {"Figure 10",
          "All effects together, with the paper's weights and with Fresnel's",
          kTextureScene,
          {studio.draw("optics_10_all", kTextureScene), studio.draw("optics_10_harbour", kHarbour),
           studio.draw("optics_10_dry", kHarbour, {}, without({kWater}))},
          {},
          ""};
}

PaperItem rates(PaperStudio& studio) {
  const render::World& world = studio.world_of(kHarbour);
  FrameSetup setup;
  setup.size = studio.size();
  setup.threads = studio.threads();
  PaperItem item{
      "Table 2",
      "Frames a second without and with water of two triangles, Athlon 2200+ with a GeForce FX "
      "5600: 61 and 55, 46 and 45, 39 and 39; real time is 20 and more",
      kHarbour,
      {},
      {},
      "The card was as fast with the water where vertices kept it busy; here triangles are cheap, "
      "and what takes the time is pixels, as many of water in each row."};
  for (const PaperRow& row : kPaperRows) {
    const auto still = make_still_scene(world, setup, row.triangles, studio.workers());
    // The best of a few, as other programs may run.
    WaterCost cost{1e9, 1e9};
    for (int n = 0; n < 3; ++n) {
      const WaterCost again = measure_water(*still, 3, studio.workers()).cost;
      cost = {std::min(cost.dry_ms, again.dry_ms), std::min(cost.wet_ms, again.wet_ms)};
    }
    item.numbers.push_back({"scene", "triangles", static_cast<double>(row.triangles),
                            static_cast<double>(still->land_triangles + still->object_triangles)});
    item.numbers.push_back({fmt::format("without water (paper: {})", row.dry_per_s), "frames/s", 20,
                            1e3 / cost.dry_ms, Agreement::kAtLeast});
    item.numbers.push_back({fmt::format("with it (paper: {})", row.wet_per_s), "frames/s", 20,
                            1e3 / cost.wet_ms, Agreement::kAtLeast});
  }
  return item;
}

}  // namespace

Paper optics_paper(PaperStudio& studio) {
  Paper paper{
      "Ma Jun, Zhu Heng-jun, Gong Jian-hua: Simulation of Real-time Water Surface Based on Cg and "
      "OpenGL, 2006",
      {principle(studio), mirrored_things(studio), indices(studio), depth_ratio(studio)}};
  for (const auto& items : {effects(studio), bumps(studio)})
    paper.items.insert(paper.items.end(), items.begin(), items.end());
  paper.items.insert(paper.items.end(), {caustics(studio), rates(studio), combined(studio)});
  return paper;
}

}  // namespace swell::apps
