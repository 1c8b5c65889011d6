// Lidars, altimeters and echo sounders of rigs, against answers that are known without them.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "apps/sim/rig_run.h"
#include "math/elementary.h"
#include "math/random.h"
#include "render/measure/lidar_patterns.h"
#include "scene/camera_path.h"
#include "terrain/height_grid.h"

namespace swell::apps {
namespace {

struct CloudPoint {
  glm::vec3 p;
  float intensity;
  std::uint32_t t_ns;
  std::uint16_t ring;
};

// By the fields that the message names.
template <class Value>
Value field_of(const msg::PointCloud2& cloud, std::size_t point, const std::string& name) {
  for (const msg::PointField& field : cloud.point_fields)
    if (field.name == name) {
      Value value;
      std::memcpy(&value, cloud.data.data() + point * cloud.point_step + field.offset,
                  sizeof value);
      return value;
    }
  ADD_FAILURE() << "no field " << name;
  return {};
}

std::vector<CloudPoint> points_of(const msg::PointCloud2& cloud) {
  EXPECT_EQ(cloud.row_step, cloud.point_step * cloud.width);
  EXPECT_EQ(cloud.data.size(), std::size_t{cloud.row_step} * cloud.height);
  std::vector<CloudPoint> points;
  for (std::size_t i = 0; i < std::size_t{cloud.width} * cloud.height; ++i)
    points.push_back({{field_of<float>(cloud, i, "x"), field_of<float>(cloud, i, "y"),
                       field_of<float>(cloud, i, "z")},
                      field_of<float>(cloud, i, "intensity"),
                      field_of<std::uint32_t>(cloud, i, "t"),
                      field_of<std::uint16_t>(cloud, i, "ring")});
  return points;
}

msg::PointCloud2 last_cloud(const std::string& rig, const char* scene = kStillSea) {
  return std::get<msg::PointCloud2>(last_messages(rig, scene).at("/lidar/points"));
}

TEST(LidarSensor, OfAGridSeesAStillSeaRowByRow) {
  const msg::PointCloud2 cloud = last_cloud(R"(
[[lidar]]
name = "lidar"
position_m = [0, 0, 10]
rpy_deg = [0, 45, 0]
pattern = "grid"
columns = 4
rows = 3
fov_x_deg = 40
fov_y_deg = 60
)");
  EXPECT_EQ(cloud.header.frame_id, "lidar_link");
  EXPECT_EQ(cloud.height, 3u);
  EXPECT_EQ(cloud.width, 4u);
  EXPECT_EQ(cloud.point_fields.size(), 6u);
  EXPECT_TRUE(cloud.is_dense);
  const auto points = points_of(cloud);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 p(points[i].p);
    EXPECT_NEAR(10.0 + (p.z - p.x) * std::sqrt(0.5), 0.0, 1e-4) << i;  // on the water
    EXPECT_NEAR(std::atan2(p.y, p.x), radians(15.0 - 10.0 * static_cast<double>(i % 4)), 1e-6);
    EXPECT_NEAR(std::atan2(p.z, std::hypot(p.x, p.y)),
                radians(20.0 - 20.0 * static_cast<double>(i / 4)), 1e-6);
    EXPECT_EQ(points[i].ring, i / 4);
    EXPECT_EQ(points[i].t_ns, 0u);
  }
}

TEST(LidarSensor, ThatTurnsHasARowForEachOfItsBeams) {
  const msg::PointCloud2 cloud = last_cloud(R"(
[[lidar]]
name = "lidar"
position_m = [0, 0, 10]
pattern = "vlp-16"
columns = 8
rolling_shutter = true
class = true
id = true
)");
  EXPECT_EQ(cloud.height, 16u);
  EXPECT_EQ(cloud.width, 8u);
  EXPECT_EQ(cloud.point_fields.size(), 8u);
  EXPECT_FALSE(cloud.is_dense);  // half of the beams go up
  const auto points = points_of(cloud);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t row = i / 8, column = i % 8;
    EXPECT_EQ(points[i].ring, row);
    EXPECT_EQ(points[i].t_ns, column * 12'500'000u);  // of 0.1 s
    const double elevation = radians(-15.0 + 2.0 * static_cast<double>(row));
    const bool is_met = 10.0 / -std::sin(elevation) <= 100.0 && elevation < 0.0;
    EXPECT_EQ(std::isfinite(points[i].p.x), is_met) << row;
    EXPECT_EQ(field_of<std::uint16_t>(cloud, i, "class"), is_met ? 1 : 0);
    EXPECT_EQ(field_of<std::uint32_t>(cloud, i, "id"), is_met ? 1u : 0u);
    if (!is_met) continue;
    const double azimuth = -radians(45.0 * static_cast<double>(column));  // clockwise
    const double range_m = 10.0 / -std::sin(elevation), level_m = range_m * std::cos(elevation);
    EXPECT_NEAR(points[i].p.x, level_m * std::cos(azimuth), 1e-3);
    EXPECT_NEAR(points[i].p.y, level_m * std::sin(azimuth), 1e-3);
    EXPECT_NEAR(points[i].p.z, -10.0, 1e-4);
  }
}

// Of a turn of half a second that begins at half a second.
TEST(LidarSensor, BeamsOfARollingShutterLeaveFromWhereTheBodyIsThen) {
  const char* const rig = R"(
[[body]]
[[body.path]]
t_s = 0
position_m = [0, 0, 10]
[[body.path]]
t_s = 2
position_m = [0, 0, 30]
[[lidar]]
name = "lidar"
body = "base_link"
rate_hz = 2
pattern = "hdl-32e"
columns = 16
rolling_shutter = true
)";
  const auto points = points_of(last_cloud(rig));
  const auto path = scene::parse_rig(rig, "rig.toml", {}).bodies[0].path;
  const double begin_m = scene::pose_on_path(path, 0.5).eye_m.z;
  const double end_m = scene::pose_on_path(path, 1.0).eye_m.z;
  EXPECT_GT(end_m, begin_m + 3.0);
  for (std::size_t column = 0; column < 16; ++column)  // the lowest beams
    EXPECT_NEAR(points[column].p.z,
                -(begin_m + (end_m - begin_m) * static_cast<double>(column) / 16.0), 1e-4);
}

TEST(LidarSensor, PatternsOfRigsAreThoseThatThereAre) {
  for (const render::SpinningModel& model : render::spinning_models())
    EXPECT_EQ(std::ranges::count(scene::kLidarPatterns, model.name), 1) << model.name;
  EXPECT_EQ(scene::kLidarPatterns.size(), render::spinning_models().size() + 1);
}

// Walks along beams in steps of 2 cm: each is above the ground until it ends on it.
TEST(EchoSounder, EndsWhereTheGroundBegins) {
  const scene::Rig rig;
  const render::World world(scene::load_scene(SWELL_SOURCE_DIR "/scenes/harbour.toml"), 1);
  Workers workers(1);
  SimWorld sim_world(world, rig, workers);
  const terrain::HeightGrid& land = *world.water().terrain();
  int met = 0;
  for (std::uint64_t i = 0; i < 150; ++i) {
    const auto random = [&](std::uint64_t k) { return random_uniform(7, 4 * i + k); };
    const glm::dvec3 from(-60.0 + 120.0 * random(0), -40.0 + 80.0 * random(1), 12.0);
    const double azimuth = 2.0 * kPi * random(2), down = 0.1 + 1.4 * random(3);
    const glm::dvec3 along(std::cos(down) * std::cos(azimuth), std::cos(down) * std::sin(azimuth),
                           -std::sin(down));
    const double distance_m = sim_world.ground_distance(from, along, 60.0);
    const auto gap_m = [&](double s) {
      const glm::dvec3 p = from + s * along;
      return p.z - static_cast<double>(terrain::height_at(land, glm::dvec2(p)));
    };
    for (double s = 0.0; s < std::min(distance_m, 60.0); s += 0.02) ASSERT_GT(gap_m(s), -1e-5) << i;
    if (!std::isfinite(distance_m)) continue;
    EXPECT_NEAR(gap_m(distance_m), 0.0, 1e-5);
    ++met;
  }
  EXPECT_GT(met, 50);
  const glm::dvec3 below(0.0, -20.0, -30.0), up(0.0, 0.0, 1.0);
  EXPECT_EQ(sim_world.ground_distance(below, up, 60.0), 0.0);
}

}  // namespace
}  // namespace swell::apps
