// Rays over heights, against marching in small steps and against closed forms.
#include "terrain/height_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "constants.h"
#include "math/random.h"

namespace swell::terrain {
namespace {

// Rays of any number, with spans over them.
struct Rays {
  std::vector<float> x, y, z, z_t, z_tt, begin, end;

  void add(glm::dvec3 direction, double height_m, double sag = 0.0, double from = 0.0,
           double to = 1e9) {
    x.push_back(static_cast<float>(direction.x));
    y.push_back(static_cast<float>(direction.y));
    z.push_back(static_cast<float>(height_m));
    z_t.push_back(static_cast<float>(direction.z));
    z_tt.push_back(static_cast<float>(sag));
    begin.push_back(static_cast<float>(from));
    end.push_back(static_cast<float>(to));
  }
  HeightRays spans() const { return {x, y, z, z_t, z_tt, begin, end}; }
};

std::vector<float> cast(const HeightPyramid& pyramid, glm::dvec2 from, const Rays& rays,
                        float detail = 0.0f) {
  std::vector<float> t(rays.x.size());
  cast_rays(pyramid, from, detail, rays.spans(), t);
  return t;
}

// Heights of several octaves, each half as high as the one before.
HeightGrid rough_map(int posts, double spacing_m, std::uint64_t seed) {
  HeightGrid map{{{-3.0, 7.0}, spacing_m, posts, posts}};
  map.height_m.assign(map.grid.size(), 0.0f);
  for (int octave = 0, cells = 2; cells < posts; ++octave, cells *= 2) {
    for (int j = 0; j < posts; ++j)
      for (int i = 0; i < posts; ++i) {
        const double u = double(i) * cells / (posts - 1), v = double(j) * cells / (posts - 1);
        const int x = std::min(int(u), cells - 1), y = std::min(int(v), cells - 1);
        const auto at = [&](int a, int b) {
          return random_uniform(seed + static_cast<std::uint64_t>(octave),
                                static_cast<std::uint64_t>(b) * 4099 + a) -
                 0.5;
        };
        const double s = u - x, t = v - y;
        const double value = (at(x, y) * (1 - s) + at(x + 1, y) * s) * (1 - t) +
                             (at(x, y + 1) * (1 - s) + at(x + 1, y + 1) * s) * t;
        map.height_m[map.grid.index(i, j)] +=
            static_cast<float>(20.0 * spacing_m * std::pow(0.57, octave) * value);
      }
  }
  return map;
}

// The heights that a pyramid holds.
HeightGrid decoded(const HeightPyramid& p) {
  HeightGrid map{p.grid};
  for (std::size_t k = 0; k < p.grid.size(); ++k)
    map.height_m.push_back(p.base_m + p.step_m * static_cast<float>(p.posts[k]));
  return map;
}

// How high ray n is over the map at t.
double clearance(const HeightGrid& map, glm::dvec2 from, const Rays& r, std::size_t n, double t) {
  const double z = r.z[n] + t * (double(r.z_t[n]) + t * double(r.z_tt[n]));
  return z - height_at(map, from + t * glm::dvec2(r.x[n], r.y[n]));
}

// Where marching with 16 steps a cell first finds ray n under the map; infinity if it does not.
double march(const HeightGrid& map, glm::dvec2 from, const Rays& r, std::size_t n) {
  const double dt = map.grid.spacing_m / 16.0;
  for (double t = r.begin[n];; t += dt) {
    const glm::dvec2 p = from + t * glm::dvec2(r.x[n], r.y[n]);
    if (!map.grid.holds(p) || t >= r.end[n]) return std::numeric_limits<double>::infinity();
    if (clearance(map, from, r, n, t) < 0.0) return t;
  }
}

// A million rays take a minute: SWELL_ALL_RAYS=1 asks for them.
std::uint64_t map_count() { return std::getenv("SWELL_ALL_RAYS") ? 223 : 4; }

// Rays from inside the map, level and steep, straight and sagging up.
TEST(HeightRays, MissNothingThatMarchingFinds) {
  Workers workers(1);
  constexpr int kRays = 1500;
  int hits = 0, missed = 0, false_hits = 0;
  for (const int posts : {33, 65, 100}) {
    for (std::uint64_t seed = 0; seed < map_count(); ++seed) {
      const double spacing_m = posts == 65 ? 1.0 : 0.37;
      const HeightPyramid pyramid =
          make_height_pyramid(rough_map(posts, spacing_m, 100 * seed), {}, workers);
      const HeightGrid map = decoded(pyramid);
      const double side_m = map.grid.size_m();
      const glm::dvec2 from =
          map.grid.min_world + side_m * glm::dvec2(0.2 + 0.15 * double(seed % 4), 0.55);
      Rays rays;
      for (std::uint64_t n = 0; n < kRays; ++n) {
        const auto random = [&](int k) { return random_uniform(seed + 7, 8 * n + k); };
        const double azimuth = 2.0 * kPiRef * random(0);
        const double dip = n % 3 == 0 ? -0.3 * random(1) : 0.04 * (random(1) - 0.5);
        rays.add({std::cos(azimuth), std::sin(azimuth), dip},
                 height_at(map, from) + 8.0 * spacing_m * random(2),
                 n % 5 == 0 ? 0.001 / spacing_m : 0.0);
      }
      const std::vector<float> t = cast(pyramid, from, rays);
      for (std::size_t n = 0; n < kRays; ++n) {
        const double expected = march(map, from, rays, n);
        hits += std::isfinite(expected);
        // A crest that the ray touches between two marks may end it before.
        missed += expected < t[n] - 1e-3 * spacing_m;
        if (std::isfinite(t[n]))
          false_hits += std::abs(clearance(map, from, rays, n, t[n])) > 2e-3 * spacing_m;
      }
    }
  }
  EXPECT_GT(hits, 6000);
  EXPECT_EQ(missed, 0);
  EXPECT_EQ(false_hits, 0);
  RecordProperty("rays", static_cast<int>(3 * map_count()) * kRays);
  RecordProperty("hits", hits);
}

// Bundles from over the map, as wide as some pixels: a third of them straight, one on a round
// earth, and one mirrored in a level, from where they meet it.
TEST(HeightRays, MeetNothingWhereTheirBeamIsFree) {
  Workers workers(1);
  constexpr std::size_t kBeams = 300, kRays = 6;
  int early = 0, hits = 0;
  double free_share = 0.0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const HeightPyramid pyramid = make_height_pyramid(rough_map(129, 0.7, seed), {}, workers);
    const HeightGrid map = decoded(pyramid);
    const glm::dvec2 from = map.grid.min_world + map.grid.size_m() * glm::dvec2(0.3, 0.4);
    std::array<std::vector<float>, 9> bounds;
    Rays rays;
    for (std::uint64_t n = 0; n < kBeams; ++n) {
      const auto random = [&](std::uint64_t k) { return random_uniform(seed + 17, 64 * n + k); };
      const double azimuth = 2.0 * kPiRef * random(0), z = height_at(map, from) + 40.0 * random(1);
      const glm::dvec3 middle(std::cos(azimuth), std::sin(azimuth), -0.7 * random(2));
      const double half = 0.02 * random(3) * random(4), sag = n % 3 == 1 ? 0.0005 : 0.0;
      const glm::dvec3 low = middle - half, high = middle + half;
      const bool mirrored = n % 3 == 2 && high.z < -0.01;
      const double level = z - 20.0 * random(5);
      const auto begin = [&](double dip) { return mirrored ? (level - z) / dip : 0.0; };
      const std::array<double, 9> values = {low.x,
                                            high.x,
                                            low.y,
                                            high.y,
                                            mirrored ? 2.0 * level - z : z,
                                            mirrored ? -high.z : low.z,
                                            sag,
                                            mirrored ? level - 1e-3 : -1e9,
                                            begin(low.z)};
      for (std::size_t k = 0; k < values.size(); ++k)
        bounds[k].push_back(static_cast<float>(values[k]));
      for (std::uint64_t k = 0; k < kRays; ++k) {
        glm::dvec3 ray = glm::mix(
            low, high, glm::dvec3(random(8 + 3 * k), random(9 + 3 * k), random(10 + 3 * k)));
        const double from_t = begin(ray.z);
        if (mirrored) ray.z = -ray.z;
        rays.add(ray, values[4], sag, from_t);
      }
    }
    std::vector<float> t_free(kBeams);
    cast_beams(pyramid, from,
               {bounds[0], bounds[1], bounds[2], bounds[3], bounds[4], bounds[5], bounds[6],
                bounds[7], bounds[8]},
               t_free);
    const std::vector<float> t = cast(pyramid, from, rays);
    for (std::size_t n = 0; n < t.size(); ++n) {
      early += t[n] < t_free[n / kRays];
      if (!std::isfinite(t[n]) || t[n] < 1.0f) continue;
      ++hits;
      free_share += t_free[n / kRays] / t[n];
    }
  }
  EXPECT_EQ(early, 0);
  EXPECT_GT(hits, 2000);
  EXPECT_GT(free_share, 0.5 * hits);  // and most of the way is
}

// HFR-02: where blocks of kBlock_px pass for cells, the land ends within a pixel of where it ends
// with all posts.
TEST(HeightRays, StopAtBlocksWithoutMovingSilhouettesByMoreThanAPixel) {
  constexpr int kColumns = 200, kRows = 120;
  Workers workers(2);
  HeightGrid steep = rough_map(1025, 1.0, 5);
  for (float& height_m : steep.height_m) height_m *= 6.0f;
  const HeightPyramid pyramid = make_height_pyramid(steep, {}, workers);
  const HeightGrid map = decoded(pyramid);
  int silhouettes = 0, moved = 0, moved_by_large_blocks = 0, differ = 0;
  for (const double pitch_deg : {2.0, 10.0}) {
    const glm::dvec2 from = map.grid.min_world + map.grid.size_m() * glm::dvec2(0.05, 0.5);
    const double pixel = 0.005, pitch = pitch_deg * kPiRef / 180.0;
    Rays rays;
    for (int j = 0; j < kRows; ++j)
      for (int i = 0; i < kColumns; ++i) {
        const double up = (0.5 * kRows - j) * pixel;
        rays.add({std::cos(pitch) + up * std::sin(pitch), (i - 0.5 * kColumns) * pixel,
                  up * std::cos(pitch) - std::sin(pitch)},
                 height_at(map, from) + 20.0, 0.0, 1.0);
      }
    const auto hits = [&](float block_px) {
      return cast(pyramid, from, rays, block_px * static_cast<float>(pixel));
    };
    const std::vector<float> exact = hits(0.0f), coarse = hits(kBlock_px), large = hits(32.0f);
    const auto first_row = [&](const std::vector<float>& t, int i) {
      int j = 0;
      while (j < kRows && std::isinf(t[static_cast<std::size_t>(j * kColumns + i)])) ++j;
      return j;
    };
    for (int i = 0; i < kColumns; ++i) {
      const int row = first_row(exact, i);
      silhouettes += row > 0 && row < kRows;
      moved += std::abs(first_row(coarse, i) - row) > 1;
      moved_by_large_blocks += std::abs(first_row(large, i) - row) > 1;
    }
    for (std::size_t k = 0; k < exact.size(); ++k) differ += exact[k] != coarse[k];
  }
  EXPECT_GT(silhouettes, 300);
  EXPECT_GT(differ, 5000);  // blocks there were
  EXPECT_EQ(moved, 0);
  EXPECT_GT(moved_by_large_blocks, 50);
}

// HFR-03: against two triangles in each cell, cut along either diagonal. They differ by a quarter
// of the cell's twist at most, and by just that in its middle.
TEST(HeightRays, LieWithinAQuarterOfTheTwistOfTriangles) {
  Workers workers(1);
  const HeightPyramid pyramid = make_height_pyramid(rough_map(65, 1.0, 11), {}, workers);
  const HeightGrid map = decoded(pyramid);
  // Above p: how high the triangles are, and the twist of their cell.
  struct Above {
    double height_m, twist_m;
  };
  const auto triangles_at = [&](glm::dvec2 p, bool rising) {
    const glm::dvec2 at = (p - map.grid.min_world) / map.grid.spacing_m;
    const int i = std::min(int(at.x), 63), j = std::min(int(at.y), 63);
    const auto post = [&](int a, int b) { return double(map.height_m[map.grid.index(a, b)]); };
    const double h00 = post(i, j), h10 = post(i + 1, j), h01 = post(i, j + 1),
                 h11 = post(i + 1, j + 1);
    const double x = at.x - i, y = at.y - j;
    const double height_m = rising        ? x > y ? h00 + (h10 - h00) * x + (h11 - h10) * y
                                                  : h00 + (h11 - h01) * x + (h01 - h00) * y
                            : x + y < 1.0 ? h00 + (h10 - h00) * x + (h01 - h00) * y
                                          : h11 + (h01 - h11) * (1 - x) + (h10 - h11) * (1 - y);
    return Above{height_m, std::abs(h00 - h10 - h01 + h11)};
  };
  const glm::dvec2 from = map.grid.min_world + 32.25;
  Rays rays;
  for (std::uint64_t n = 0; n < 2000; ++n) {
    const double azimuth = 2.0 * kPiRef * random_uniform(3, 2 * n);
    rays.add({std::cos(azimuth), std::sin(azimuth), -0.1 - 2.0 * random_uniform(3, 2 * n + 1)},
             height_at(map, from) + 15.0);
  }
  const std::vector<float> t = cast(pyramid, from, rays);
  int hits = 0;
  for (std::size_t n = 0; n < t.size(); ++n) {
    if (!std::isfinite(t[n])) continue;
    ++hits;
    const glm::dvec2 p = from + double(t[n]) * glm::dvec2(rays.x[n], rays.y[n]);
    const double z = double(rays.z[n]) + double(t[n]) * double(rays.z_t[n]);
    for (const bool rising : {false, true}) {
      const Above above = triangles_at(p, rising);
      EXPECT_LE(std::abs(z - above.height_m), 0.25 * above.twist_m + 2e-3) << n;
    }
  }
  EXPECT_GT(hits, 1500);
  // Straight down onto the middles of cells.
  for (int n = 0; n < 100; ++n) {
    const glm::dvec2 p = map.grid.min_world + glm::dvec2(n % 10 * 6 + 0.5, n / 10 * 6 + 0.5);
    Rays down;
    down.add({0.0, 0.0, -1.0}, 100.0);
    const double z = 100.0 - double(cast(pyramid, p, down)[0]);
    const Above above = triangles_at(p, true);
    EXPECT_NEAR(std::abs(z - above.height_m), 0.25 * above.twist_m, 2e-3) << n;
  }
}

TEST(HeightPyramid, HasTheSlopesOfItsSurface) {
  Workers workers(1);
  const HeightPyramid pyramid = make_height_pyramid(rough_map(33, 0.5, 2), {}, workers);
  const HeightGrid map = decoded(pyramid);
  for (std::uint64_t n = 0; n < 200; ++n) {
    const glm::dvec2 p =
        map.grid.min_world +
        map.grid.size_m() * glm::dvec2(random_uniform(5, 2 * n), random_uniform(5, 2 * n + 1));
    const glm::dvec2 slope = slope_at(map, p);
    const glm::dvec3 expected = glm::normalize(glm::dvec3(-slope, 1.0));
    EXPECT_LT(glm::distance(expected, glm::dvec3(normal_at(pyramid, p))), 1e-3) << n;
  }
}

TEST(HeightRays, MeetAPlaneWhereItIs) {
  Workers workers(1);
  HeightGrid plane{{{0.0, 0.0}, 2.0, 17, 17}};
  for (int j = 0; j < 17; ++j)
    for (int i = 0; i < 17; ++i) plane.height_m.push_back(0.5f * static_cast<float>(i));
  const HeightPyramid pyramid = make_height_pyramid(plane, {}, workers);
  Rays rays;
  rays.add({0.0, 0.0, -1.0}, 10.0);                 // straight down at x = 9: z = 2.25
  rays.add({1.0, 0.0, -0.5}, 10.0);                 // 10 - t / 2 = (9 + t) / 4
  rays.add({-1.0, 0.0, 0.0}, 10.0);                 // level, over the lower half
  rays.add({0.0, 0.0, -1.0}, 10.0, 0.0, 0.0, 7.0);  // ends before it
  rays.add({0.0, 0.0, -1.0}, 1.0);                  // begins below
  const std::vector<float> t = cast(pyramid, {9.0, 5.0}, rays);
  EXPECT_NEAR(t[0], 7.75, 1e-3);
  EXPECT_NEAR(t[1], 31.0 / 3.0, 1e-3);
  EXPECT_EQ(t[2], std::numeric_limits<float>::infinity());
  EXPECT_EQ(t[3], std::numeric_limits<float>::infinity());
  EXPECT_EQ(t[4], 0.0f);
}

// From far outside and high above the map.
TEST(HeightRays, FindTheMapFromAfar) {
  Workers workers(1);
  const HeightPyramid pyramid = make_height_pyramid(rough_map(129, 4.0, 3), {}, workers);
  const HeightGrid map = decoded(pyramid);
  const glm::dvec2 middle = map.grid.min_world + 0.5 * map.grid.size_m();
  const glm::dvec2 from = middle + glm::dvec2(-30000.0, 21000.0);
  Rays rays;
  for (int n = 0; n < 64; ++n) {
    const glm::dvec2 to = middle + glm::dvec2(5.0 * (n % 8) - 20.0, 5.0 * (n / 8.0) - 20.0);
    const double height_m = 4000.0 + height_at(map, to);
    rays.add({to.x - from.x, to.y - from.y, -4000.0}, height_m);
  }
  const std::vector<float> t = cast(pyramid, from, rays);
  for (std::size_t n = 0; n < t.size(); ++n) EXPECT_LT(t[n], 1.0f + 1e-4f) << n;
}

TEST(HeightRays, PassThroughAHole) {
  Workers workers(1);
  HeightGrid flat{{{0.0, 0.0}, 1.0, 65, 65}};
  flat.height_m.assign(flat.grid.size(), 1.0f);
  flat.height_m[0] = 0.0f;
  const HeightPyramid pyramid = make_height_pyramid(flat, {16, 48}, workers);
  Rays rays;
  rays.add({0.0, 0.0, -1.0}, 10.0);
  EXPECT_EQ(cast(pyramid, {32.5, 32.5}, rays)[0], std::numeric_limits<float>::infinity());
  EXPECT_NEAR(cast(pyramid, {8.5, 32.5}, rays)[0], 9.0f, 1e-3f);
  EXPECT_NEAR(cast(pyramid, {48.5, 32.5}, rays)[0], 9.0f, 1e-3f);
}

// Blocks as small as a pixel instead of cells: hits are off by a few of them, but for rays that
// pass by a crest as closely.
TEST(HeightRays, StopAtThePixelsSize) {
  Workers workers(1);
  const HeightPyramid pyramid = make_height_pyramid(rough_map(257, 1.0, 5), {}, workers);
  const HeightGrid map = decoded(pyramid);
  const glm::dvec2 from = map.grid.min_world + glm::dvec2(2.0, 128.0);
  constexpr float kDetail = 0.02f;
  Rays rays;
  for (int n = 0; n < 400; ++n)
    rays.add({1.0, 0.002 * (n % 20 - 10), -0.10 - 0.012 * (n / 20)}, height_at(map, from) + 30.0);
  const std::vector<float> exact = cast(pyramid, from, rays),
                           stopped = cast(pyramid, from, rays, kDetail);
  int far_off = 0, lost = 0;  // at crests
  for (std::size_t n = 0; n < exact.size(); ++n) {
    if (!std::isfinite(exact[n])) continue;
    lost += !std::isfinite(stopped[n]);
    far_off += std::isfinite(stopped[n]) &&
               std::abs(exact[n] - stopped[n]) > 8.0f * std::max(1.0f, kDetail * exact[n]);
  }
  EXPECT_LT(far_off, 12);
  EXPECT_LT(lost, 4);
}

TEST(HeightPyramid, HasTheHighestPostOfEachBlock) {
  Workers workers(2);
  const HeightPyramid p = make_height_pyramid(rough_map(41, 1.0, 9), {}, workers);
  EXPECT_EQ(p.side, 64);
  for (int level = 1; level <= p.levels; ++level) {
    const int blocks = p.side >> level;
    for (int j = 0; j < blocks; ++j)
      for (int i = 0; i < blocks; ++i) {
        std::uint16_t highest = 0;
        const int x0 = i << level, y0 = j << level, size = 1 << level;
        if (x0 < 40 && y0 < 40)
          for (int y = y0; y <= std::min(y0 + size, 40); ++y)
            for (int x = x0; x <= std::min(x0 + size, 40); ++x)
              highest = std::max(highest, p.posts[p.grid.index(x, y)]);
        const std::uint16_t code = p.maxima[static_cast<std::size_t>(blocks) * blocks +
                                            static_cast<std::size_t>(j) * blocks + i];
        EXPECT_GE(code, highest) << level << " " << i << " " << j;
        EXPECT_LE(code, highest + 1) << level << " " << i << " " << j;
      }
  }
}

// To a step of its codes; and no point of a rectangle is higher than its bound, which is that of a
// block of the pyramid: the whole map's at most.
TEST(HeightPyramid, KnowsItsHeightsAndTheirBounds) {
  const HeightGrid map = rough_map(50, 2.0, 9);
  Workers workers(2);
  const HeightPyramid p = make_height_pyramid(map, {}, workers);
  const double size_m = map.grid.size_m();
  const float highest = *std::ranges::max_element(map.height_m);
  int tight = 0;
  for (std::uint64_t n = 0; n < 2000; ++n) {
    const auto roll = [&](std::uint64_t k) { return random_uniform(11, 8 * n + k); };
    const glm::dvec2 low = map.grid.min_world + size_m * glm::dvec2(roll(0), roll(1));
    const double most_m = roll(2) * roll(2) * size_m;
    const glm::dvec2 high = low + most_m * glm::dvec2(roll(3), roll(4));
    const float bound = highest_over(p, low, high);
    EXPECT_LE(bound, highest + 2.0f * p.step_m);
    tight += bound < highest - 1.0f;
    for (const double s : {0.0, 0.3, 0.7, 1.0})
      for (const double t : {0.0, 0.4, 1.0}) {
        const glm::dvec2 at = low + glm::dvec2(s, t) * (high - low);
        const double height = height_at(map, at);
        EXPECT_NEAR(height_at(p, at), height, static_cast<double>(p.step_m));
        EXPECT_LE(height_at(p, at), static_cast<double>(bound) + 1e-5);
      }
  }
  EXPECT_GT(tight, 1000);
}

// A hill on one side, and noise on the other.
TEST(HeightPyramid, MarksBlocksThatAreAlmostCells) {
  HeightGrid map = rough_map(65, 1.0, 4);
  for (int j = 0; j < 65; ++j)
    for (int i = 0; i < 32; ++i)
      map.height_m[map.grid.index(i, j)] =
          static_cast<float>(6.0 * std::sin(0.1 * i) * std::cos(0.08 * j));
  Workers workers(2);
  const HeightPyramid p = make_height_pyramid(map, {}, workers);
  int smooth = 0, rough = 0;
  for (int level = 1; level <= p.levels; ++level) {
    const int blocks = p.side >> level, size = 1 << level;
    for (int j = 0; j < blocks; ++j)
      for (int i = 0; i < blocks; ++i) {
        const std::uint16_t code = p.maxima[static_cast<std::size_t>(blocks) * blocks +
                                            static_cast<std::size_t>(j) * blocks + i];
        if (code % 2 != 0) {
          ++rough;
          continue;
        }
        ++smooth;
        const auto height = [&](int x, int y) {
          return p.base_m + p.step_m * p.posts[p.grid.index(i * size + x, j * size + y)];
        };
        for (int y = 0; y <= size; ++y)
          for (int x = 0; x <= size; ++x) {
            const float u = float(x) / float(size), v = float(y) / float(size);
            const float cell = std::lerp(std::lerp(height(0, 0), height(size, 0), u),
                                         std::lerp(height(0, size), height(size, size), u), v);
            EXPECT_NEAR(height(x, y), cell, HeightPyramid::kSmooth * size + 1e-4);
          }
      }
  }
  EXPECT_GT(smooth, 200);
  EXPECT_GT(rough, 500);
}

}  // namespace
}  // namespace swell::terrain
