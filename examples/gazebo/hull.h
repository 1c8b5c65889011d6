// A hull that floats: heave, roll and pitch of a boat that six columns of water carry. Axes are
// those of REP 103: x ahead, y to the left, z up; right-handed turns, so that a positive roll has
// the left side up and a positive pitch the bow down. Metres, seconds, radians.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

// Where a column stands, in the boat's frame, whose origin is the middle at the waterline. The
// columns stand on the keel's depth.
struct Column {
  double ahead_m, left_m;
};
constexpr std::size_t kColumnCount = 6;
constexpr std::array<Column, kColumnCount> kColumns = {
    {{1.7, 0.5}, {1.7, -0.5}, {0.0, 0.7}, {0.0, -0.7}, {-1.7, 0.6}, {-1.7, -0.6}}};

struct Quaternion {
  double x, y, z, w;
};

class Hull {
 public:
  // In "map": east, north, up.
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
  double yaw_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;  // turned about z, then y, then x
  double speed_mps = 0.0;                                 // ahead, kept as by an engine

  struct Place {
    double x_m, y_m, z_m;
  };
  // The foot of a column in "map".
  Place foot(std::size_t column) const {
    const double r = roll_rad, p = pitch_rad, ahead = kColumns[column].ahead_m,
                 left = kColumns[column].left_m, up = -kDraught_m;
    const double level_x =
        std::cos(p) * ahead + std::sin(p) * (std::sin(r) * left + std::cos(r) * up);
    const double level_y = std::cos(r) * left - std::sin(r) * up;
    return {x_m + std::cos(yaw_rad) * level_x - std::sin(yaw_rad) * level_y,
            y_m + std::sin(yaw_rad) * level_x + std::cos(yaw_rad) * level_y,
            z_m - std::sin(p) * ahead + std::cos(p) * (std::sin(r) * left + std::cos(r) * up)};
  }

  Quaternion orientation() const {
    const double sr = std::sin(0.5 * roll_rad), cr = std::cos(0.5 * roll_rad);
    const double sp = std::sin(0.5 * pitch_rad), cp = std::cos(0.5 * pitch_rad);
    const double sy = std::sin(0.5 * yaw_rad), cy = std::cos(0.5 * yaw_rad);
    return {sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy,
            cr * cp * cy + sr * sp * sy};
  }

  // One step from a time at which the water over or under each foot is at these heights. Each
  // column lifts by its depth (Archimedes) and is damped by how fast this grows, which is how fast
  // the water rises along the hull. The lifts are vertical, angular rates those of the angles: both
  // hold for the moderate angles at which a boat stays upright.
  void step(const std::array<double, kColumnCount>& water_z_m, double step_s) {
    double lift_n = 0.0, roll_torque_nm = 0.0, pitch_torque_nm = 0.0;
    for (std::size_t n = 0; n < kColumnCount; ++n) {
      const Place at = foot(n);
      const double depth_m = std::clamp(water_z_m[n] - at.z_m, 0.0, kMostDepth_m);
      const double rate_mps = has_depths_ ? (depth_m - depth_m_[n]) / step_s : 0.0;
      const double force_n = kDensity_kg_m3 * kGravity_mps2 * kColumnArea_m2 *
                             std::max(depth_m + kDampingTime_s * rate_mps, 0.0);
      const double east = at.x_m - x_m, north = at.y_m - y_m;
      lift_n += force_n;
      roll_torque_nm += force_n * (std::cos(yaw_rad) * north - std::sin(yaw_rad) * east);
      pitch_torque_nm -= force_n * (std::cos(yaw_rad) * east + std::sin(yaw_rad) * north);
      depth_m_[n] = depth_m;
    }
    has_depths_ = true;
    rise_mps_ += (lift_n / kMass_kg - kGravity_mps2) * step_s;
    roll_rad_s_ += roll_torque_nm / (kMass_kg * kRollRadius_m * kRollRadius_m) * step_s;
    pitch_rad_s_ += pitch_torque_nm / (kMass_kg * kPitchRadius_m * kPitchRadius_m) * step_s;
    x_m += std::cos(yaw_rad) * speed_mps * step_s;
    y_m += std::sin(yaw_rad) * speed_mps * step_s;
    z_m += rise_mps_ * step_s;
    roll_rad += roll_rad_s_ * step_s;
    pitch_rad += pitch_rad_s_ * step_s;
  }

  static constexpr double kDraught_m = 0.375;  // at rest
  static constexpr double kMostDepth_m = 1.5;  // of the hull: then it is under water
  static constexpr double kColumnArea_m2 = 1.1;
  static constexpr double kDensity_kg_m3 = 1025.0, kGravity_mps2 = 9.81;
  static constexpr double kMass_kg = kDensity_kg_m3 * kColumnCount * kColumnArea_m2 * kDraught_m;
  static constexpr double kRollRadius_m = 0.7, kPitchRadius_m = 1.4;  // of gyration
  static constexpr double kDampingTime_s = 0.12;

 private:
  std::array<double, kColumnCount> depth_m_{};
  bool has_depths_ = false;
  double rise_mps_ = 0.0, roll_rad_s_ = 0.0, pitch_rad_s_ = 0.0;
};
