#include "wave_provider.h"

#include <cmath>
#include <stdexcept>

namespace {

void check(swell_status status) {
  if (status != SWELL_OK) throw std::runtime_error(swell_last_error());
}

swell_query query_at(const std::vector<Point>& points, double t_s) {
  static_assert(sizeof(Point) == 2 * sizeof(double));
  swell_query query{};
  query.size = sizeof(query);
  query.t_s = t_s;
  query.count = points.size();
  query.xy_m = &points.data()->x;
  return query;
}

double blend(double a, double b, double share) { return a + share * (b - a); }

}  // namespace

WaveProvider::WaveProvider(const std::string& scene_file, double start_s, double step_s)
    : start_s_(start_s), step_s_(step_s) {
  swell_world* world = nullptr;
  check(swell_world_load(scene_file.c_str(), &world));
  world_.reset(world);
  for (auto& session : sessions_) {
    swell_session* made = nullptr;
    check(swell_session_create(world, 1, &made));
    session.reset(made);
  }
}

swell_session* WaveProvider::session_of(double step) {
  const bool is_odd = std::fmod(step, 2.0) != 0.0;
  return sessions_[is_odd].get();
}

std::vector<WaterSample> WaveProvider::samples_at_step(const std::vector<Point>& points,
                                                       double step) {
  const std::size_t n = points.size();
  std::vector<float> height(n), normal(3 * n), velocity(3 * n);
  swell_query query = query_at(points, step * step_s_);
  query.height_m = height.data();
  query.normal = normal.data();
  query.velocity_mps = velocity.data();
  check(swell_ask(session_of(step), &query));
  std::vector<WaterSample> samples(n);
  for (std::size_t i = 0; i < n; ++i)
    samples[i] = {height[i],
                  {normal[3 * i], normal[3 * i + 1], normal[3 * i + 2]},
                  {velocity[3 * i], velocity[3 * i + 1], velocity[3 * i + 2]}};
  return samples;
}

std::vector<WaterSample> WaveProvider::samples(const std::vector<Point>& points, double t_s) {
  const double steps = (start_s_ + t_s) / step_s_, before = std::floor(steps);
  std::vector<WaterSample> samples = samples_at_step(points, before);
  const std::vector<WaterSample> after = samples_at_step(points, before + 1.0);
  const double share = steps - before;
  for (std::size_t i = 0; i < points.size(); ++i) {
    WaterSample& s = samples[i];
    s.elevation_m = blend(s.elevation_m, after[i].elevation_m, share);
    for (std::size_t c = 0; c < 3; ++c) {
      s.normal[c] = blend(s.normal[c], after[i].normal[c], share);
      s.velocity_mps[c] = blend(s.velocity_mps[c], after[i].velocity_mps[c], share);
    }
    const double length = std::hypot(s.normal[0], s.normal[1], s.normal[2]);
    for (double& component : s.normal) component /= length;
  }
  return samples;
}

std::vector<float> WaveProvider::velocities_at_step(const std::vector<PlaceBelow>& places,
                                                    double step) {
  static_assert(sizeof(PlaceBelow) == 3 * sizeof(double));
  std::vector<float> velocity(3 * places.size());
  swell_below below{};
  below.size = sizeof(below);
  below.t_s = step * step_s_;
  below.count = places.size();
  below.xyz_m = &places.data()->x;
  below.velocity_mps = velocity.data();
  check(swell_ask_below(session_of(step), &below));
  return velocity;
}

std::vector<std::array<double, 3>> WaveProvider::velocities_below(
    const std::vector<PlaceBelow>& places, double t_s) {
  const double steps = (start_s_ + t_s) / step_s_, before = std::floor(steps);
  const std::vector<float> first = velocities_at_step(places, before);
  const std::vector<float> second = velocities_at_step(places, before + 1.0);
  std::vector<std::array<double, 3>> velocities(places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      velocities[i][c] = blend(first[3 * i + c], second[3 * i + c], steps - before);
  return velocities;
}

double WaveProvider::elevation(double x, double y, double t_s) {
  return samples({{x, y}}, t_s)[0].elevation_m;
}

std::array<double, 3> WaveProvider::normal(double x, double y, double t_s) {
  return samples({{x, y}}, t_s)[0].normal;
}

std::array<double, 3> WaveProvider::particle_velocity(double x, double y, double t_s) {
  return samples({{x, y}}, t_s)[0].velocity_mps;
}

double WaveProvider::still_water_depth(double x, double y) {
  const std::vector<Point> point = {{x, y}};
  float depth_m = 0.0f;
  swell_query query = query_at(point, start_s_);
  query.still_depth_m = &depth_m;
  check(swell_ask(sessions_[0].get(), &query));
  return static_cast<double>(depth_m);
}
