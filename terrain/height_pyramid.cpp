#include "terrain/height_pyramid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "math/check.h"
#include "math/large_array.h"

namespace swell::terrain {
namespace {

constexpr int kMostPosts = 16385;

std::size_t block(int blocks, int i, int j) {
  return (static_cast<std::size_t>(blocks) + static_cast<std::size_t>(j)) *
             static_cast<std::size_t>(blocks) +
         static_cast<std::size_t>(i);
}

void for_rows(int rows, Workers& workers, const std::function<void(int)>& body) {
  workers.for_each(static_cast<std::size_t>(rows), [&](std::size_t j, int) { body(int(j)); });
}

// How far the posts between the corners of a block of `step` cells lie off a cell between these
// [codes].
float off_cell(const HeightPyramid& p, int i, int j, int step) {
  const int half = step / 2;
  const auto post = [&](int x, int y) {
    return static_cast<float>(p.posts[p.grid.index(i * step + x * half, j * step + y * half)]);
  };
  const float a = post(0, 0), b = post(2, 0), c = post(0, 2), d = post(2, 2);
  float off = std::abs(post(1, 1) - 0.25f * (a + b + c + d));
  off = std::max(off, std::abs(post(1, 0) - 0.5f * (a + b)));
  off = std::max(off, std::abs(post(1, 2) - 0.5f * (c + d)));
  off = std::max(off, std::abs(post(0, 1) - 0.5f * (a + c)));
  return std::max(off, std::abs(post(2, 1) - 0.5f * (b + d)));
}

// Roughness tells, of the blocks of one level, how far the surface is off a cell at most [codes].
class Roughness {
 public:
  explicit Roughness(int blocks) : blocks_(blocks) {
    resize_large(codes_, static_cast<std::size_t>(blocks) * blocks);
  }
  std::uint16_t& at(int i, int j) {
    return codes_[static_cast<std::size_t>(j) * blocks_ + static_cast<std::size_t>(i)];
  }
  // Returns the largest value of the four blocks that make block (i, j) of the next level.
  float of_parts(int i, int j) {
    const auto below = [&](int y) { return std::max(at(2 * i, y), at(2 * i + 1, y)); };
    return std::max(below(2 * j), below(2 * j + 1));
  }

 private:
  int blocks_;
  std::vector<std::uint16_t> codes_;
};

constexpr float kRough = 65535.0f;

// Notes a block whose posts are no higher than `highest`, and whose surface is off a cell by `off`.
void set_block(int blocks, int i, int j, std::uint16_t highest, float off, HeightPyramid& p,
               Roughness& roughness) {
  roughness.at(i, j) = static_cast<std::uint16_t>(std::min(std::ceil(off), kRough));
  const double width_m = p.side / blocks * p.grid.spacing_m;
  const bool smooth = off < kRough && highest < 0xffff &&
                      double(off) * p.step_m <= HeightPyramid::kSmooth * width_m;
  p.maxima[block(blocks, i, j)] =
      smooth ? static_cast<std::uint16_t>((highest + 1) & ~1) : std::uint16_t(highest | 1);
}

// Blocks of two by two cells: nine posts.
void fill_first_level(HeightPyramid& p, Roughness& roughness, Workers& workers) {
  const int blocks = p.side / 2, last = p.grid.samples_x - 1;
  for_rows(blocks, workers, [&](int j) {
    for (int i = 0; i < blocks; ++i) {
      roughness.at(i, j) = static_cast<std::uint16_t>(kRough);
      if (2 * i >= last || 2 * j >= last) continue;  // 0: beyond the posts
      const auto in_hole = [&](int cell) { return cell >= p.hole_begin && cell + 2 <= p.hole_end; };
      if (in_hole(2 * i) && in_hole(2 * j)) continue;
      const auto by_hole = [&](int cell) { return cell + 2 > p.hole_begin && cell < p.hole_end; };
      std::uint16_t highest = 0;
      for (int y = 2 * j; y <= std::min(2 * j + 2, last); ++y)
        for (int x = 2 * i; x <= std::min(2 * i + 2, last); ++x)
          highest = std::max(highest, p.posts[p.grid.index(x, y)]);
      const bool whole =
          2 * i + 2 <= last && 2 * j + 2 <= last && !(by_hole(2 * i) && by_hole(2 * j));
      set_block(blocks, i, j, highest, whole ? off_cell(p, i, j, 2) : kRough, p, roughness);
    }
  });
}

// What a block is off a cell: its parts off theirs, and these off it.
Roughness fill_level(int blocks, HeightPyramid& p, Roughness parts, Workers& workers) {
  Roughness roughness(blocks);
  const int fine = 2 * blocks, step = p.side / blocks;
  for_rows(blocks, workers, [&](int j) {
    for (int i = 0; i < blocks; ++i) {
      const auto part = [&](int x, int y) { return p.maxima[block(fine, 2 * i + x, 2 * j + y)]; };
      const std::uint16_t highest =
          std::max(std::max(part(0, 0), part(1, 0)), std::max(part(0, 1), part(1, 1)));
      float off = parts.of_parts(i, j);
      if (off < kRough) off += off_cell(p, i, j, step);
      if (highest > 0)
        set_block(blocks, i, j, highest, off, p, roughness);
      else
        roughness.at(i, j) = static_cast<std::uint16_t>(kRough);
    }
  });
  return roughness;
}

// The posts of blocks of level 1 and up, behind the given ones.
void add_coarse_posts(HeightPyramid& p, Workers& workers) {
  const auto squared = [](int n) { return static_cast<std::size_t>(n) * n; };
  std::size_t count = p.grid.size();
  for (int blocks = 1; blocks < p.side; blocks *= 2) count += squared(blocks + 1);
  std::vector<std::uint16_t> posts;
  resize_large(posts, count + 1);
  std::ranges::copy(p.posts, posts.begin());
  p.posts = std::move(posts);
  std::size_t level_begin = p.grid.size();
  const int last = p.grid.samples_x - 1;
  for (int blocks = 1; blocks < p.side; blocks *= 2) {
    const int step = p.side / blocks;
    for_rows(blocks + 1, workers, [&](int j) {
      std::uint16_t* const row =
          p.posts.data() + level_begin + static_cast<std::size_t>(j) * (blocks + 1);
      for (int i = 0; i <= blocks; ++i)
        row[i] = p.posts[p.grid.index(std::min(i * step, last), std::min(j * step, last))];
    });
    level_begin += squared(blocks + 1);
  }
}

// A point in cells, the nearest of the grid.
glm::dvec2 on_grid(const HeightPyramid& p, glm::dvec2 p_world) {
  return glm::clamp((p_world - p.grid.min_world) / p.grid.spacing_m, 0.0,
                    static_cast<double>(p.grid.samples_x - 1));
}

}  // namespace

HeightPyramid make_height_pyramid(const Grid& grid, float base_m, float step_m,
                                  std::vector<std::uint16_t> posts, CellSquare hole,
                                  Workers& workers) {
  SWELL_CHECK(grid.samples_x == grid.samples_y && grid.samples_x >= 2 &&
                  grid.samples_x <= kMostPosts && posts.size() == grid.size(),
              "samples={}x{} posts={}", grid.samples_x, grid.samples_y, posts.size());
  HeightPyramid p{grid, base_m, step_m};
  p.side = std::max(2, static_cast<int>(std::bit_ceil(static_cast<unsigned>(grid.samples_x - 1))));
  p.levels = std::countr_zero(static_cast<unsigned>(p.side));
  p.hole_begin = hole.begin;
  p.hole_end = hole.end;
  p.posts = std::move(posts);
  add_coarse_posts(p, workers);
  const auto half = static_cast<std::size_t>(p.side / 2);
  resize_large(p.maxima, 2 * half * half + 1);
  Roughness roughness(p.side / 2);
  fill_first_level(p, roughness, workers);
  for (int blocks = p.side / 4; blocks >= 1; blocks /= 2)
    roughness = fill_level(blocks, p, std::move(roughness), workers);
  return p;
}

HeightPyramid make_height_pyramid(const HeightGrid& heights, CellSquare hole, Workers& workers) {
  const auto [lowest, highest] = std::ranges::minmax(heights.height_m);
  const float step_m = std::max((highest - lowest) / 65535.0f, 1e-6f);
  std::vector<std::uint16_t> posts(heights.height_m.size());
  for (std::size_t k = 0; k < posts.size(); ++k)
    posts[k] = static_cast<std::uint16_t>(
        std::clamp((heights.height_m[k] - lowest) / step_m + 0.5f, 0.0f, 65535.0f));
  return make_height_pyramid(heights.grid, lowest, step_m, std::move(posts), hole, workers);
}

double height_at(const HeightPyramid& p, glm::dvec2 p_world) {
  const glm::dvec2 at = on_grid(p, p_world);
  const glm::ivec2 cell = glm::min(glm::ivec2(at), p.grid.samples_x - 2);
  const glm::dvec2 part = at - glm::dvec2(cell);
  const auto code = [&](int i, int j) {
    return static_cast<double>(p.posts[p.grid.index(cell.x + i, cell.y + j)]);
  };
  const double low = code(0, 0) + part.x * (code(1, 0) - code(0, 0));
  const double high = code(0, 1) + part.x * (code(1, 1) - code(0, 1));
  return static_cast<double>(p.base_m) +
         static_cast<double>(p.step_m) * (low + part.y * (high - low));
}

float highest_over(const HeightPyramid& p, glm::dvec2 low, glm::dvec2 high) {
  const glm::ivec2 last(p.grid.samples_x - 2);
  const glm::ivec2 first = glm::min(glm::ivec2(on_grid(p, low)), last);
  const glm::ivec2 end = glm::min(glm::ivec2(on_grid(p, high)), last);
  int level = 1;
  while (level < p.levels && std::max(end.x - first.x, end.y - first.y) >> level > 0) ++level;
  const int blocks = p.side >> level;
  std::uint16_t highest = 0;
  for (int j = first.y >> level; j <= end.y >> level; ++j)
    for (int i = first.x >> level; i <= end.x >> level; ++i)
      highest = std::max(highest, p.maxima[block(blocks, i, j)]);
  return p.base_m + p.step_m * static_cast<float>(highest);
}

glm::vec3 normal_at(const HeightPyramid& p, glm::dvec2 p_world) {
  const glm::dvec2 at = on_grid(p, p_world);
  const glm::ivec2 cell = glm::min(glm::ivec2(at), p.grid.samples_x - 2);
  const glm::vec2 part(at - glm::dvec2(cell));
  const auto code = [&](int i, int j) {
    return static_cast<float>(p.posts[p.grid.index(cell.x + i, cell.y + j)]);
  };
  const float x0 = code(1, 0) - code(0, 0), x1 = code(1, 1) - code(0, 1);
  const float y0 = code(0, 1) - code(0, 0), y1 = code(1, 1) - code(1, 0);
  const float scale = p.step_m / static_cast<float>(p.grid.spacing_m);
  const glm::vec2 slope = scale * glm::vec2(x0 + part.y * (x1 - x0), y0 + part.x * (y1 - y0));
  return glm::vec3(-slope, 1.0f) / std::sqrt(1.0f + slope.x * slope.x + slope.y * slope.y);
}

}  // namespace swell::terrain
