// The walk-throughs of docs/understand/frame.md, done: a floor of black and white squares in place
// of the land's material, and no objects, in programs that build_with_materials.cmake made.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "apps/shared/program_runner.h"
#include "render/measure/pick.h"
#include "scene/terrain.h"
#include "texture/image/image_io.h"

namespace swell::apps {
namespace {

constexpr int kWidth_px = 640, kHeight_px = 360;
constexpr double kT_s = 5.0;

// A program of build_with_materials.cmake.
std::string program(const std::string& change) {
  return std::string(SWELL_MATERIALS_FOLDER) + "/" + change + "/swell-render";
}

std::string scene_text(const std::string& name) {
  return read_text(std::string(SWELL_SOURCE_DIR) + "/scenes/" + name + ".toml");
}

// The text with what follows `key = ` on its line replaced; the key is there once.
std::string with_value(const std::string& text, const std::string& key, const std::string& value) {
  const std::regex line("(^|\n)" + key + " = [^\n]*");
  EXPECT_TRUE(std::regex_search(text, line)) << key;
  return std::regex_replace(text, line, "$1" + key + " = " + value);
}

// The lagoon, whose water shows the floor where it is, not where waves move it to.
std::string still_lagoon_text() {
  return with_value(with_value(scene_text("lagoon"), "distortion", "0.0"), "lookup_scale", "1.0");
}

// The still lagoon, seen from another place.
std::string lagoon_text(const std::string& eye_m, const std::string& pitch_deg) {
  return with_value(with_value(still_lagoon_text(), "eye_m", eye_m), "pitch_deg", pitch_deg);
}

std::string shallows_text() { return lagoon_text("[-15.0, -215.0, 7.0]", "-25.0"); }
std::string shore_text() { return lagoon_text("[-15.0, -165.0, 9.0]", "-40.0"); }
std::string in_even_light(const std::string& text) {
  return std::regex_replace(text, std::regex("\\[sky\\]"), "[sky]\nmodel = \"gradient\"");
}
std::string far_text() { return in_even_light(lagoon_text("[-15.0, -600.0, 40.0]", "-4.0")); }
std::string rim_text() { return lagoon_text("[-15.0, -350.0, 60.0]", "-8.0"); }

struct Colour {
  float red = 0.0f, green = 0.0f, blue = 0.0f;  // sRGB, [0, 1]
  bool operator==(const Colour&) const = default;
};

// A program's picture of a scene.
class Picture {
 public:
  Picture(const std::string& program, const std::string& text,
          const Arguments& more_arguments = {}) {
    const ScratchFolder folder;
    write_text(folder.file("scene.toml"), text);
    Arguments arguments = {"--scene", folder.file("scene.toml"), "--time", "5", "--size", "640x360",
                           "--out",   folder.file("picture.png")};
    for (const std::string& more : more_arguments) arguments.push_back(more);
    const Outcome outcome = run_program(program, arguments);
    EXPECT_EQ(outcome.exit_code, 0) << program << ": " << outcome.err;
    if (outcome.exit_code == 0) image_ = texture::read_image(folder.file("picture.png"));
  }

  Colour at(int x_px, int y_px) const {
    const std::size_t i = 3 * (static_cast<std::size_t>(y_px) * kWidth_px + x_px);
    return {image_.pixels.at(i), image_.pixels.at(i + 1), image_.pixels.at(i + 2)};
  }

 private:
  texture::ImageF image_;
};

// What a scene's pixels show, by the library as it is.
class Shot {
 public:
  explicit Shot(const std::string& text)
      : world_(scene::parse_scene(text, "scene.toml")),
        view_(scene::camera_view(world_.scene().camera, kT_s, kWidth_px, kHeight_px)),
        land_(*scene::build_terrain(world_.scene())) {
    Workers workers(2);
    render::Target target;
    render::render_frame(world_, view_, kT_s, {}, workspace_, target, workers);
  }

  const terrain::HeightGrid& land() const { return land_; }
  const View& view() const { return view_; }

  // Calls use(x_px, y_px, pick) for every eighth pixel each way.
  template <class Use>
  void for_pixels(const Use& use) {
    for (int y = 3; y < kHeight_px; y += 8)
      for (int x = 3; x < kWidth_px; x += 8)
        use(x, y, render::pick(world_, view_, workspace_, ray_px(x, y), scratch_));
  }

  // A pixel's length on level ground along the view, at this place.
  double footprint_m(glm::dvec3 p_world) const {
    const glm::dvec3 p = p_world - view_.eye_world;
    const double distance_m = glm::length(p);
    return distance_m * distance_m / std::abs(p.z) * 2.0 * view_.tan_half_y / kHeight_px;
  }

  // Where light that comes to the pixel out of the water has left the floor, by Snell's law at the
  // mean level.
  glm::dvec3 floor_through_water(int x_px, int y_px) const {
    const glm::vec2 at = ray_px(x_px, y_px);
    const glm::dvec3 in_air = glm::normalize(glm::dvec3(view_.ray(at.x, at.y)));
    glm::dvec3 p = view_.eye_world - in_air * (view_.eye_world.z / in_air.z);
    const double n = world_.scene().water.refraction_index;
    glm::dvec3 in_water(in_air.x / n, in_air.y / n, 0.0);
    in_water.z = -std::sqrt(1.0 - glm::dot(in_water, in_water));
    constexpr double kStep_m = 0.01;
    while (p.z > terrain::height_at(land_, glm::dvec2(p)) && p.z > -50.0) p += kStep_m * in_water;
    return p;
  }

 private:
  static glm::vec2 ray_px(int x_px, int y_px) {
    return {static_cast<float>(x_px) + 0.5f, static_cast<float>(y_px) + 0.5f};
  }

  render::World world_;
  View view_;
  render::Workspace workspace_;
  render::PickScratch scratch_;
  terrain::HeightGrid land_;
};

// The squares are 2 m wide; a white one lies around the origin.
bool is_white(glm::dvec3 p) {
  const double turn = std::numbers::pi / 2.0;
  return std::cos(turn * p.x) * std::cos(turn * p.y) > 0.0;
}

// To the nearest edge of a square.
double to_edge_m(glm::dvec3 p) {
  const auto along = [](double x) { return std::abs(std::remainder(x - 1.0, 2.0)); };
  return std::min(along(p.x), along(p.y));
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double x : values) sum += x;
  return sum / static_cast<double>(values.size());
}

TEST(Checkerboard, TakesFewerThanFortyLines) {
  std::istringstream patch(
      read_text(std::string(SWELL_SOURCE_DIR) + "/examples/checkerboard/checkerboard.patch"));
  const std::regex added("\\+[^+].*"), comment("\\+ *//.*");
  int lines = 0;
  for (std::string line; std::getline(patch, line);)
    lines += std::regex_match(line, added) && !std::regex_match(line, comment);
  EXPECT_LT(lines, 40);
  EXPECT_GT(lines, 20);
}

TEST(Checkerboard, LandShowsTheSquareThatIsThere) {
  const Picture board(program("checkerboard"), shore_text());
  Shot shot(shore_text());
  int white = 0, black = 0, wrong = 0;
  shot.for_pixels([&](int x, int y, const auto& pick) {
    if (!pick || pick->what != render::Shown::kLand) return;
    if (to_edge_m(pick->p_world) < 0.1 + shot.footprint_m(pick->p_world)) return;
    const bool expected = is_white(pick->p_world);
    ++(expected ? white : black);
    wrong += (board.at(x, y).green > 0.5f) != expected;
  });
  EXPECT_GT(white, 50);
  EXPECT_GT(black, 50);
  EXPECT_EQ(wrong, 0) << white << " white, " << black << " black";
}

TEST(Checkerboard, FloorShowsThroughWaterWhereSnellsLawPutsIt) {
  const Picture board(program("checkerboard"), shallows_text());
  Shot shot(shallows_text());
  std::vector<double> white, black;
  std::vector<double> red_shallow, red_deep;  // of white squares
  std::size_t dark_white = 0, bright_black = 0;
  shot.for_pixels([&](int x, int y, const auto& pick) {
    if (!pick || pick->what != render::Shown::kWater) return;
    const glm::dvec3 floor = shot.floor_through_water(x, y);
    if (to_edge_m(floor) < 0.3 + shot.footprint_m(floor)) return;
    const Colour seen = board.at(x, y);
    if (is_white(floor)) {
      white.push_back(seen.green);
      dark_white += seen.green < 0.6f;
      if (floor.z > -1.0) red_shallow.push_back(seen.red);
      if (floor.z < -1.5) red_deep.push_back(seen.red);
    } else {
      black.push_back(seen.green);
      bright_black += seen.green > 0.5f;
    }
  });
  ASSERT_GT(white.size(), 200u);
  ASSERT_GT(black.size(), 200u);
  // But for a few pixels where the water mirrors more than it lets through.
  EXPECT_LT(dark_white, white.size() / 100);
  EXPECT_LT(bright_black, black.size() / 100);
  // Water takes the red first.
  ASSERT_GT(red_shallow.size(), 20u);
  ASSERT_GT(red_deep.size(), 20u);
  EXPECT_LT(mean(red_deep), mean(red_shallow) - 0.05);
}

// Light as the display shows it, in [0, 1]: linear up to 0.4, then a shoulder (resolve-inl.h), and
// sRGB. Source of the latter: IEC 61966-2-1:1999, 5.2.
double shown(double light) {
  const double x = light <= 0.4 ? light : 1.0 - 0.36 / (light + 0.2);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

double light_of(double code) {
  double low = 0.0, high = 100.0;
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    (shown(middle) < code ? low : high) = middle;
  }
  return low;
}

// Half as bright as the white squares; the black ones give no light.
TEST(Checkerboard, SquaresTooFineForAPixelAreGrey) {
  const Arguments no_haze = {"--without", "haze"};
  const Picture near(program("checkerboard"), in_even_light(shore_text()), no_haze);
  Shot near_shot(in_even_light(shore_text()));
  std::vector<double> white;
  near_shot.for_pixels([&](int x, int y, const auto& pick) {
    if (!pick || pick->what != render::Shown::kLand || !is_white(pick->p_world)) return;
    if (to_edge_m(pick->p_world) > 0.1 + near_shot.footprint_m(pick->p_world))
      white.push_back(near.at(x, y).green);
  });
  ASSERT_GT(white.size(), 50u);

  const Picture board(program("checkerboard"), far_text(), no_haze);
  Shot shot(far_text());
  std::vector<double> green;
  shot.for_pixels([&](int x, int y, const auto& pick) {
    if (!pick || pick->what != render::Shown::kLand) return;
    if (shot.footprint_m(pick->p_world) > 8.0) green.push_back(board.at(x, y).green);
  });
  ASSERT_GT(green.size(), 50u);
  const double grey = shown(0.5 * light_of(mean(white)));
  const auto [low, high] = std::ranges::minmax(green);
  EXPECT_NEAR(low, grey, 0.03) << green.size();
  EXPECT_NEAR(high, grey, 0.03);
}

TEST(Checkerboard, SkyAndWaterAwayFromLandAreAsBefore) {
  const Arguments no_apron = {"--without", "apron"};
  const Picture board(program("checkerboard"), rim_text(), no_apron);
  const Picture sand(render_program(), rim_text(), no_apron);
  Shot shot(rim_text());
  const terrain::Grid& grid = shot.land().grid;
  const glm::dvec2 middle = grid.min_world + 0.5 * grid.size_m();
  // Beyond the rim of the land's square.
  const auto is_far = [&](glm::dvec3 p) {
    const glm::dvec2 from_middle = glm::abs(glm::dvec2(p) - middle);
    return std::max(from_middle.x, from_middle.y) > 0.6 * grid.size_m();
  };
  int sky = 0, far_water = 0, land = 0, changed = 0, changed_land = 0;
  shot.for_pixels([&](int x, int y, const auto& pick) {
    const bool differs = !(board.at(x, y) == sand.at(x, y));
    if (pick && pick->what == render::Shown::kLand) {
      ++land;
      changed_land += differs;
    } else if (!pick || is_far(pick->p_world)) {
      ++(pick ? far_water : sky);
      changed += differs;
    }
  });
  EXPECT_GT(sky, 100);
  EXPECT_GT(far_water, 100);
  EXPECT_GT(land, 100);
  EXPECT_EQ(changed, 0) << sky << " of the sky, " << far_water << " of water";
  EXPECT_GT(changed_land, land * 9 / 10);
}

// The hash line of a scene's picture.
std::string hash_line(const std::string& program, const std::string& text,
                      const Arguments& more = {}) {
  const ScratchFolder folder;
  write_text(folder.file("scene.toml"), text);
  Arguments arguments = {"--scene", folder.file("scene.toml"), "--time", "2.5", "--size", "640x360",
                         "--hash"};
  for (const std::string& argument : more) arguments.push_back(argument);
  const Outcome outcome = run_program(program, arguments);
  EXPECT_EQ(outcome.exit_code, 0) << program << ": " << outcome.err;
  return outcome.out;
}

TEST(Checkerboard, ScenesWithoutLandAreAsBefore) {
  for (const char* scene : {"open_ocean", "buoys"})
    EXPECT_EQ(hash_line(program("checkerboard"), scene_text(scene)),
              hash_line(render_program(), scene_text(scene)))
        << scene;
}

TEST(NoObjects, ASceneWithObjectsLooksAsIfItHadNone) {
  // Objects make no triangles finer here: the same mesh with them and without.
  // Nor are waves drawn for them where triangles are wide, in a sea that ends.
  const std::string some = std::regex_replace(scene_text("buoys"), std::regex("\\[sea\\]"),
                                              "[sea]\nsize_m = [4000.0, 4000.0]") +
                           "\n[detail]\nobjects = 1.0\n";
  const std::string none =
      std::regex_replace(some, std::regex("\\[\\[object\\]\\]\n([^\n]+\n)*"), "");
  ASSERT_EQ(none.find("[[object]]"), std::string::npos);
  // What objects do to others is drawn by those.
  const Arguments alone = {"--without", "shadows,hulls"};
  const std::string expected = hash_line(render_program(), none, alone);
  EXPECT_EQ(hash_line(program("no_objects"), some, alone), expected);
  EXPECT_NE(hash_line(render_program(), some, alone), expected);
}

TEST(NoObjects, ScenesWithoutObjectsAreAsBefore) {
  for (const char* scene : {"lagoon", "beach", "open_ocean"})
    EXPECT_EQ(hash_line(program("no_objects"), scene_text(scene)),
              hash_line(render_program(), scene_text(scene)))
        << scene;
}

}  // namespace
}  // namespace swell::apps
