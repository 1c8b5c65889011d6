// Implicit surfaces: their functions, bounds and files.
#include "scene/implicit_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "math/random.h"
#include "render/objects/height_pictures.h"
#include "scene/file/implicit_file.h"
#include "scene/file/scene_files.h"
#include "scene/height_frames.h"
#include "scene/scene_error.h"
#include "trials.h"

namespace swell::scene {
namespace {

struct ImplicitDice {
  std::uint64_t next = 0;
  double roll(double low, double high) { return low + (high - low) * random_uniform(7, next++); }
  glm::dvec3 point(double reach) {
    return {roll(-reach, reach), roll(-reach, reach), roll(-reach, reach)};
  }
};

Quadric random_quadric(ImplicitDice& dice) {
  return {.xx = dice.roll(-1, 1),
          .yy = dice.roll(-1, 1),
          .zz = dice.roll(-1, 1),
          .xy = dice.roll(-1, 1),
          .xz = dice.roll(-1, 1),
          .yz = dice.roll(-1, 1),
          .b = dice.point(1),
          .c = dice.roll(-1, 1)};
}

ImplicitTerm random_term(ImplicitDice& dice) {
  ImplicitTerm term{random_quadric(dice), {}};
  for (int i = 0; i < 3; ++i)
    term.perturbations.push_back({random_quadric(dice), dice.roll(-1, 1)});
  return term;
}

TEST(ImplicitSurface, GradientIsThatOfDifferences) {
  ImplicitDice dice;
  constexpr double kStep = 1e-5;
  for (int n = 0; n < 1000; ++n) {
    const ImplicitTerm term = random_term(dice);
    const glm::dvec3 p = dice.point(1.5), g = gradient(term, p);
    for (int c = 0; c < 3; ++c) {
      glm::dvec3 step(0.0);
      step[c] = kStep;
      const double slope = (value(term, p + step) - value(term, p - step)) / (2.0 * kStep);
      EXPECT_NEAR(g[c], slope, 1e-4 * (1.0 + glm::length(g)));
    }
  }
}

// The cube of the positive part leaves no edge where a perturbation begins.
TEST(ImplicitSurface, GradientGoesOnOverWhereAPerturbationBegins) {
  const ImplicitTerm term{{.zz = -1.0, .c = 1.0},
                          {{{.xx = -1.0, .yy = -1.0, .zz = -1.0, .c = 0.25}, 5.0}}};
  const glm::dvec3 before = gradient(term, {0.5 + 1e-6, 0.0, 0.0});
  const glm::dvec3 after = gradient(term, {0.5 - 1e-6, 0.0, 0.0});
  EXPECT_LT(glm::length(before - after), 1e-10);
}

TEST(ImplicitSurface, BoundsHoldOverTheirPoints) {
  ImplicitDice dice;
  int rejected = 0, empty = 0;
  for (int n = 0; n < trials(4000); ++n) {
    const ImplicitTerm term = random_term(dice);
    const glm::dvec3 middle = dice.point(2);
    const double size = std::exp(dice.roll(-6, 0.5));
    const Spans spans = {dice.point(size), dice.point(size), dice.point(size)};
    const Interval range = bounds(term, middle, spans);
    double most = -1e300;
    for (int k = 0; k < 300; ++k) {
      const glm::dvec3 s = dice.point(1);
      const double f = value(term, middle + s.x * spans[0] + s.y * spans[1] + s.z * spans[2]);
      most = std::max(most, f);
      ASSERT_GE(f, range.low);
      ASSERT_LE(f, range.high);
    }
    rejected += range.high < 0.0;
    empty += most < 0.0;
  }
  EXPECT_GT(rejected, 0.8 * empty);
}

// FUN-02: of a sphere with one bump nearly every box without a point in it is seen to be empty.
TEST(ImplicitSurface, BoundsOfASphereWithABumpAreTight) {
  ImplicitDice dice;
  const ImplicitTerm term{
      {.xx = -1.0, .yy = -1.0, .zz = -1.0, .c = 1.0},
      {{{.xx = -4.0, .yy = -4.0, .zz = -4.0, .b = {3.6, 0.6, 0.4}, .c = -2.37}, 2.0}}};
  int rejected = 0, empty = 0;
  for (int n = 0; n < trials(4000); ++n) {
    const glm::dvec3 middle = dice.point(2);
    const double size = std::exp(dice.roll(-4, 0));
    const Spans spans = {glm::dvec3(size, 0, 0), glm::dvec3(0, size, 0), glm::dvec3(0, 0, size)};
    double most = -1e300;
    for (int k = 0; k < 1000; ++k)
      most = std::max(most, value(term, middle + size * dice.point(1)));
    const bool is_rejected = bounds(term, middle, spans).high < 0.0;
    EXPECT_FALSE(is_rejected && most >= 0.0);
    rejected += is_rejected;
    empty += most < 0.0;
  }
  EXPECT_GT(rejected, 0.98 * empty) << empty;
}

// Of the three frames of a table all points that any has lie within its bounds.
TEST(HeightTable, BoundsHoldOverTheirPoints) {
  const render::HeightPictures pictures;
  ImplicitDice dice;
  for (int frame = 0; frame < 3; ++frame)
    pictures.write("rough_000" + std::to_string(frame) + ".exr", 23, 37,
                   [&](double, double) { return dice.roll(-0.3, 0.3); });
  const ImplicitSurface implicit = pictures.parse(
      "[[form]]\nshape = \"box\"\nsize = [2, 3, 1]\nturn_deg = [20, 30, 40]\n"
      "heights = { image = \"rough_%04d.exr\", frames = 3, loop_s = 3, threshold_m = -0.1 }");
  const HeightTable& table = *implicit.parts[0].table;
  std::vector<HeightTable> of_frame(3, table);
  for (std::size_t frame = 0; frame < 3; ++frame)
    of_frame[frame].heights = std::make_shared<const HeightFrames>(
        HeightFrames{{table.heights->frames[frame]}, table.heights->columns, table.heights->rows});
  int rejected = 0, empty = 0;
  for (int n = 0; n < trials(4000); ++n) {
    const glm::dvec3 middle = dice.point(1.5);
    const double size = std::exp(dice.roll(-5, 0));
    const Spans spans = {dice.point(size), dice.point(size), dice.point(size)};
    const double bound = most_of(table, middle, spans);
    double most = -1e300;
    for (int k = 0; k < 40; ++k) {
      const glm::dvec3 s = dice.point(1);
      const glm::dvec3 p = middle + s.x * spans[0] + s.y * spans[1] + s.z * spans[2];
      for (const HeightTable& one : of_frame) most = std::max(most, value(one, p));
    }
    ASSERT_LE(most, bound);
    rejected += bound < 0.0;
    empty += most < 0.0;
  }
  EXPECT_GT(rejected, 0.5 * empty);
}

// The part of space where an implicit surface is, by cells of a fiftieth [m^3].
double volume_m3(const std::string& toml) {
  const ImplicitSurface implicit = parse_implicit(toml, "form.toml");
  constexpr double kCell_m = 0.02;
  const glm::ivec3 cells(glm::ceil((implicit.high - implicit.low) / kCell_m));
  int inside = 0;
  for (int k = 0; k < cells.z; ++k)
    for (int j = 0; j < cells.y; ++j)
      for (int i = 0; i < cells.x; ++i) {
        const glm::dvec3 p = implicit.low + kCell_m * (glm::dvec3(i, j, k) + 0.5);
        inside += std::ranges::any_of(
            implicit.parts, [&](const ImplicitPart& part) { return value(part, p) >= 0.0; });
      }
  return inside * kCell_m * kCell_m * kCell_m;
}

// FUN-04
TEST(ImplicitSurface, PerturbedAndUnitedSpheresHaveTheirVolumes) {
  // F = 1 - s + (2 - s)^3 where s < 2, s = r^2: the shape's own Q is 1 - s / 2, its cube an eighth.
  EXPECT_NEAR(volume_m3("[[form]]\nsize = [2, 2, 2]\nbend = [{ size = [2.8284271247, "
                        "2.8284271247, 2.8284271247], factor = 8 }]"),
              6.335774, 0.01);
  EXPECT_NEAR(volume_m3("[[form]]\nsize = [2, 2, 2]\nat = [-0.5, 0, 0]\n"
                        "[[form]]\nsize = [2, 2, 2]\nat = [0.5, 0, 0]"),
              7.068583, 0.01);
}

TEST(ImplicitSurface, BoxesHoldTheirParts) {
  const ImplicitSurface implicit = parse_implicit(
      "[[form]]\nsize = [2, 4, 6]\nat = [1, 2, 3]\nturn_deg = [0, 0, 90]\n", "form.toml");
  EXPECT_NEAR(implicit.low.x, -1.0, 0.1);
  EXPECT_LE(implicit.low.x, -1.0);
  EXPECT_NEAR(implicit.high.x, 3.0, 0.1);
  EXPECT_GE(implicit.high.y, 3.0);
  EXPECT_LE(implicit.high.y, 3.1);
  EXPECT_LE(implicit.low.z, 0.0);
}

// A blade a hundred times as long as it is thick, turned askew, with a bump.
TEST(ImplicitSurface, BoxesOfThinThingsAreTight) {
  const ImplicitSurface implicit = parse_implicit(
      "[[form]]\nsize = [0.04, 0.4, 4]\nturn_deg = [33, 27, 71]\n"
      "bend = [{ size = [0.3, 0.2, 0.5], at = [0, 0.1, 0.3], factor = 1 }]\n",
      "form.toml");
  EXPECT_LT(glm::length(implicit.high - implicit.low), 6.0);
}

std::string refusal(const std::string& text) {
  try {
    parse_implicit(text, "x.toml");
  } catch (const SceneError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "";
}

// The prism under a contour: a cone over half of its height, down to its foot.
TEST(HeightTable, HasTheVolumeUnderItsHeights) {
  const render::HeightPictures pictures;
  pictures.write("cone.exr", 65, 65,
                 [](double u, double v) { return 1.0 - std::sqrt(u * u + v * v); });
  const ImplicitSurface implicit = pictures.parse(
      "[[form]]\nshape = \"plane\"\nsize = [2, 2, 0.4]\n"
      "heights = { image = \"cone.exr\", threshold_m = 0.5 }");
  constexpr double kCell_m = 0.02;
  const glm::ivec3 cells(glm::ceil((implicit.high - implicit.low) / kCell_m));
  int inside = 0;
  for (int k = 0; k < cells.z; ++k)
    for (int j = 0; j < cells.y; ++j)
      for (int i = 0; i < cells.x; ++i)
        inside +=
            value(implicit.parts[0], implicit.low + kCell_m * (glm::dvec3(i, j, k) + 0.5)) >= 0.0;
  // Of radius 1/2: a cylinder from -0.2 m to 0.5 m, and a cone of 0.5 m on it.
  const double expected = 3.14159265 * 0.25 * (0.7 + 0.5 / 3.0);
  EXPECT_NEAR(inside * kCell_m * kCell_m * kCell_m, expected, 0.01);
}

TEST(HeightTable, CopiesAndMirrorsTakeItAlong) {
  const render::HeightPictures pictures;
  pictures.write("ramp.exr", 3, 3, [](double u, double) { return 0.5 + 0.4 * u; });
  const ImplicitSurface implicit = pictures.parse(
      "[[form]]\nshape = \"box\"\nsize = [1, 1, 1]\nat = [3, 0, 0]\nmirror = true\n"
      "repeat = [2, 0, 5, 0]\nheights = { image = \"ramp.exr\" }");
  ASSERT_EQ(implicit.parts.size(), 4u);
  // Higher to the right in the part, and to the left in its mirror picture.
  for (const double y : {0.0, 5.0})
    for (const double side : {1.0, -1.0}) {
      const auto has = [&](glm::dvec3 p) {
        return std::ranges::any_of(implicit.parts,
                                   [&](const ImplicitPart& part) { return value(part, p) >= 0.0; });
      };
      EXPECT_TRUE(has({side * 3.4, y, 1.2}));
      EXPECT_FALSE(has({side * 2.6, y, 1.2}));
      EXPECT_TRUE(has({side * 2.6, y, 0.5}));
    }
}

TEST(HeightTable, ScenesNameItsPicturesAmongTheirFiles) {
  const render::HeightPictures pictures;
  for (const char* const name : {"a_0000.exr", "a_0001.exr"})
    pictures.write(name, 2, 2, [](double, double) { return 1.0; });
  Scene scene;
  scene.objects.push_back(common_object(ObjectKind::kImplicit));
  scene.objects[0].file = pictures.folder().write("a.toml",
                                                  "[[form]]\nshape = \"box\"\nheights = "
                                                  "{ image = \"a_%04d.exr\", frames = 2 }");
  const std::vector<SceneFile> files = files_of(scene);
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(files[2].path, pictures.folder().file("a_0001.exr"));
}

TEST(ImplicitFile, RefusesTablesOfHeightsThatCannotBeDrawnInOneLine) {
  const render::HeightPictures pictures;
  pictures.write("far.exr", 2, 3, [](double u, double) { return 2000.0 * u; });
  pictures.write("thin.exr", 1, 3, [](double, double) { return 1.0; });
  pictures.write("deep.exr", 2, 2, [](double, double) { return -5.0; });
  pictures.write("s_0000.exr", 2, 2, [](double, double) { return 1.0; });
  pictures.write("s_0001.exr", 2, 3, [](double, double) { return 1.0; });
  const std::string file = pictures.folder().file("form.toml");
  const auto refusal_of = [&](const std::string& part, const std::string& heights) {
    try {
      pictures.parse("[[form]]\n" + part + "\nheights = " + heights);
    } catch (const SceneError& error) {
      const std::string text = error.what();
      EXPECT_EQ(text.find('\n'), std::string::npos);
      EXPECT_EQ(text.substr(0, file.size() + 1), file + ":");
      return text.substr(file.size() + 1);
    }
    return std::string();
  };
  const std::string box = "shape = \"box\"", folder = pictures.folder().path().string() + "/";
  EXPECT_EQ(
      refusal_of("", "{ image = \"far.exr\" }"),
      "3: column 11: form[0].heights, got them on a shape \"ellipsoid\", allowed a plane's or a "
      "box's");
  EXPECT_EQ(refusal_of(box + "\nbend = [{}]", "{ image = \"far.exr\" }"),
            "4: column 11: form[0].heights, got them besides bend, allowed one of them");
  EXPECT_EQ(refusal_of(box, "3"), "3: column 11: form[0].heights, got no table, allowed a table");
  EXPECT_EQ(refusal_of(box, "{}"),
            "3: column 11: form[0].heights.image, got no file, allowed a picture's");
  EXPECT_NE(refusal_of(box, "{ picture = 1 }").find("unknown key, got 'form[0].heights.picture'"),
            std::string::npos);
  EXPECT_NE(refusal_of(box, "{ image = \"none.exr\" }").find("form[0].heights.image, " + folder),
            std::string::npos);
  EXPECT_EQ(refusal_of(box, "{ image = \"far.exr\" }"),
            "3: column 21: form[0].heights.image, " + folder +
                "far.exr: height at pixel (0, 2), got -2000 m, allowed -1000 to 1000 m");
  EXPECT_EQ(refusal_of(box, "{ image = \"thin.exr\" }"),
            "3: column 21: form[0].heights.image, " + folder +
                "thin.exr: table of heights, got 1 x 3 pixels, allowed 2 to 2049 a side");
  EXPECT_EQ(refusal_of(box, "{ image = \"s_0000.exr\", frames = 2 }"),
            "3: column 21: form[0].heights.image, got \"s_0000.exr\", allowed a path with %04d for "
            "the frame");
  EXPECT_EQ(
      refusal_of(box, "{ image = \"s_%04d.exr\", frames = 2 }"),
      "3: column 21: form[0].heights.image, " + folder +
          "s_0001.exr: table of heights, got a frame of another size, allowed that of frame 0");
  EXPECT_EQ(refusal_of(box, "{ image = \"s_%04d.exr\", frames = 1.5 }"),
            "3: column 44: form[0].heights.frames, got 1.5, allowed a whole number");
  EXPECT_EQ(
      refusal_of(box, "{ image = \"deep.exr\" }"),
      "1: column 1: form[0], got a part without an inside, allowed a shape with an inside and "
      "an end");
}

TEST(ImplicitFile, RefusesWhatCannotBeDrawnInOneLine) {
  EXPECT_EQ(refusal(""), "x.toml:1: column 1: form, got none, allowed 1 to 128 tables [[form]]");
  EXPECT_EQ(refusal("[[form]]\nshape = \"quadric\"\nquadric = [-1, -1, -1, 0,0,0, 0,0,0, -1]"),
            "x.toml:1: column 1: form[0], got a part without an inside, allowed a shape with an "
            "inside and an end");
  EXPECT_EQ(refusal("[[form]]\nshape = \"plane\""),
            "x.toml:1: column 1: form[0], got a part that goes on beyond 1000 m, allowed a shape "
            "with an inside and an end");
  EXPECT_EQ(refusal("[[form]]\nsize = [1, nan, 1]"),
            "x.toml:2: column 12: form[0].size, got nan, allowed 0.0001 to 2000");
  EXPECT_EQ(refusal("[[form]]\nsize = [1, 1]"),
            "x.toml:2: column 8: form[0].size, got 2 values, allowed [3 numbers]");
  EXPECT_EQ(refusal("[[form]]\nshape = \"ball\""),
            "x.toml:2: column 9: form[0].shape, got \"ball\", allowed \"ellipsoid\", \"cylinder\", "
            "\"cone\", \"paraboloid\", \"box\", \"plane\", \"quadric\"");
  EXPECT_NE(refusal("[[form]]\ncolor = [1, 1, 1]").find("unknown key, got 'form[0].color'"),
            std::string::npos);
  EXPECT_NE(refusal("[[form]]\nsize = [").find("syntax error"), std::string::npos);
  std::string many;
  for (int i = 0; i < 129; ++i) many += "[[form]]\n";
  EXPECT_NE(refusal(many).find("129 tables"), std::string::npos);
  EXPECT_NE(
      refusal("[[form]]\ncopies = 64\nmirror = true\n[[form]]\nsize = [1, 1, 1]").find("129 parts"),
      std::string::npos);
}

}  // namespace
}  // namespace swell::scene
