// Smooth edges: how parts of pixels are mixed, who asks for them, and what they cost.
#include <gtest/gtest.h>

#include "allocation_count.h"
#include "render/edges/edge_frames.h"
#include "render/edges/edge_scenes.h"

namespace swell::render {
namespace {

constexpr glm::ivec2 kOptionsSize_px(120, 90);

// A box before an even sky, of which only the front shows.
scene::Scene box_scene(double exposure) {
  scene::Scene scene = plain_scene();
  scene.sky.exposure = exposure;
  scene.objects = {white_box({0.0, 30.0}, {6.0, 6.0, 9.0})};
  return scene;
}

// One colour of a pixel's linear light.
double light(const EdgeRenderer& r, std::size_t pixel, int channel) {
  return static_cast<double>(r.target.linear[3 * pixel + static_cast<std::size_t>(channel)]);
}

// Light as the display shows it (resolve-inl.h): a shoulder from 0.4 up.
double tone(double x) {
  return x <= 0.4 ? x : std::min(1.0, 0.4 + (x - 0.4) / (1.0 + (x - 0.4) / 0.6));
}

// The mean of two lights by their samples.
struct Mix {
  double box, sky, share;  // of the box
  double of(double a, double b) const { return share * a + (1.0 - share) * b; }
  double linear() const { return of(box, sky); }
  double display(double exposure) const { return of(tone(exposure * box), tone(exposure * sky)); }
};

// Draws the box and calls visit(pixel, channel, mix) for its edge pixels with an inner pixel of
// each side next to them in their row.
template <class Visit>
int for_each_mix(EdgeRenderer& box, int samples, const Visit& visit) {
  box.options.keep_linear = true;
  box.draw(north_view(3.0, 0.15, 0.4, kOptionsSize_px.x, kOptionsSize_px.y), samples);
  const auto of_pixel = box.fragments();
  const std::vector<Centre> centres = box.centres();
  int visited = 0;
  for (int i = 4; i + 4 < kOptionsSize_px.x * kOptionsSize_px.y; ++i) {
    const auto pixel = static_cast<std::size_t>(i);
    const auto& parts = of_pixel[pixel];
    const auto inner = [&](std::size_t at, int kind) {
      return of_pixel[at].empty() && box.kind_of(centres[at].primitive) == kind;
    };
    // Three pixels aside, beyond the edge.
    const std::size_t left = pixel - 3, right = pixel + 3;
    const bool on_left = inner(left, 3) && inner(right, 0);
    if (parts.size() != 2 || !(on_left || (inner(left, 0) && inner(right, 3)))) continue;
    const bool first_is_box = box.kind_of(parts[0].primitive) == 3;
    if (first_is_box == (box.kind_of(parts[1].primitive) == 3)) continue;
    const double share = parts[first_is_box ? 0 : 1].samples / static_cast<double>(samples);
    for (int c = 0; c < 3; ++c)
      visit(
          pixel, c,
          Mix{light(box, on_left ? left : right, c), light(box, on_left ? right : left, c), share});
    ++visited;
  }
  return visited;
}

TEST(EdgeMix, OfLinearLightIsTheMeanByTheSamples) {
  const World world = world_of(box_scene(1.0));
  EdgeRenderer box(world);
  for (const int samples : {4, 8}) {
    const int visited = for_each_mix(box, samples, [&](std::size_t pixel, int c, const Mix& mix) {
      ASSERT_GT(std::abs(mix.box - mix.sky), 0.1) << "edges to see";
      ASSERT_NEAR(light(box, pixel, c), mix.linear(), 0.01 * std::max(mix.box, mix.sky));
    });
    EXPECT_GT(visited, 40);
  }
}

// At the higher exposure the box is far too bright to show, and counts as white.
TEST(EdgeMix, OfThePictureIsTheMeanOfWhatTheDisplayShows) {
  for (const double exposure : {0.6, 1.0, 8.0}) {
    const World world = world_of(box_scene(exposure));
    EdgeRenderer box(world);
    for (const int samples : {4, 8}) {
      double most_apart = 0.0;
      const int visited = for_each_mix(box, samples, [&](std::size_t pixel, int c, const Mix& mix) {
        // A byte's step of sRGB is at most 0.009 of light.
        ASSERT_NEAR(display_light(box.target.rgba[pixel], c), mix.display(exposure), 0.014)
            << exposure;
        most_apart =
            std::max(most_apart, std::abs(tone(exposure * mix.linear()) - mix.display(exposure)));
      });
      EXPECT_GT(visited, 40);
      if (exposure == 8.0) {
        EXPECT_GT(most_apart, 0.1) << "mixed before the curve";
      }
    }
  }
}

TEST(EdgeSamples, ComeFromTheSceneUnlessTheOptionsHaveSome) {
  scene::Scene scene = load_shipped("buoys");
  scene.picture.edge_samples = 4;
  const World with = world_of(scene);
  scene.picture.edge_samples = 0;
  const World without = world_of(scene);
  const View view = view_of(without, 1.0, kOptionsSize_px.x, kOptionsSize_px.y);
  const auto picture = [&](const World& world, int samples) {
    EdgeRenderer renderer(world, 1.0);
    renderer.draw(view, samples);
    return renderer.target.rgba;
  };
  EXPECT_EQ(picture(with, -1), picture(without, 4));
  EXPECT_EQ(picture(with, 8), picture(without, 8));
  EXPECT_EQ(picture(with, 0), picture(without, -1));
  EXPECT_NE(picture(without, 4), picture(without, 0));
}

TEST(EdgeSamples, OfTheSceneAreZeroFourOrEight) {
  const auto parsed = [](const std::string& value) {
    return scene::parse_scene("[picture]\nedge_samples = " + value + "\n", "test.toml");
  };
  EXPECT_EQ(scene::parse_scene("", "test.toml").picture.edge_samples, 0);
  for (const int samples : {0, 4, 8}) {
    const scene::Scene scene = parsed(std::to_string(samples));
    EXPECT_EQ(scene.picture.edge_samples, samples);
    EXPECT_EQ(scene::parse_scene(scene::dump_scene(scene), "test.toml").picture.edge_samples,
              samples);
  }
  for (const char* wrong : {"1", "2", "3", "5", "6", "16", "-4", "-1", "4.5", "\"4\"", "nan"}) {
    try {
      parsed(wrong);
      ADD_FAILURE() << wrong;
    } catch (const scene::SceneError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("test.toml:2: "), std::string::npos) << message;
      EXPECT_NE(message.find("picture.edge_samples"), std::string::npos) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  }
}

// In code too.
TEST(EdgeSamples, OfASceneMadeInCodeAreChecked) {
  for (const int wrong : {-4, 2, 16}) {
    scene::Scene scene = plain_scene();
    scene.picture.edge_samples = wrong;
    EXPECT_THROW(World{scene}, scene::SceneError) << wrong;
  }
}

TEST(EdgeSamplesDeathTest, AreFourOrEightOrNone) {
  const World& world = shipped_world("open_ocean");
  const View view = view_of(world, 0.0, 32, 32);
  EdgeRenderer renderer(world, 0.0, 1);
  EXPECT_DEATH(renderer.draw(view, 1), "edge_samples=1");
  EXPECT_DEATH(renderer.draw(view, 2), "edge_samples=2");
  EXPECT_DEATH(renderer.draw(view, 5), "edge_samples=5");
  EXPECT_DEATH(renderer.draw(view, 16), "edge_samples=16");
}

class EdgeFrames : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, EdgeFrames, testing::Values("lagoon", "buoys", "beach"),
                         [](const auto& test) { return std::string(test.param); });

// Storage grows to the largest frame so far, so the second round finds everything large enough.
TEST_P(EdgeFrames, AllocateNothingInTheSteadyState) {
  const World& world = shipped_world(GetParam());
  Shot film(1);
  const View view = view_of(world, 0.0, kOptionsSize_px.x, kOptionsSize_px.y);
  const auto round = [&] {
    for (const int samples : {8, 4, 0, 8})
      for (const double t_s : {0.0, 0.1, 0.2})
        film.draw(world, view, t_s,
                  {.water_triangles = 3000, .terrain_triangles = 3000, .edge_samples = samples});
  };
  round();
  const std::uint64_t before = allocation_count();
  round();
  EXPECT_EQ(allocation_count() - before, 0u);
}

// Each pixel shades each of its surfaces once: the parts that its centre does not show, which are
// few.
TEST_P(EdgeFrames, ShadeFewPartsBesidesThePixels) {
  const World& world = shipped_world(GetParam());
  EdgeRenderer renderer(world, 1.0);
  renderer.draw(view_of(world, 1.0, 4 * kOptionsSize_px.x, 4 * kOptionsSize_px.y), 8);
  std::size_t parts = 0;
  for (const auto& fragments : renderer.state().edges.of_tile)
    parts +=
        static_cast<std::size_t>(std::ranges::count(fragments, false, &EdgeFragment::is_centre));
  EXPECT_EQ(renderer.statistics.shaded_pixels, renderer.statistics.visible_pixels);
  EXPECT_GT(parts, 100u);
  EXPECT_LT(parts, renderer.target.rgba.size() / 50);
}

}  // namespace
}  // namespace swell::render
