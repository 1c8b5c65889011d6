// What of a scene stands in its rivers.
#include "scene/obstacles.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "ocean/inland/river_network.h"
#include "scene/scene.h"

namespace swell::scene {
namespace {

// A river that runs north, 20 m wide, 3 m over the sea.
std::vector<ocean::Obstacle> obstacles_of(const std::string& objects) {
  const Scene scene = parse_scene(R"(
[terrain]
island_radius_m = 400
[[lake]]
name = "pond"
level_m = 3
outline_m = [[-30, 180], [30, 180], [30, 240], [-30, 240]]
depth_m = 2
[[river]]
into = "pond"
path_m = [[0, -200], [0, 200]]
width_m = [20]
surface_m = [3, 3]
speed_mps = 1
)" + objects,
                                  "obstacles.toml");
  return river_obstacles(scene, {scene.rivers, scene.lakes});
}

TEST(RiverObstacles, AreWhatIsMooredInARiverWithItsSizeAndHeading) {
  const auto boat = obstacles_of(
      "[[object]]\nkind = \"boat\"\nposition_m = [3, 20]\nheading_deg = 90\nsize_m = [2, 5, 1]\n");
  ASSERT_EQ(boat.size(), 1u);
  EXPECT_EQ(boat[0].middle, glm::dvec2(3.0, 20.0));
  EXPECT_NEAR(boat[0].ahead.x, 1.0, 1e-12);
  EXPECT_EQ(boat[0].half_m, glm::dvec2(1.0, 2.5));
  EXPECT_TRUE(boat[0].is_round);
  const auto box = obstacles_of("[[object]]\nkind = \"box\"\nposition_m = [3, 20]\n");
  ASSERT_EQ(box.size(), 1u);
  EXPECT_FALSE(box[0].is_round);
}

TEST(RiverObstacles, AreWhatIsFixedWhereItPassesTheSurface) {
  const std::string rock = "[[object]]\nkind = \"rock\"\nposition_m = [0, 0]\nsize_m = [4, 3, 2]\n";
  EXPECT_EQ(obstacles_of(rock + "height_m = 3.0\n").size(), 1u);
  EXPECT_EQ(obstacles_of(rock + "height_m = 2.2\n").size(), 1u);
  EXPECT_TRUE(obstacles_of(rock + "height_m = 0.0\n").empty());  // in the bed
  EXPECT_TRUE(obstacles_of(rock + "height_m = 6.0\n").empty());  // in the air
}

TEST(RiverObstacles, AreNotWhatMovesOrStandsElsewhere) {
  const std::string ball = "[[object]]\nkind = \"sphere\"\nsize_m = [2, 2, 2]\n";
  EXPECT_EQ(obstacles_of(ball + "position_m = [5, 0]\n").size(), 1u);
  EXPECT_TRUE(obstacles_of(ball + "position_m = [5, 0]\ndrift = true\n").empty());
  EXPECT_TRUE(obstacles_of(ball + "path_m = [[5, 0], [5, 9]]\n").empty());
  EXPECT_TRUE(obstacles_of(ball + "position_m = [40, 0]\n").empty());   // on land
  EXPECT_TRUE(obstacles_of(ball + "position_m = [0, 215]\n").empty());  // in the lake
  EXPECT_TRUE(obstacles_of(ball + "position_m = [900, 0]\n").empty());  // at sea
}

TEST(RiverObstacles, OfAPierAreItsPostsInTheWater) {
  const auto posts = obstacles_of(
      "[[object]]\nkind = \"pier\"\nposition_m = [14, 0]\nheading_deg = 90\nheight_m = 3\n");
  // From x = -4 on 36 m long: those with x < 10.
  ASSERT_EQ(posts.size(), 8u);
  for (const ocean::Obstacle& post : posts) {
    EXPECT_LT(post.middle.x, 10.2);
    EXPECT_NEAR(post.half_m.x, 0.16, 1e-9);
    EXPECT_NEAR(post.half_m.y, 0.16, 1e-9);
    EXPECT_NEAR(std::abs(post.middle.y), 1.1, 1e-9);
  }
}

}  // namespace
}  // namespace swell::scene
