// Whitecaps and surf of a coast's wave trains: how much there is, where, and that they are
// functions of the time alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ocean/coast/coast_map.h"
#include "ocean/coast/foam_lace.h"
#include "ocean/coast/train_square.h"
#include "ocean/open_sea/sea_state.h"
#include "ocean/water_surface.h"
#include "simd_targets.h"

namespace swell::ocean {
namespace {

constexpr std::size_t kFoamSide = kFoamMapSize, kFoamPoints = kFoamSide * kFoamSide;

// A shore along y = 0 with the sea in the north, 60 m deep from 600 m on; 3 x 3 km.
struct TrainCoast {
  explicit TrainCoast(double wind_mps, int trains = 3, double loop_s = 0.0, int threads = 2)
      : workers(threads), sea(sea_of(wind_mps, loop_s)) {
    const terrain::Grid grid{{-1500.0, -500.0}, 20.0, 151, 151};
    const terrain::HeightGrid floor =
        terrain::make_plane_beach(grid, {{{-1500.0, 0.0}, {1500.0, 0.0}}, 0.1, 60.0});
    const WaveSystem wind = make_wind_sea(wind_mps, 0.0, 9.81);
    coast = make_coast_sea(floor, wind, trains, 1, PhaseMethod::kEikonal, false, workers);
    if (loop_s > 0.0)
      for (double& period_s : coast.trains.period_s)
        period_s = 1.0 / looping_frequency(1.0 / period_s, loop_s);
    whitecaps = make_whitecaps(sea, &coast, workers);
  }
  static SeaDescription sea_of(double wind_mps, double loop_s) {
    SeaDescription description;
    description.wind_speed_mps = wind_mps;
    description.resolution = 64;
    description.loop_s = loop_s;
    return description;
  }
  WhitecapFrame at(double t_s) {
    WhitecapFrame frame;
    advance_whitecaps(whitecaps, t_s, frame, workers);
    return frame;
  }
  glm::dvec2 point(std::size_t k) const {
    const TrainSquare& trains = *whitecaps.trains;
    return trains.min_world +
           glm::dvec2(k % kFoamSide, k / kFoamSide) * (trains.size_m / kFoamMapSize);
  }
  // Heights of the trains at the map's points.
  std::vector<float> heights(double t_s) const {
    std::vector<glm::dvec2> p;
    for (std::size_t k = 0; k < kFoamPoints; ++k) p.push_back(point(k));
    std::vector<float> z(kFoamPoints), share(kFoamPoints);
    sample_coast(coast, t_s, p, z, share);
    return z;
  }
  Workers workers;
  Sea sea;
  CoastSea coast;
  Whitecaps whitecaps;
};

// ---- How much

// OPT-16 allows 35 %. What is asked is the foam of trains and of the short waves on them.
TEST(TrainWhitecaps, CoverWhatTheWindSays) {
  for (const double wind : {10.0, 15.0, 22.0})
    for (const int trains : {1, 3, 5}) {
      TrainCoast coast(wind, trains);
      WaterParts parts;
      parts.sea = &coast.sea;
      parts.coast = &coast.coast;
      std::vector<glm::dvec2> p;
      for (std::size_t k = 0; k < kFoamPoints; k += 7)
        if (coast.whitecaps.trains->part[k] > 0.999f) p.push_back(coast.point(k));
      ASSERT_GT(p.size(), 1000u);
      std::vector<float> white(p.size());
      WhitecapFrame frame;
      SeaFrame sea;
      double sum = 0.0;
      int count = 0;
      for (double t_s = 200.0; t_s < 230.0; t_s += 1.5) {
        advance_whitecaps(coast.whitecaps, t_s, frame, coast.workers);
        advance(coast.sea, t_s, sea, coast.workers);
        WaterSurface(parts, sea).foam(p, frame, white);
        for (const float x : white) sum += static_cast<double>(x);
        count += static_cast<int>(p.size());
      }
      EXPECT_NEAR(sum / count / whitecap_cover(wind), 1.0, 0.35) << wind << " " << trains;
    }
}

TEST(TrainWhitecaps, AreNoneInCalmWind) {
  for (const double wind : {0.0, 2.0, 3.7}) {
    TrainCoast coast(wind);
    EXPECT_FALSE(coast.whitecaps.trains) << wind;
    EXPECT_TRUE(coast.at(5.0).trains_after.empty()) << wind;
  }
  TrainCoast windy(6.0);
  EXPECT_TRUE(windy.whitecaps.trains);
}

// ---- Where

// Standard deviations of the trains' height where foam is born.
TEST(TrainWhitecaps, AreBornOnHighCrestsAndRunWithThem) {
  for (const int trains : {1, 3}) {
    TrainCoast coast(12.0, trains);
    for (const double t_s : {40.0, 41.0, 43.0}) {
      const WhitecapFrame earlier = coast.at(t_s - coast.whitecaps.step_s);
      const WhitecapFrame frame = coast.at(t_s);
      const std::vector<float> z = coast.heights(t_s + 0.25), later = coast.heights(t_s + 0.5);
      double squares = 0.0, all = 0.0, height = 0.0, rise = 0.0, born = 0.0;
      for (std::size_t k = 0; k < kFoamPoints; ++k) {
        if (coast.whitecaps.trains->part[k] < 0.999f) continue;
        const auto height_m = static_cast<double>(z[k]);
        squares += height_m * height_m;
        all += 1.0;
        if (frame.trains_codes[k] < earlier.trains_codes[k] + 25) continue;
        height += height_m;
        rise += static_cast<double>(later[k] - z[k]);
        born += 1.0;
      }
      ASSERT_GT(born, 50.0) << t_s;
      EXPECT_GT(height / born / std::sqrt(squares / all), 0.6) << trains << " " << t_s;
      EXPECT_GT(rise / born, 0.0) << trains << " " << t_s;  // before the crest, not behind it
    }
  }
}

// A point's foam is its square of metres: alone it would be seen as one.
TEST(TrainWhitecaps, AreTheMeanOfThePointsAround) {
  TrainCoast coast(15.0);
  const WhitecapFrame frame = coast.at(50.0);
  int white = 0;
  for (std::size_t y = 1; y + 1 < kFoamSide; ++y)
    for (std::size_t x = 1; x + 1 < kFoamSide; ++x) {
      const std::size_t k = y * kFoamSide + x;
      float expected = 0.0f;
      for (const int dy : {-1, 0, 1})
        for (const int dx : {-1, 0, 1})
          expected += static_cast<float>((2 - std::abs(dx)) * (2 - std::abs(dy))) / 16.0f *
                      foam_of_code(frame.trains_codes[k + dy * kFoamSide + dx]);
      ASSERT_NEAR(foam_of_trains(frame.trains_after[k]), expected, 1e-5) << x << ' ' << y;
      white += expected > 0.1f;
    }
  EXPECT_GT(white, 100);
}

// Along the crests of one train foam comes and goes: no line is white all along.
TEST(TrainWhitecaps, AreNoStripes) {
  TrainCoast coast(22.0, 1);
  const WhitecapFrame frame = coast.at(50.0);
  int on_crest = 0, white = 0;
  for (std::size_t k = 0; k < kFoamPoints; ++k) {
    if (coast.whitecaps.trains->part[k] < 0.999f) continue;
    const double cycles =
        coast.whitecaps.trains->phase[k] / 65536.0 - 50.0 / coast.coast.trains.period_s[0];
    const double u = cycles - std::floor(cycles);
    if (u > 0.1 && u < 0.9) continue;
    ++on_crest;
    white += foam_of_trains(frame.trains_before[k]) > 0.15f;
  }
  ASSERT_GT(on_crest, 500);
  EXPECT_GT(white, 0.15 * on_crest);
  EXPECT_LT(white, 0.7 * on_crest);
}

TEST(TrainWhitecaps, MakeRoomForSurfInShallowWaterAndAreNotOnLand) {
  TrainCoast coast(10.0);
  const TrainSquare& trains = *coast.whitecaps.trains;
  float before = 0.0f;
  for (std::size_t row = 0; row < kFoamSide; ++row) {
    const std::size_t k = row * kFoamSide + kFoamSide / 2;
    const glm::dvec2 p = coast.point(k);
    if (p.y < -100.0 || p.y > 500.0) continue;  // the trains' share falls near the rim
    if (p.y <= 0.0) {
      EXPECT_EQ(trains.part[k], 0.0f) << p.y;
    }
    float share = 0.0f;
    sample_coast_share(coast.coast, {&p, 1}, {&share, 1});
    const float ceded = 1.0f - spectrum_weight(share);
    EXPECT_NEAR(trains.part[k], ceded - (1.0f - trains.short_part[k]), 1e-6) << p.y;
    EXPECT_GE(trains.part[k], before) << p.y;
    before = trains.part[k];
  }
  EXPECT_EQ(before, 1.0f);
}

// Surf does not drain there from one crest to the next.
TEST(TrainWhitecaps, AreManyInTheSurfOfAGaleAlone) {
  for (const double wind : {10.0, 22.0}) {
    TrainCoast coast(wind);
    float most = 0.0f;
    for (std::size_t k = 0; k < kFoamPoints; ++k) {
      const float part = coast.whitecaps.trains->part[k];
      most = std::max(most, part);
      // Waves of 22 m/s are 12 m high out at sea; the floor falls by a tenth.
      if (coast.point(k).y > 60.0) {
        EXPECT_LE(part, 1.0f) << coast.point(k).y;
      }
    }
    EXPECT_GT(most, wind > 20.0 ? 2.0f : 0.99f);
    EXPECT_LE(most, wind > 20.0 ? 4.0f : 1.0f);
  }
}

// ---- When

bool same_foam(const WhitecapFrame& a, const WhitecapFrame& b) {
  return a.past == b.past && a.trains_before == b.trains_before && a.trains_after == b.trains_after;
}

TEST(TrainWhitecaps, KnowTheTimeAndNothingElse) {
  TrainCoast coast(15.0), other(9.0);
  WhitecapFrame warm;
  for (const double t_s : {5.0, 5.2, 5.3, 5.6, 100.0, 99.8, -3.1, 1e7}) {
    advance_whitecaps(coast.whitecaps, t_s, warm, coast.workers);
    EXPECT_TRUE(same_foam(warm, coast.at(t_s))) << t_s;
  }
  advance_whitecaps(other.whitecaps, 1e7, warm, other.workers);
  EXPECT_FALSE(same_foam(warm, coast.at(1e7)));
  advance_whitecaps(coast.whitecaps, 1e7, warm, coast.workers);
  EXPECT_TRUE(same_foam(warm, coast.at(1e7)));
  const Whitecaps open = make_whitecaps(coast.sea, coast.workers);
  advance_whitecaps(open, 1e7, warm, coast.workers);
  EXPECT_TRUE(warm.trains_after.empty());
}

TEST(TrainWhitecaps, AreTheSameBitsOnEverySimdTargetAndThreadCount) {
  const WhitecapFrame expected = TrainCoast(15.0).at(7.3);
  for_each_simd_target([&] {
    for (const int threads : {1, 5})
      EXPECT_TRUE(same_foam(TrainCoast(15.0, 3, 0.0, threads).at(7.3), expected)) << threads;
  });
}

TEST(TrainWhitecaps, LoopWithTheSea) {
  TrainCoast coast(15.0, 3, 20.0);
  const WhitecapFrame first = coast.at(0.125);
  for (const double loops : {1.0, -1.0, 7.0})
    EXPECT_TRUE(same_foam(coast.at(0.125 + loops * 20.0), first)) << loops;
}

// ---- Surf, as it is asked for

TEST(SurfFoam, IsWhatTheMapsHave) {
  TrainCoast coast(12.0, 4);
  constexpr int kMapSide = 64;
  const CoastMap map = make_coast_map(coast.coast, kMapSide, coast.workers);
  std::vector<float> x(kMapSide * kMapSide), y(kMapSide * kMapSide), baked(kMapSide * kMapSide),
      asked(kMapSide * kMapSide);
  bake_coast(map, 6.0, x, y, baked, coast.workers);
  std::vector<glm::dvec2> p;
  for (int k = 0; k < kMapSide * kMapSide; ++k)
    p.push_back(glm::dvec2(-1500.0, -500.0) +
                glm::dvec2(k % kMapSide, k / kMapSide) * (3000.0 / kMapSide));
  sample_surf_foam(coast.coast, 6.0, p, asked);
  int some = 0;
  for (int k = 0; k < kMapSide * kMapSide; ++k) {
    ASSERT_NEAR(asked[k], baked[k], 2e-3) << k;
    some += baked[k] > 0.1f;
  }
  EXPECT_GT(some, 5);
}

// How far from the shore there is foam at any time.
double surf_reach_m(const CoastSea& coast) {
  std::vector<glm::dvec2> p;
  for (int y = 1; y < 400; ++y) p.emplace_back(0.0, 0.5 * y);
  std::vector<float> foam(p.size());
  double reach_m = 0.0;
  for (double t_s = 0.0; t_s < 60.0; t_s += 1.0) {
    sample_surf_foam(coast, t_s, p, foam);
    for (std::size_t k = 0; k < p.size(); ++k)
      if (foam[k] > 0.05f) reach_m = std::max(reach_m, p[k].y);
  }
  return reach_m;
}

// On a plane floor the band is as wide as the depth is in which foam begins.
TEST(SurfFoam, HasABandAsWideAsAskedFor) {
  TrainCoast coast(12.0);
  const double one_m = surf_reach_m(coast.coast);
  ASSERT_GT(one_m, 20.0);
  for (const double width : {0.5, 2.0}) {
    coast.coast.surf_width = width;
    EXPECT_NEAR(surf_reach_m(coast.coast) / one_m, width, 0.15 * width);
  }
}

TEST(SurfFoam, CoversTheMeanOverItsLacesThresholds) {
  for (const float foam : {0.0f, 0.1f, 0.23f, 0.5f, 0.77f, 0.9f, 1.0f}) {
    double sum = 0.0;
    constexpr int kThresholds = 10000;
    for (int n = 0; n < kThresholds; ++n) {
      const double over = (1.0 + static_cast<double>(kFoamRim)) * static_cast<double>(foam) -
                          (n + 0.5) / kThresholds;
      sum += std::clamp(over / static_cast<double>(kFoamRim), 0.0, 1.0) / kThresholds;
    }
    EXPECT_NEAR(mean_lace_cover(foam), sum, 1e-3) << foam;
  }
}

}  // namespace
}  // namespace swell::ocean
