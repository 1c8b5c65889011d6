// Where things beyond the water's surface appear, against Snell's law solved by bisection.
#include "render/view/refracted_image.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "constants.h"
#include "math/random.h"

namespace swell::render {
namespace {

constexpr double kWaterIndex = 1.333;

// The angle in air of the way between two points, by bisection of s = sin(t_air).
double angle_in_air(double air_m, double water_m, double horizontal_m) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 200; ++i) {
    const double s = 0.5 * (low + high), w = s / kWaterIndex;
    const double reached =
        air_m * s / std::sqrt(1.0 - s * s) + water_m * w / std::sqrt(1.0 - w * w);
    (reached < horizontal_m ? low : high) = s;
  }
  return std::asin(low);
}

double in_water(double angle_in_air) { return std::asin(std::sin(angle_in_air) / kWaterIndex); }

struct Trial {
  double air_m, water_m, horizontal_m;

  BentWay way() const {
    return {static_cast<float>(air_m), static_cast<float>(water_m),
            static_cast<float>(horizontal_m)};
  }
};

// Heights, depths and distances from centimetres to kilometres.
template <class Check>
void for_trials(double least_air_m, const Check& check) {
  std::uint64_t at = 0;
  const auto between = [&](double low, double high) {
    return std::exp(std::log(low) + std::log(high / low) * random_uniform(12, at++));
  };
  for (int i = 0; i < 20000; ++i)
    check(Trial{between(least_air_m, 1e4), between(0.01, 300.0), between(0.01, 1e5)});
}

// A pixel of a wide picture is about 1e-3 rad.
constexpr double kHalfPixel = 5e-4;

TEST(RefractedImage, OfAPointInWaterLiesOnTheRayThatAnEyeInAirSees) {
  for_trials(0.05, [](const Trial& t) {
    const double angle = angle_in_air(t.air_m, t.water_m, t.horizontal_m);
    const double depth_m = apparent_depth_m(t.way(), static_cast<float>(kWaterIndex));
    ASSERT_NEAR(std::atan2(t.horizontal_m, t.air_m + depth_m), angle, 0.1 * kHalfPixel)
        << t.air_m << ' ' << t.water_m << ' ' << t.horizontal_m;
  });
}

TEST(RefractedImage, OfAPointInAirLiesOnTheRayThatAnEyeInWaterSees) {
  for_trials(1e-3, [](const Trial& t) {
    const double angle = in_water(angle_in_air(t.air_m, t.water_m, t.horizontal_m));
    const double height_m = apparent_height_m(t.way(), static_cast<float>(kWaterIndex));
    ASSERT_NEAR(std::atan2(t.horizontal_m, t.water_m + height_m), angle, 0.2 * kHalfPixel)
        << t.air_m << ' ' << t.water_m << ' ' << t.horizontal_m;
  });
}

// k = tan(t_water) / tan(t_air), apparent over true depth, by the angle in air.
struct Row {
  double degrees, k;
};
constexpr std::array kTable = {Row{0, .750188},  Row{10, .745140}, Row{20, .729362},
                               Row{30, .700853}, Row{40, .655983}, Row{45, .625761},
                               Row{50, .589226}, Row{60, .493410}, Row{70, .361756},
                               Row{80, .193296}, Row{85, .098402}};

TEST(RefractedImage, ApparentDepthAndHeightAreTheTables) {
  for (const Row& row : kTable) {
    const double air = std::tan(row.degrees * kDegree);
    const double water = std::tan(in_water(row.degrees * kDegree));
    for (const auto [air_m, water_m] : {std::array{2.0, 2.0}, {10.0, 3.0}, {0.5, 20.0}}) {
      const BentWay way = Trial{air_m, water_m, air_m * air + water_m * water}.way();
      const auto n = static_cast<float>(kWaterIndex);
      EXPECT_NEAR(apparent_depth_m(way, n) / water_m, row.k, 1e-5) << row.degrees;
      EXPECT_NEAR(air_m / apparent_height_m(way, n), row.k, 1e-5) << row.degrees;
    }
  }
}

// The whole sky is squeezed into a cone: what floats far away is seen at its rim.
TEST(RefractedImage, OfFarThingsOnTheLevelIsTheWindowsRim) {
  const double rim = std::asin(1.0 / kWaterIndex);
  for (const double depth_m : {0.2, 2.0, 30.0})
    for (const double metres : {3.0, 100.0, 20000.0}) {
      const double horizontal_m = metres * depth_m;
      const double height_m = apparent_height_m(Trial{0.0, depth_m, horizontal_m}.way(),
                                                static_cast<float>(kWaterIndex));
      EXPECT_NEAR(std::atan2(horizontal_m, depth_m + height_m), rim, 1e-4) << metres;
    }
}

// A floor 2 m down and 4 m away under an eye 2 m up: the straight line's angle put it 12 pixels
// off in a picture of 720 lines.
TEST(RefractedImage, OfANearFloorIsRight) {
  const double angle = angle_in_air(2.0, 2.0, 4.0);
  const double depth_m = apparent_depth_m({2.0f, 2.0f, 4.0f}, static_cast<float>(kWaterIndex));
  EXPECT_NEAR(depth_m, 4.0 / std::tan(angle) - 2.0, 1e-5);
  const double k_straight = std::cos(45 * kDegree) / std::sqrt(kWaterIndex * kWaterIndex - 0.5);
  EXPECT_GT(std::abs(2.0 * k_straight - depth_m), 0.08);
}

}  // namespace
}  // namespace swell::render
