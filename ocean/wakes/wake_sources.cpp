#include "ocean/wakes/wake_sources.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "math/elementary.h"
#include "math/random.h"
#include "math/smoothstep.h"

namespace swell::ocean {
namespace {

// Waves that wrap round in a window fade before they do (wake_modes.h); of rings those that are
// left after so many times sqrt(radius / g) are small.
constexpr double kRingFades = 50.0, kRingEnds = 90.0;
constexpr double kRingWindow = 64.0;  // in radii, up to the next power of two
constexpr double kGust_s = 0.4;       // between a rotor's, at least
constexpr double kMostGusts = 48.0;   // of a rotor that are seen at a time

double ring_time_s(double radius_m, double gravity_mps2) {
  return std::sqrt(radius_m / gravity_mps2);
}

// Water that meets the hull at its speed rises to U^2 / 2g.
float most_height_m(const Disturbance& hull, double gravity_mps2) {
  const double head_m = 0.5 * hull.speed_mps * hull.speed_mps / gravity_mps2;
  return static_cast<float>(std::min(head_m, 2.0 * hull.hull_m.z));
}

// Length of the waves that follow a hull at its speed.
double transverse_wave_m(const Disturbance& hull, double gravity_mps2) {
  return kTwoPi * hull.speed_mps * hull.speed_mps / gravity_mps2;
}

// ---- Lists

bool is_under_way(const Disturbance& d) {
  return d.kind == DisturbanceKind::kHull && d.path_m.size() >= 2 && d.speed_mps > 0.0;
}

// Largest first, and then anything that tells two hulls apart.
bool comes_first(const Disturbance* a, const Disturbance* b) {
  const auto key = [](const Disturbance& d) {
    return std::tuple(-d.hull_m.x * d.hull_m.y, -d.hull_m.z, d.speed_mps, d.path_closed, d.depth_m,
                      d.path_m.size());
  };
  if (key(*a) != key(*b)) return key(*a) < key(*b);
  return std::ranges::lexicographical_compare(a->path_m, b->path_m, [](glm::dvec2 p, glm::dvec2 q) {
    return std::tuple(p.x, p.y) < std::tuple(q.x, q.y);
  });
}

void add_ring(const TimedRing& ring, double gravity_mps2, double t_s, WakeFrame& frame) {
  const double age = (t_s - ring.t_s) / ring_time_s(ring.radius_m, gravity_mps2);
  if (age >= 0.0 && age < kRingEnds && ring.height_m != 0.0) frame.rings.push_back(ring);
}

// The gusts of a rotor that may still be seen: at random places under it, up or down.
void add_gusts(const Disturbance& rotor, double gravity_mps2, double t_s, WakeFrame& frame) {
  const double radius_m = 0.4 * rotor.radius_m;
  const double seen_s = kRingEnds * ring_time_s(radius_m, gravity_mps2);
  const double gust_s = std::max(kGust_s, seen_s / kMostGusts);
  const double last_s = std::min(t_s - rotor.t_s, rotor.duration_s);
  const double first_s = std::max(t_s - rotor.t_s - seen_s, 0.0);
  const auto seed = static_cast<std::uint64_t>(std::llround(64.0 * rotor.position_m.x)) ^
                    static_cast<std::uint64_t>(std::llround(64.0 * rotor.position_m.y)) << 32;
  for (double n = std::ceil(first_s / gust_s); n * gust_s <= last_s; n += 1.0) {
    const auto counter = 3 * static_cast<std::uint64_t>(n);
    const double out_m = rotor.radius_m * std::sqrt(random_uniform(seed, counter));
    const SinCos turn = sin_cos_turns(random_uniform(seed, counter + 1));
    const double height = 2.0 * random_uniform(seed, counter + 2) - 1.0;
    add_ring({rotor.t_s + n * gust_s, rotor.position_m + out_m * glm::dvec2(turn.sin, turn.cos),
              rotor.position_m, radius_m, height * rotor.height_m},
             gravity_mps2, t_s, frame);
  }
}

void add_rings(const Disturbance& d, double gravity_mps2, double t_s, WakeFrame& frame) {
  const auto ring = [&](double radius_m, double height_m) {
    add_ring({d.t_s, d.position_m, d.position_m, radius_m, height_m}, gravity_mps2, t_s, frame);
  };
  switch (d.kind) {
    case DisturbanceKind::kDrop:
      return ring(d.radius_m, d.height_m);
    case DisturbanceKind::kFootstep:  // what is pressed down stands around it
      ring(d.radius_m, -d.height_m);
      return ring(2.0 * d.radius_m, 0.25 * d.height_m);
    case DisturbanceKind::kRotor:
      return add_gusts(d, gravity_mps2, t_s, frame);
    case DisturbanceKind::kHull:
      break;
  }
}

void sort_sources(std::span<const Disturbance> some, std::span<const Disturbance> others,
                  double gravity_mps2, double t_s, WakeFrame& frame) {
  frame.order.clear();
  frame.rings.clear();
  for (const auto& list : {some, others}) {
    for (const Disturbance& d : list) {
      if (is_under_way(d)) frame.order.push_back(&d);
      add_rings(d, gravity_mps2, t_s, frame);
    }
  }
  std::ranges::sort(frame.order, comes_first);
  frame.order.resize(std::min(frame.order.size(), kMostHullWindows));
  std::ranges::sort(frame.rings, {}, &TimedRing::key);
  if (frame.rings.size() > kMostRings)
    frame.rings.erase(frame.rings.begin(), frame.rings.end() - kMostRings);
}

// ---- Windows

WakeWindow& next_window(WakeFrame& frame) {
  if (frame.windows.size() == frame.count) frame.windows.emplace_back();
  WakeWindow& window = frame.windows[frame.count++];
  window.rings.clear();
  window.stretches.clear();
  window.bound_m = 0.0f;
  window.most_counts = 0.0f;
  return window;
}

// Counts of waves of k to the window, no more than two to five samples.
void reach_to(double k_rad_m, WakeWindow& window) {
  const double counts = std::min(k_rad_m * window.length_m / kTwoPi, 0.4 * kWakeSamples);
  window.most_counts = std::max(window.most_counts, static_cast<float>(counts));
}

// Rings of like size and place share a window, whichever others there are: windows stand on a
// lattice.
struct RingSquare {
  double length_m;
  glm::dvec2 corner_m;
};

RingSquare square_of(const TimedRing& ring) {
  double length_m = 1.0;
  while (length_m < kRingWindow * ring.radius_m) length_m *= 2.0;
  const double cell_m = 0.25 * length_m;
  return {length_m, glm::floor(ring.home_m / cell_m) * cell_m + 0.5 * (cell_m - length_m)};
}

WakeWindow* ring_window(const TimedRing& ring, double gravity_mps2, WakeFrame& frame) {
  const RingSquare square = square_of(ring);
  for (std::size_t i = 0; i < frame.count; ++i) {
    WakeWindow& window = frame.windows[i];
    if (window.stretches.empty() && window.length_m == square.length_m &&
        window.corner_m == square.corner_m)
      return &window;
  }
  if (frame.count == kMostWakeWindows) return nullptr;
  WakeWindow& window = next_window(frame);
  window.corner_m = square.corner_m;
  window.end_m = glm::vec2(0.0f);
  window.length_m = square.length_m;
  window.depth_m = 0.0f;
  window.gravity_mps2 = static_cast<float>(gravity_mps2);
  return &window;
}

// Latest first, so that where there are too many windows the oldest rings are left out.
void place_rings(double gravity_mps2, double t_s, WakeFrame& frame) {
  for (std::size_t i = frame.rings.size(); i-- > 0;) {
    const TimedRing& ring = frame.rings[i];
    WakeWindow* const window = ring_window(ring, gravity_mps2, frame);
    if (window == nullptr) continue;
    const glm::vec2 at(ring.p_world - window->corner_m);
    const double age_s = t_s - ring.t_s;
    const double left =
        1.0 - smoothstep(kRingFades, kRingEnds, age_s / ring_time_s(ring.radius_m, gravity_mps2));
    window->rings.push_back({at.x, at.y, static_cast<float>(age_s),
                             static_cast<float>(ring.radius_m),
                             static_cast<float>(left * ring.height_m)});
    window->bound_m = std::max(window->bound_m, 2.0f * static_cast<float>(std::abs(ring.height_m)));
    reach_to(5.3 / ring.radius_m, *window);
  }
}

// A hull's way, walked back from where it is.
struct Way {
  const Disturbance& hull;
  double length_m;

  explicit Way(const Disturbance& d) : hull(d), length_m(0.0) {
    for (std::size_t i = 0; i < pieces(); ++i) length_m += glm::length(piece(i));
  }
  std::size_t pieces() const { return hull.path_m.size() - (hull.path_closed ? 0 : 1); }
  glm::dvec2 from(std::size_t i) const { return hull.path_m[i]; }
  glm::dvec2 piece(std::size_t i) const {
    return hull.path_m[(i + 1) % hull.path_m.size()] - hull.path_m[i];
  }

  // Calls visit(from age, to age, place at age 0 if it had always gone so, velocity) for the latest
  // pieces, up to an age.
  template <class Visit>
  void walk_back(double t_s, double oldest_s, const Visit& visit) const {
    const double speed = hull.speed_mps;
    double s = speed * t_s, age_s = 0.0;
    if (hull.path_closed) {
      s -= length_m * std::floor(s / length_m);
    } else if (s > length_m) {
      age_s = (s - length_m) / speed;
      s = length_m;
    }
    if (s < 0.0) return;
    std::size_t i = 0;
    double begin_m = 0.0;
    while (i + 1 < pieces() && s > begin_m + glm::length(piece(i)))
      begin_m += glm::length(piece(i++));
    for (std::size_t n = 0; n < kMostStretches && age_s < oldest_s; ++n) {
      const glm::dvec2 velocity = piece(i) * (speed / glm::length(piece(i)));
      const double to_s = std::min(age_s + (s - begin_m) / speed, oldest_s);
      const glm::dvec2 now = from(i) + velocity * ((s - begin_m) / speed + age_s);
      if (to_s > age_s) visit(age_s, to_s, now, velocity);
      age_s = to_s;
      if (i == 0 && !hull.path_closed) return;
      i = (i + pieces() - 1) % pieces();
      s = glm::length(piece(i));
      begin_m = 0.0;
    }
  }

  glm::dvec2 place_at(double t_s) const {
    glm::dvec2 place = hull.path_m.front();
    const double s = hull.speed_mps * t_s;
    if (!hull.path_closed && s >= length_m) return hull.path_m.back();
    walk_back(t_s, 1e-9, [&](double, double, glm::dvec2 now, glm::dvec2) { place = now; });
    return place;
  }
};

// A hull's window holds the last waves behind it, and keeps room before the bow.
constexpr double kTransverseWaves = 8.0, kLeastHulls = 9.0, kMostHulls = 40.0;
constexpr double kBehind = 0.31;  // of the window's length, its middle behind the hull

double window_length_m(const Disturbance& hull, double gravity_mps2) {
  const double waves_m = kTransverseWaves * transverse_wave_m(hull, gravity_mps2);
  return std::clamp(waves_m, kLeastHulls * hull.hull_m.y, kMostHulls * hull.hull_m.y);
}

void place_hull(const Disturbance& d, double gravity_mps2, double t_s, WakeFrame& frame) {
  const Way way(d);
  const double length_m = window_length_m(d, gravity_mps2), sample_m = length_m / kWakeSamples;
  const double crosses_s = length_m / d.speed_mps;
  WakeWindow& window = next_window(frame);
  const glm::dvec2 middle = way.place_at(t_s - kBehind * crosses_s);
  const glm::dvec2 end = middle - 0.5 * length_m;
  window.corner_m = glm::floor(end / sample_m) * sample_m;
  window.end_m = glm::vec2(end - window.corner_m);
  window.length_m = length_m;
  window.depth_m = static_cast<float>(d.depth_m);
  window.gravity_mps2 = static_cast<float>(gravity_mps2);
  window.bound_m = most_height_m(d, gravity_mps2);
  window.hull = {static_cast<float>(d.hull_m.x), static_cast<float>(d.hull_m.y),
                 static_cast<float>(d.hull_m.z), static_cast<float>(d.speed_mps)};
  way.walk_back(t_s, 4.0 * crosses_s,
                [&](double from_s, double to_s, glm::dvec2 now, glm::dvec2 velocity) {
                  const glm::vec2 at(now - window.corner_m), v(velocity);
                  window.stretches.push_back(
                      {at.x, at.y, v.x, v.y, static_cast<float>(from_s), static_cast<float>(to_s)});
                });
  if (window.stretches.empty()) {
    --frame.count;
    return;
  }
  reach_to(3.7 / (0.075 * d.hull_m.y), window);
  reach_to(3.7 / (0.30 * d.hull_m.x), window);
}

}  // namespace

void WakeBounds::include(const WakeBounds& other) {
  height_m = std::max(height_m, other.height_m);
  slope = std::max(slope, other.slope);
  wavelength_m = std::max(wavelength_m, other.wavelength_m);
}

WakeBounds wake_bounds(std::span<const Disturbance> disturbances, double gravity_mps2) {
  WakeBounds bounds;
  for (const Disturbance& d : disturbances) {
    WakeBounds own;
    if (is_under_way(d)) {
      own.height_m = most_height_m(d, gravity_mps2);
      own.wavelength_m = std::min(transverse_wave_m(d, gravity_mps2), 2.0 * d.hull_m.y);
    } else if (d.kind != DisturbanceKind::kHull) {
      own.height_m = 2.0f * static_cast<float>(std::abs(d.height_m));
      own.wavelength_m = kTwoPi * d.radius_m;
    }
    own.slope = kMostWakeSlope;
    bounds.include(own);
  }
  return bounds;
}

void find_wake_sources(std::span<const Disturbance> some, std::span<const Disturbance> others,
                       double gravity_mps2, double t_s, WakeFrame& frame) {
  frame.count = 0;
  sort_sources(some, others, gravity_mps2, t_s, frame);
  for (const Disturbance* const hull : frame.order) place_hull(*hull, gravity_mps2, t_s, frame);
  place_rings(gravity_mps2, t_s, frame);
}

}  // namespace swell::ocean
