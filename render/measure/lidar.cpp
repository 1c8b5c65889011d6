// A scan: for each moment of it the world is put there, then pieces of the beams go through it.
#include "render/measure/lidar.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <mutex>
#include <numeric>
#include <vector>

#include "math/check.h"
#include "math/elementary.h"
#include "math/random.h"
#include "math/with_ieee.h"
#include "ocean/open_sea/sea.h"
#include "ocean/open_sea/whitecaps.h"
#include "ocean/water_rays.h"
#include "render/frame/profile.h"
#include "render/labels/label_channels.h"
#include "render/measure/lidar_echo.h"
#include "render/measure/lidar_targets.h"
#include "render/measure/lidar_trees.h"
#include "render/sea/sea_maps.h"
#include "render/view/render_view.h"
#include "render/world/world.h"
#include "render/world/world_state.h"
#include "sky/fog.h"
#include "terrain/height_grid.h"

namespace swell::render {
namespace {

constexpr std::size_t kBeamsAtOnce = 256;
constexpr float kNothing_m = std::numeric_limits<float>::infinity();

glm::dvec3 direction_of(const LidarBeam& beam) {
  const double level = cos(beam.elevation_rad);
  return {level * cos(beam.azimuth_rad), level * sin(beam.azimuth_rad), sin(beam.elevation_rad)};
}

SensorPose pose_at(const LidarScan& scan, double time_s) {
  if (!scan.end) return scan.begin;
  const double part = std::clamp(time_s / scan.duration_s, 0.0, 1.0);
  const glm::dquat &a = scan.begin.world_from_sensor, &b = scan.end->world_from_sensor;
  const double side = glm::dot(a, b) < 0.0 ? -1.0 : 1.0;
  const glm::dquat turned = a * (1.0 - part) + b * (side * part);
  const double length = glm::length(turned);
  return {glm::mix(scan.begin.position_world, scan.end->position_world, part),
          length > 1e-6 ? turned / length : a};
}

void check_pose(const SensorPose& pose) {
  constexpr double kFarthest_m = 1e6;
  const glm::dvec3 p = glm::abs(pose.position_world);
  SWELL_CHECK(p.x <= kFarthest_m && p.y <= kFarthest_m && p.z <= kFarthest_m, "position={},{},{}",
              pose.position_world.x, pose.position_world.y, pose.position_world.z);
  const double length = glm::length(pose.world_from_sensor);
  SWELL_CHECK(std::abs(length - 1.0) < 1e-6, "quaternion of length {}", length);
}

void check_scan(const LidarScan& scan, std::size_t returns) {
  SWELL_CHECK(returns == scan.beams.size(), "{} beams, {} returns", scan.beams.size(), returns);
  SWELL_CHECK(std::abs(scan.t_s) <= 1e12, "t_s={}", scan.t_s);
  check_pose(scan.begin);
  if (scan.end) check_pose(*scan.end);
  SWELL_CHECK(scan.duration_s >= 0.0 && scan.duration_s <= 1e3, "duration_s={}", scan.duration_s);
  const bool needs_duration = scan.end || scan.moments > 1;
  SWELL_CHECK(!needs_duration || scan.duration_s > 0.0, "duration_s={}", scan.duration_s);
  SWELL_CHECK(scan.moments >= 1 && scan.moments <= 64, "moments={}", scan.moments);
  SWELL_CHECK(scan.least_m >= 0.0 && scan.least_m < scan.most_m && scan.most_m <= 1e5,
              "ranges from {} to {} m", scan.least_m, scan.most_m);
  SWELL_CHECK(scan.reach_m >= 0.0 && scan.reach_m <= 1e5, "reach_m={}", scan.reach_m);
  SWELL_CHECK(scan.range_noise_m >= 0.0 && scan.range_noise_m <= 10.0, "range_noise_m={}",
              scan.range_noise_m);
  for (const LidarBeam& beam : scan.beams)
    SWELL_CHECK(std::abs(beam.azimuth_rad) <= 1e6 && std::abs(beam.elevation_rad) <= 1e6 &&
                    std::abs(beam.time_s) <= 1e3,
                "beam={},{},{}", beam.azimuth_rad, beam.elevation_rad, beam.time_s);
}

// The beams of each moment, as pieces of one list.
struct BeamsByMoment {
  std::vector<std::uint32_t> beams;
  std::vector<std::size_t> first;  // by moment, and one more
};

BeamsByMoment beams_by_moment(const LidarScan& scan) {
  const auto moment_of = [&](std::uint32_t beam) {
    if (scan.moments == 1) return 0;
    const double part = scan.beams[beam].time_s / scan.duration_s;
    return static_cast<int>(std::clamp(part * scan.moments, 0.0, scan.moments - 1.0));
  };
  BeamsByMoment result;
  result.beams.resize(scan.beams.size());
  std::iota(result.beams.begin(), result.beams.end(), 0u);
  if (scan.moments > 1) std::ranges::stable_sort(result.beams, {}, moment_of);
  for (int moment = 0; moment <= scan.moments; ++moment) {
    const auto at = std::ranges::lower_bound(result.beams, moment, {}, moment_of);
    result.first.push_back(static_cast<std::size_t>(at - result.beams.begin()));
  }
  return result;
}

double time_of(const LidarScan& scan, int moment) {
  if (scan.moments == 1) return scan.t_s;
  return scan.t_s + (moment + 0.5) / scan.moments * scan.duration_s;
}

}  // namespace

struct Lidar::State {
  // A beam on its way. Those of one moment stand side by side.
  struct Way {
    glm::dvec3 origin_world{0.0}, along{0.0};
    glm::dvec3 along_sensor{0.0};
    LidarTarget target;
  };

  explicit State(const WorldState& of, Workers& workers)
      : world(of), shapes(make_lidar_shapes(of, workers)) {
    if (world.forest) tree_boxes = make_tree_boxes(*world.forest);
    if (!world.terrain) return;
    const double shallow_m = ocean::shallow_depth_m(*world.sea);
    map_slopes = {terrain::steepest_between(*world.terrain, -shallow_m, 0.0),
                  terrain::steepest_between(*world.terrain, -HUGE_VAL, HUGE_VAL)};
  }

  bool stays_on_map(const LidarScan& scan) const;
  void put_world(const LidarScan& scan, double t_s, Workers& workers);
  void start(const LidarScan& scan, std::span<const std::uint32_t> beams, Workers& workers);
  void meet_water(const LidarScan& scan, std::span<Way> some) const;
  LidarReturn answer(const LidarScan& scan, std::uint32_t beam, const Way& way) const;

  const WorldState& world;
  const LidarShapes shapes;
  BoxTree tree_boxes;
  ocean::GroundSlopes map_slopes;  // of the terrain's map
  // Of a moment.
  ocean::SeaFrame sea;
  ocean::WhitecapFrame whitecaps;
  ObjectTargets objects;
  TreeTargets trees;
  ocean::FrameBounds bounds;
  double water_slope = 0.0, air_per_m = 0.0;
  std::vector<Way> ways;
};

Lidar::Lidar(const World& world, Workers& workers)
    : state_(std::make_unique<State>(world.state(), workers)) {}
Lidar::~Lidar() = default;

// Whether no beam may leave the terrain's map.
bool Lidar::State::stays_on_map(const LidarScan& scan) const {
  const auto is_on_map = [&](const SensorPose& pose) {
    const glm::dvec2 p(pose.position_world), reach(scan.most_m);
    return world.terrain->grid.holds(p - reach) && world.terrain->grid.holds(p + reach);
  };
  return is_on_map(scan.begin) && (!scan.end || is_on_map(*scan.end));
}

// Puts the waves, the foam and the objects where they are at t_s.
void Lidar::State::put_world(const LidarScan& scan, double t_s, Workers& workers) {
  advance_waves(world, t_s, scan.disturbances, {}, sea, workers);
  ocean::advance_whitecaps(*world.whitecaps, t_s, whitecaps, workers);
  Profile profile;
  const StageRun run{workers, profile, Stage::kSea};
  objects.poses.resize(world.scene.objects.size());
  drawn_poses(world, sea, scan.poses, objects.poses, run);
  place_targets(world, t_s, scan.begin.position_world, objects);
  const bool is_known = world.terrain && stays_on_map(scan);
  bounds = ocean::frame_bounds(world.water(scan.disturbances), sea,
                               is_known ? map_slopes : ocean::GroundSlopes{});
  double resolved = 0.0;
  for (const ocean::PatchFrame& patch : sea.patches)
    resolved += static_cast<double>(patch.slope_variance);
  water_slope = unresolved_slope(world.scene.sea.wind_speed_mps, resolved);
  air_per_m = sky::fog_per_m(world.scene.air).x;
}

// Finds what the beams meet of the objects, the ground and the trees.
void Lidar::State::start(const LidarScan& scan, std::span<const std::uint32_t> beams,
                         Workers& workers) {
  ways.resize(std::max(ways.size(), beams.size()));
  const std::size_t pieces = (beams.size() + kBeamsAtOnce - 1) / kBeamsAtOnce;
  const auto for_ways = [&](const auto& body) {
    workers.for_each(pieces, [&](std::size_t piece, int) {
      const std::size_t first = piece * kBeamsAtOnce;
      body(first, std::min(beams.size(), first + kBeamsAtOnce));
    });
  };
  // Below all water a ray has met either the water or the ground.
  const auto ray_of = [&](const Way& way) {
    shapes::WorldRay ray{way.origin_world, way.along, std::min(scan.most_m, way.target.distance_m)};
    if (ray.along.z < 0.0)
      ray.farthest_m = std::min(ray.farthest_m, (bounds.lowest_m - ray.origin.z) / ray.along.z);
    return ray;
  };
  std::mutex mutex;
  std::vector<std::uint32_t> near;
  for_ways([&](std::size_t first, std::size_t end) {
    std::vector<std::uint32_t> near_these;
    for (std::size_t i = first; i < end; ++i) {
      const LidarBeam& beam = scan.beams[beams[i]];
      const SensorPose pose = pose_at(scan, beam.time_s);
      const glm::dvec3 along = direction_of(beam);
      Way& way = ways[i];
      way = {pose.position_world, glm::normalize(pose.world_from_sensor * along), along, {}};
      meet_objects(world, shapes, objects, ray_of(way), way.target);
      meet_ground(shapes, ray_of(way), way.target);
      if (world.forest) TreeTargets::list_near(*world.forest, tree_boxes, ray_of(way), near_these);
    }
    std::ranges::sort(near_these);
    near_these.erase(std::ranges::unique(near_these).begin(), near_these.end());
    const std::lock_guard lock(mutex);
    near.insert(near.end(), near_these.begin(), near_these.end());
  });
  if (near.empty()) return;
  std::ranges::sort(near);
  near.erase(std::ranges::unique(near).begin(), near.end());
  trees.place(world, sea.t_s, scan.begin.position_world, near, workers);
  for_ways([&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i)
      trees.meet(world, tree_boxes, ray_of(ways[i]), ways[i].target);
  });
}

// Puts the water in place of what lies under it or beyond.
void Lidar::State::meet_water(const LidarScan& scan, std::span<Way> some) const {
  std::array<glm::dvec3, kBeamsAtOnce> origin, along;
  std::array<double, kBeamsAtOnce> farthest_m, met_m;
  for (std::size_t i = 0; i < some.size(); ++i) {
    origin[i] = some[i].origin_world;
    along[i] = some[i].along;
    farthest_m[i] = std::min(scan.most_m, some[i].target.distance_m);
  }
  const ocean::WaterSurface water(world.water(scan.disturbances), sea);
  const std::size_t count = some.size();
  ocean::meet_water(water, bounds,
                    {std::span(origin).first(count), std::span(along).first(count),
                     std::span(farthest_m).first(count)},
                    std::span(met_m).first(count));
  std::array<glm::dvec2, kBeamsAtOnce> p;
  std::array<std::size_t, kBeamsAtOnce> wet;
  std::size_t wet_count = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (met_m[i] > farthest_m[i]) continue;
    some[i].target = {.distance_m = met_m[i]};
    if (met_m[i] == 0.0) continue;  // a beam that begins in water: lost
    p[wet_count] = glm::dvec2(origin[i] + met_m[i] * along[i]);
    wet[wet_count++] = i;
  }
  if (wet_count == 0) return;
  std::array<glm::vec2, kBeamsAtOnce> slope;
  std::array<float, kBeamsAtOnce> foam;
  const std::span<const glm::dvec2> places = std::span(p).first(wet_count);
  water.slopes(places, std::span(slope).first(wet_count));
  water.foam(places, whitecaps, std::span(foam).first(wet_count));
  for (std::size_t k = 0; k < wet_count; ++k) {
    Way& way = some[wet[k]];
    const glm::dvec3 normal(-glm::dvec2(slope[k]), 1.0);
    const double cosine =
        std::min(std::abs(glm::dot(normal, way.along)) / glm::length(normal), 1.0);
    const double clear = clear_water_echo(way.along, glm::dvec2(slope[k]), water_slope);
    const auto white = static_cast<double>(foam[k]);
    // The echo is what is known; a matt surface's is its reflectance times the cosine.
    way.target.cos_incidence = cosine;
    way.target.reflectance = water_echo(clear, white, cosine) / std::max(cosine, 1e-6);
    way.target.id = kWaterId;
    way.target.klass = white > 0.5 ? kFoamClass : kWaterClass;
  }
}

LidarReturn Lidar::State::answer(const LidarScan& scan, std::uint32_t beam, const Way& way) const {
  LidarReturn nothing;
  nothing.range_m = kNothing_m;
  nothing.p_sensor = glm::vec3(std::numeric_limits<float>::quiet_NaN());
  const LidarTarget& target = way.target;
  if (target.id == kSkyId || target.distance_m < scan.least_m || target.distance_m > scan.most_m)
    return nothing;
  const double lost = exp(-2.0 * air_per_m * target.distance_m);
  const double echo = std::min(target.reflectance * target.cos_incidence * lost, 1.0);
  double range_m = target.distance_m;
  if (scan.reach_m > 0.0 || scan.range_noise_m > 0.0) {
    const auto time_bits = std::bit_cast<std::uint64_t>(scan.t_s + 0.0);  // -0 as 0
    const GaussianPair chance = random_gaussian_pair(random_bits(scan.seed, time_bits), beam);
    if (!is_detected(echo, range_m, scan.reach_m, chance.first)) return nothing;
    range_m = std::max(range_m + scan.range_noise_m * chance.second, 0.0);
  }
  return {static_cast<float>(range_m),
          static_cast<float>(echo),
          static_cast<float>(acos(target.cos_incidence)),
          target.id,
          target.klass,
          glm::vec3(range_m * way.along_sensor)};
}

void Lidar::scan(const LidarScan& scan, std::span<LidarReturn> returns, Workers& workers) {
  check_scan(scan, returns.size());
  if (scan.beams.empty()) return;
  scene::check_given_poses(scan.poses, state_->world.scene.objects.size());
  State& state = *state_;
  const ScopedFloatEnvironment ieee;
  const BeamsByMoment order = beams_by_moment(scan);
  for (int moment = 0; moment < scan.moments; ++moment) {
    const std::size_t first = order.first[static_cast<std::size_t>(moment)];
    const std::size_t end = order.first[static_cast<std::size_t>(moment) + 1];
    const auto beams = std::span(order.beams).subspan(first, end - first);
    if (beams.empty()) continue;
    state.put_world(scan, time_of(scan, moment), workers);
    state.start(scan, beams, workers);
    workers.for_each((beams.size() + kBeamsAtOnce - 1) / kBeamsAtOnce, [&](std::size_t n, int) {
      const std::size_t begin = n * kBeamsAtOnce;
      const auto some =
          std::span(state.ways).subspan(begin, std::min(kBeamsAtOnce, beams.size() - begin));
      state.meet_water(scan, some);
      for (State::Way& way : some)
        if (way.target.id == kLandId)
          look_at_ground(state.world, {way.origin_world, way.along}, way.target);
      for (std::size_t i = 0; i < some.size(); ++i)
        returns[beams[begin + i]] = state.answer(scan, beams[begin + i], some[i]);
    });
  }
}

}  // namespace swell::render
