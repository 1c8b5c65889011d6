// Labels as planes of files, as 16-bit pictures and as pictures in false colours.
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "apps/shared/label_file.h"
#include "apps/shared/label_picture.h"

namespace swell::apps {
namespace {

using render::Label;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

constexpr std::uint32_t rgb(std::uint32_t r, std::uint32_t g, std::uint32_t b) {
  return r | g << 8 | b << 16 | 0xff000000u;
}
constexpr std::uint32_t grey(std::uint32_t value) { return rgb(value, value, value); }
constexpr std::uint32_t kBlack = grey(0);

// A view north of 4 x 2 pixels, from (10, 20, 30); its tangents are 1 across and 0.5 up.
View small_view() {
  return make_view({10.0, 20.0, 30.0}, camera_axes(0.0, 0.0, 0.0), {1.0, 0.5, 0.0, 0.0}, 0.25f, 4,
                   2);
}

// Every plane has its own numbers.
render::Labels numbered_labels() {
  render::Labels labels;
  labels.set = render::LabelSet::all();
  for (int i = 0; i < 8; ++i) {
    const auto f = static_cast<float>(i);
    labels.depth_m.push_back(i == 0 ? kInfinity : 4.0f * f);
    labels.normal.push_back({f, f + 0.25f, f + 0.5f});
    labels.geometric_normal.push_back({-f, -f - 0.25f, -f - 0.5f});
    labels.id.push_back(100u + static_cast<std::uint32_t>(i));
    labels.klass.push_back(200u + static_cast<std::uint32_t>(i));
    labels.motion_px.push_back({f + 300.0f, f + 400.0f});
    labels.elevation_m.push_back(f + 500.0f);
    labels.foam.push_back(f / 8.0f);
    labels.flags.push_back(static_cast<std::uint8_t>(i % 4));
  }
  return labels;
}

TEST(LabelNames, AreReadFromAListOrAll) {
  render::LabelSet two;
  two.add(Label::kDepth);
  two.add(Label::kId);
  EXPECT_EQ(parse_labels("depth,id"), two);
  EXPECT_EQ(parse_labels("id,depth,id"), two);
  EXPECT_EQ(parse_labels("all"), render::LabelSet::all());
  for (const char* text : {"", "depht", "depth,", ",depth", "depth id", "Depth", "all,depth"})
    EXPECT_EQ(parse_labels(text), std::nullopt) << text;
  EXPECT_EQ(label_names().substr(0, 17), "depth, distance, ");
}

TEST(LabelPlanes, HaveTheNamesOfTheTableInItsOrder) {
  std::vector<std::string> names, expected;
  for (const LabelPlane& plane :
       label_planes(numbered_labels(), render::LabelSet::all(), small_view()))
    names.push_back(plane.name);
  for (const render::LabelInfo& info : render::label_table())
    for (std::size_t c = 0; c < info.plane_count(); ++c) expected.emplace_back(info.planes[c]);
  EXPECT_EQ(names, expected);
}

TEST(LabelPlanes, HoldWhatWasDrawnAndWhatFollowsFromDepth) {
  const auto planes = label_planes(numbered_labels(), render::LabelSet::all(), small_view());
  const auto floats = [&](std::string_view name) {
    for (const LabelPlane& plane : planes)
      if (plane.name == name) return std::get<std::vector<float>>(plane.samples);
    return std::vector<float>();
  };
  const auto words = [&](std::string_view name) {
    for (const LabelPlane& plane : planes)
      if (plane.name == name) return std::get<std::vector<std::uint32_t>>(plane.samples);
    return std::vector<std::uint32_t>();
  };
  EXPECT_EQ(floats("Z").at(2), 8.0f);
  EXPECT_EQ(floats("N.Y").at(3), 3.25f);
  EXPECT_EQ(floats("Ng.Z").at(3), -3.5f);
  EXPECT_EQ(words("id").at(5), 105u);
  EXPECT_EQ(words("class").at(5), 205u);
  EXPECT_EQ(floats("motion.X").at(1), 301.0f);
  EXPECT_EQ(floats("motion.Y").at(1), 401.0f);
  EXPECT_EQ(floats("elevation").at(7), 507.0f);
  EXPECT_EQ(floats("foam").at(4), 0.5f);
  EXPECT_EQ(words("flags").at(7), 3u);

  // Pixel (1, 1), 20 m deep: the middle of its square lies at -0.25 of 1 across, -0.5 of 0.5 up.
  EXPECT_NEAR(floats("P.X").at(5), 10.0f - 20.0f * 0.25f, 1e-5f);
  EXPECT_NEAR(floats("P.Y").at(5), 20.0f + 20.0f, 1e-5f);
  EXPECT_NEAR(floats("P.Z").at(5), 30.0f - 20.0f * 0.25f, 1e-5f);
  EXPECT_NEAR(floats("distance").at(5), 20.0f * std::sqrt(1.125f), 1e-5f);
  EXPECT_EQ(floats("distance").at(0), kInfinity);
}

TEST(DepthPng, HasMetresTimes256AndZeroForTheSky) {
  EXPECT_EQ(depth_word(1.0f), 256);
  EXPECT_EQ(depth_word(10.001f), 2560) << "to the nearest";
  EXPECT_EQ(depth_word(10.003f), 2561);
  EXPECT_EQ(depth_word(255.99609375f), 65535);
  EXPECT_EQ(depth_word(255.999f), 0) << "beyond what 16 bits hold";
  EXPECT_EQ(depth_word(1000.0f), 0);
  EXPECT_EQ(depth_word(kInfinity), 0);
  EXPECT_EQ(depth_word(0.001f), 1) << "near is not the sky";
}

// --- False colours

TEST(LabelColours, DepthIsGreyByItsLogarithm) {
  EXPECT_EQ(depth_colour(0.3f), grey(255));
  EXPECT_EQ(depth_colour(1.0f), grey(255));
  EXPECT_EQ(depth_colour(10.0f), grey(191));
  EXPECT_EQ(depth_colour(100.0f), grey(128));
  EXPECT_EQ(depth_colour(1e4f), kBlack);
  EXPECT_EQ(depth_colour(kInfinity), kBlack);
}

TEST(LabelColours, NormalsArePaintedByTheirComponents) {
  EXPECT_EQ(normal_colour({0.0f, 0.0f, 1.0f}), rgb(128, 128, 255));
  EXPECT_EQ(normal_colour({-1.0f, 1.0f, 0.0f}), rgb(0, 255, 128));
  EXPECT_EQ(normal_colour(glm::vec3(0.0f)), kBlack) << "of the sky";
}

TEST(LabelColours, PlacesHaveStripesOfAHundredMetres) {
  EXPECT_EQ(position_colour({0.0, 200.0, -4.0}), rgb(0, 0, 0));
  EXPECT_EQ(position_colour({50.0, -150.0, 4.0}), rgb(255, 255, 255));
  EXPECT_EQ(position_colour({-25.0, 60.0, 0.0}), rgb(128, 204, 128));
  EXPECT_EQ(position_colour(glm::dvec3(static_cast<double>(kInfinity), 0.0, 0.0)), kBlack);
}

TEST(LabelColours, SmallNumbersAreFarApart) {
  EXPECT_EQ(number_colour(0), kBlack);
  EXPECT_EQ(number_colour(1), rgb(26, 89, 204));
  std::set<std::uint32_t> colours;
  for (std::uint32_t a = 0; a < 80; ++a) {
    colours.insert(number_colour(a));
    for (std::uint32_t b = 0; b < a && a < 34; ++b) {
      int apart = 0;
      for (int shift : {0, 8, 16})
        apart += std::abs(static_cast<int>(number_colour(a) >> shift & 255) -
                          static_cast<int>(number_colour(b) >> shift & 255));
      EXPECT_GE(apart, 20) << a << " and " << b;
    }
  }
  EXPECT_EQ(colours.size(), 80u) << "as many as ids of a scene";
}

TEST(LabelColours, MotionHasAHueByDirectionAndGrowsBrighter) {
  EXPECT_EQ(motion_colour({0.0f, 0.0f}), kBlack);
  EXPECT_EQ(motion_colour({64.0f, 0.0f}), rgb(255, 0, 0));
  EXPECT_EQ(motion_colour({-640.0f, 0.0f}), rgb(0, 255, 255));
  EXPECT_EQ(motion_colour({0.0f, -100.0f}), rgb(128, 255, 0)) << "up";
  EXPECT_EQ(motion_colour({0.0f, 100.0f}), rgb(128, 0, 255)) << "down";
  EXPECT_EQ(motion_colour({0.791f, 0.0f}), rgb(128, 0, 0)) << "1 + 79.1 > sqrt(6401)";
}

TEST(LabelColours, TheRestIsGreyOrTwoBits) {
  EXPECT_EQ(elevation_colour(0.0f), grey(128));
  EXPECT_EQ(elevation_colour(-9.0f), kBlack);
  EXPECT_EQ(elevation_colour(4.0f), grey(255));
  EXPECT_EQ(share_colour(0.0f), kBlack);
  EXPECT_EQ(share_colour(1.0f), grey(255));
  EXPECT_EQ(flags_colour(0), kBlack);
  EXPECT_EQ(flags_colour(render::kShowsMirrored), rgb(0, 0, 255));
  EXPECT_EQ(flags_colour(render::kShowsRefracted), rgb(0, 255, 0));
  EXPECT_EQ(flags_colour(3), rgb(0, 255, 255));
}

TEST(LabelColours, PaintEachPixelByItsOwnValue) {
  const render::Labels labels = numbered_labels();
  const View view = small_view();
  std::vector<std::uint32_t> rgba;
  const auto painted = [&](Label label, std::size_t i) {
    paint_label(label, labels, view, rgba);
    EXPECT_EQ(rgba.size(), 8u);
    return rgba.at(i);
  };
  EXPECT_EQ(painted(Label::kDepth, 5), depth_colour(20.0f));
  EXPECT_EQ(painted(Label::kDepth, 0), kBlack);
  EXPECT_EQ(painted(Label::kDistance, 5), depth_colour(20.0f * std::sqrt(1.125f)));
  EXPECT_EQ(painted(Label::kPosition, 5), position_colour({5.0, 40.0, 25.0}));
  EXPECT_EQ(painted(Label::kNormal, 2), normal_colour({2.0f, 2.25f, 2.5f}));
  EXPECT_EQ(painted(Label::kGeometricNormal, 2), normal_colour({-2.0f, -2.25f, -2.5f}));
  EXPECT_EQ(painted(Label::kId, 3), number_colour(103));
  EXPECT_EQ(painted(Label::kClass, 3), number_colour(203));
  EXPECT_EQ(painted(Label::kMotion, 3), motion_colour({303.0f, 403.0f}));
  EXPECT_EQ(painted(Label::kElevation, 3), elevation_colour(503.0f));
  EXPECT_EQ(painted(Label::kFoam, 3), share_colour(0.375f));
  EXPECT_EQ(painted(Label::kFlags, 3), flags_colour(3));
}

}  // namespace
}  // namespace swell::apps
