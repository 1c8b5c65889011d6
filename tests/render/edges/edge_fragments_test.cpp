// Smooth edges: into which parts the pixels of a frame fall (AAX-01, AAX-05), and that nothing else
// of the frame changes (AAX-03).
#include <gtest/gtest.h>

#include <set>

#include "render/edges/edge_frames.h"
#include "render/edges/edge_scenes.h"

namespace swell::render {
namespace {

constexpr glm::ivec2 kFragmentsSize_px(201, 117);
constexpr double kTime_s = 2.0;

class EdgesOf : public testing::TestWithParam<const char*> {
 protected:
  const World& world = shipped_world(GetParam());
  const View view = view_of(world, kTime_s, kFragmentsSize_px.x, kFragmentsSize_px.y);
  EdgeRenderer frame{world, kTime_s};
};
INSTANTIATE_TEST_SUITE_P(Scenes, EdgesOf,
                         testing::Values("open_ocean", "lagoon", "beach", "buoys", "sea_state_8"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(EdgesOf, APixelsPartsHaveAllItsSamplesTogetherAndLieSideBySide) {
  for (const int samples : {4, 8}) {
    frame.draw(view, samples);
    std::size_t edge_pixels = 0;
    for (const std::vector<EdgeFragment>& fragments : frame.state().edges.of_tile) {
      std::set<int> finished;
      for (std::size_t first = 0; first < fragments.size();) {
        int sum = 0, centres = 0;
        std::size_t end = first;
        for (; end < fragments.size() && fragments[end].pixel == fragments[first].pixel; ++end) {
          ASSERT_GE(fragments[end].samples, 1);
          sum += fragments[end].samples;
          centres += fragments[end].is_centre;
        }
        ASSERT_EQ(sum, samples);
        ASSERT_LE(end - first, kMaxFragments);
        ASSERT_LE(centres, 1);
        ASSERT_FALSE(end - first == 1 && centres == 1) << "nothing to mix";
        ASSERT_TRUE(finished.insert(fragments[first].pixel).second) << "in two places";
        first = end;
        ++edge_pixels;
      }
    }
    EXPECT_GT(edge_pixels, 20u);
    EXPECT_LT(edge_pixels, std::size_t{kFragmentsSize_px.x} * kFragmentsSize_px.y / 4);
  }
}

// So they are shaded once. Of water and land it may show several places.
TEST_P(EdgesOf, APixelShowsTheSkyAndAnObjectOnceAtMost) {
  frame.draw(view, 8);
  const std::vector<Centre> centres = frame.centres();
  const auto of_pixel = frame.fragments();
  for (std::size_t pixel = 0; pixel < of_pixel.size(); ++pixel) {
    const auto x_px = static_cast<float>(pixel % kFragmentsSize_px.x);
    const auto y_px = static_cast<float>(pixel / kFragmentsSize_px.x);
    std::set<std::ptrdiff_t> surfaces;
    for (const EdgeFragment& f : of_pixel[pixel]) {
      const auto surface = frame.surface_of(f.primitive);
      const bool is_new = surfaces.insert(surface).second;
      ASSERT_TRUE(is_new || surface == 1 || surface == 2) << x_px << ", " << y_px;
      ASSERT_LT(std::abs(f.x_px - x_px), 0.5f);
      ASSERT_LT(std::abs(f.y_px - y_px), 0.5f);
      const int kind = frame.kind_of(f.primitive);
      ASSERT_EQ(kind == 0, f.z == 0.0f);
      if (f.is_centre) {
        ASSERT_EQ(kind, frame.kind_of(centres[pixel].primitive));
      }
    }
  }
}

TEST_P(EdgesOf, ChangeNothingButThePixelsThatTheyMix) {
  EdgeRenderer without(world, kTime_s);
  without.draw(view, 0);
  const std::vector<Centre> expected = without.centres();
  for (const auto& fragments : without.fragments()) ASSERT_TRUE(fragments.empty());
  for (const int samples : {4, 8}) {
    frame.draw(view, samples);
    EXPECT_EQ(frame.statistics.visible_pixels, without.statistics.visible_pixels);
    EXPECT_EQ(frame.statistics.shaded_pixels, without.statistics.shaded_pixels);
    EXPECT_EQ(frame.statistics.water_triangles, without.statistics.water_triangles);
    const std::vector<Centre> centres = frame.centres();
    const auto of_pixel = frame.fragments();
    int changed = 0;
    for (std::size_t i = 0; i < centres.size(); ++i) {
      ASSERT_EQ(centres[i].z, expected[i].z);
      ASSERT_EQ(centres[i].primitive, expected[i].primitive);
      const bool same = frame.target.rgba[i] == without.target.rgba[i];
      ASSERT_TRUE(same || !of_pixel[i].empty())
          << i % kFragmentsSize_px.x << ", " << i / kFragmentsSize_px.x;
      changed += !same;
    }
    EXPECT_GT(changed, 20);
  }
}

// AAX-01: a mesh's inner edges are no edges of the picture.
TEST(CalmSea, ThatFillsTheViewHasNoEdges) {
  for (const scene::Triangulation triangulation :
       {scene::Triangulation::kRoam, scene::Triangulation::kRadial, scene::Triangulation::kPlane}) {
    scene::Scene scene = plain_scene();
    scene.detail.triangulation = triangulation;
    scene.water.bump_strength = 1.0;
    const World world = world_of(scene);
    EdgeRenderer with(world), without(world);
    for (const double pitch : {-1.5, -0.9, -0.4}) {
      const View view = make_view({3.0, 5.0, 12.0}, 0.7, pitch, 0.6, 0.25f, kFragmentsSize_px.x,
                                  kFragmentsSize_px.y);
      ASSERT_EQ(without.draw(view, 0).visible_pixels, std::uint64_t{201} * 117);
      for (const int samples : {4, 8}) {
        with.draw(view, samples);
        for (const auto& fragments : with.state().edges.of_tile) EXPECT_TRUE(fragments.empty());
        EXPECT_TRUE(with.target.rgba == without.target.rgba) << pitch << ' ' << samples;
      }
    }
  }
}

// A plane towards the horizon is steep in depth, but one place: the horizon's pixels alone have
// parts, two each.
TEST(CalmSea, HasItsOnlyEdgeAtTheHorizon) {
  const World world = world_of(plain_scene());
  EdgeRenderer renderer(world);
  for (const double eye_z_m : {0.3, 3.0, 300.0}) {
    renderer.draw(north_view(eye_z_m, 0.1, 0.8, kFragmentsSize_px.x, kFragmentsSize_px.y), 8);
    const auto of_pixel = renderer.fragments();
    std::vector<int> in_column(kFragmentsSize_px.x);
    for (std::size_t i = 0; i < of_pixel.size(); ++i) {
      if (of_pixel[i].empty()) continue;
      ++in_column[i % kFragmentsSize_px.x];
      ASSERT_EQ(of_pixel[i].size(), 2u) << "eye at " << eye_z_m;
      ASSERT_NE(of_pixel[i][0].is_centre, of_pixel[i][1].is_centre);
    }
    // A slope of tan 0.1 crosses at most two pixels of a column.
    for (const int pixels : in_column) EXPECT_LE(pixels, 2);
    EXPECT_GT(std::ranges::count(in_column, 1) + std::ranges::count(in_column, 2), 150);
  }
}

// How the pictures moved by each sample's place, drawn without samples, know the same pixels.
struct Agreement {
  int edge_pixels = 0, wrong = 0;    // pixels with parts; of these with other numbers of samples
  int far_wrong = 0;                 // of these by more than one sample
  int other_pixels = 0, missed = 0;  // pixels without; of these such that should have some
};
Agreement compare_with_moved(EdgeRenderer& renderer, const View& view, int samples) {
  std::vector<std::array<int, 4>> expected;
  for (const raster::SamplePosition& p : raster::sample_positions(samples)) {
    renderer.draw(moved(view, place_of_sample(p)), 0);
    const std::vector<Centre> centres = renderer.centres();
    expected.resize(centres.size());
    for (std::size_t i = 0; i < centres.size(); ++i)
      ++expected[i][static_cast<std::size_t>(renderer.kind_of(centres[i].primitive))];
  }
  renderer.draw(moved(view, {0.0, 0.0}), samples);
  const auto of_pixel = renderer.fragments();
  const std::vector<Centre> centres = renderer.centres();
  Agreement result;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    std::array<int, 4> found{};
    for (const EdgeFragment& f : of_pixel[i])
      found[static_cast<std::size_t>(renderer.kind_of(f.primitive))] += f.samples;
    if (of_pixel[i].empty())
      found[static_cast<std::size_t>(renderer.kind_of(centres[i].primitive))] = samples;
    (of_pixel[i].empty() ? result.other_pixels : result.edge_pixels) += 1;
    int differ = 0;  // a sample elsewhere counts twice
    for (std::size_t k = 0; k < found.size(); ++k) differ += std::abs(found[k] - expected[i][k]);
    if (of_pixel[i].empty())
      result.missed += differ > 0;
    else
      result.wrong += differ > 0, result.far_wrong += differ > 2;
  }
  return result;
}

// Vertices are rounded to 1/256 pixel after a matrix that is rounded itself, other ones in each
// picture: few samples in a thousand.
TEST(Edges, HoldWhatPicturesMovedByTheSamplesPlacesShow) {
  scene::Scene scene = plain_scene();
  scene.objects = {white_box({-3.0, 30.0}, {4.0, 3.0, 5.0}),
                   white_box({3.0, 60.0}, {3.0, 9.0, 9.0}),
                   white_box({6.0, 50.0}, {0.06, 0.06, 14.0})};
  const World world = world_of(scene);
  EdgeRenderer renderer(world);
  for (const int samples : {4, 8}) {
    const View view = north_view(3.0, 0.07, 0.6, kFragmentsSize_px.x, kFragmentsSize_px.y);
    const Agreement found = compare_with_moved(renderer, view, samples);
    EXPECT_GT(found.edge_pixels, 250);
    EXPECT_LE(found.wrong, found.edge_pixels / 50) << found.edge_pixels;
    EXPECT_EQ(found.missed, 0);
  }
}

// A level horizon may lie as near to a row of samples as rounding goes, so that each of its pixels
// is off by one. Parts of land and sea smaller than a pixel are not looked for.
TEST_P(EdgesOf, HoldWhatPicturesMovedByTheSamplesPlacesShow) {
  for (const int samples : {4, 8}) {
    const Agreement found = compare_with_moved(frame, view, samples);
    EXPECT_EQ(found.far_wrong, 0);
    EXPECT_LE(found.missed, found.edge_pixels / 50) << found.edge_pixels;
  }
}

}  // namespace
}  // namespace swell::render
