#include "render/view/cast_land.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "render/packets/view_rays.h"
#include "render/view/land_paths.h"
#include "render/world/land_rays.h"
#include "render/world/world_state.h"
#include "terrain/height_rays.h"

namespace swell::render {
namespace {

// Where z + z_t t + z_tt t^2 is 0 for the first time after t = 0.
std::optional<float> first_crossing(float z, float z_t, float z_tt) {
  const float root2 = z_t * z_t - 4.0f * z_tt * z;
  if (root2 < 0.0f || z == 0.0f) return std::nullopt;
  const float under = z > 0.0f ? z_t - std::sqrt(root2) : z_t + std::sqrt(root2);
  const float t = -2.0f * z / under;
  return under != 0.0f && t > 0.0f ? std::optional(t) : std::nullopt;
}

// The paths of all rays between two directions: in what range they begin, and that they are never
// lower than a path and a height.
struct LowestPath {
  float z = 0.0f, z_t = 0.0f, z_tt = 0.0f;
  float floor = -kFarthestLand, begin = 0.0f;
};

// The rays' heights over the level are known to this.
constexpr float kLevel_m = 0.01f;

LowestPath lowest_path(const RenderView& view, glm::vec3 low, glm::vec3 high) {
  const glm::vec2 near_ends = glm::max(glm::max(glm::vec2(low), -glm::vec2(high)), 0.0f);
  const glm::vec2 far_ends = glm::max(glm::abs(glm::vec2(low)), glm::abs(glm::vec2(high)));
  const float least2 = glm::dot(near_ends, near_ends), most2 = glm::dot(far_ends, far_ends);
  const float least_sag = view.drop_per_m2 * least2, most_sag = view.drop_per_m2 * most2;
  const auto eye_z = static_cast<float>(view.camera.eye_world.z);
  const float near_m = view.camera.near_m;
  const float level_m = view.level_m, above_m = eye_z - level_m;
  const bool beyond = view.eye.submerged == (above_m > 0.0f);
  const LowestPath straight{eye_z, low.z, least_sag, -kFarthestLand, near_m};
  if (view.kind == ViewKind::kWindow) return straight;

  // The first that any of them meets the level.
  const auto level_t = view.eye.submerged ? first_crossing(above_m, high.z, most_sag)
                                          : first_crossing(above_m, low.z, least_sag);
  const float from = std::max(level_t.value_or(0.0f) * 0.9999f, near_m);
  if (view.kind == ViewKind::kReflection)
    return {level_m - above_m, -high.z, -most_sag,
            beyond || view.eye.submerged ? -kFarthestLand : level_m - kLevel_m,
            beyond ? near_m : from};
  if (beyond) return straight;
  if (view.eye.submerged)
    return {level_m - view.clip_margin_m - kLevel_m, 0.0f, 0.0f, -kFarthestLand, near_m};
  // As steep as the steepest, from where the first begins.
  const float n2 = view.refraction_index * view.refraction_index;
  // The paper's law makes them less than half as steep again.
  const float steeper = view.paper_refraction ? 1.5f : 1.0f;
  const float most_down = steeper * std::sqrt((n2 - 1.0f) * most2 + n2 * low.z * low.z);
  const float least_down = std::sqrt((n2 - 1.0f) * least2) / steeper;
  const float before = view.clip_margin_m / std::max(least_down, 1e-6f);
  const float begin = std::max(from - before, near_m);
  return {level_m + begin * most_down, -most_down, 0.0f, -kFarthestLand, begin};
}

// Where the rays of squares of a tile's pixels may begin. Squares begin at multiples of their size
// in the picture, and are whole beyond its edge, so that tiles of any size see the same.
constexpr int kSquare_px = 8;

class FreeWays {
 public:
  FreeWays(const RenderView& view, const ViewRays& rays, const raster::PixelBox& box)
      : columns_((box.width_px + kSquare_px - 1) / kSquare_px) {
    free_around_.fill(std::numeric_limits<float>::infinity());
    const int rows = (box.height_px + kSquare_px - 1) / kSquare_px;
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns_; ++i)
        set_beam(view, rays, {box.x0_px + i * kSquare_px, box.y0_px + j * kSquare_px},
                 static_cast<std::size_t>(j * columns_ + i));
    const auto count = static_cast<std::size_t>(rows * columns_);
    cast(view, view.land->map, count, free_);
    if (view.land_has_apron) cast(view, view.land->around, count, free_around_);
  }

  // The ray of the tile's pixel (x, y) meets no land up to this t: in the map, and around it.
  float of_map(int x, int y) const { return free_[number(x, y)]; }
  float around(int x, int y) const { return free_around_[number(x, y)]; }

 private:
  static constexpr std::size_t kMost = 64;
  using Values = std::array<float, kMost>;

  std::size_t number(int x, int y) const {
    return static_cast<std::size_t>(y / kSquare_px * columns_ + x / kSquare_px);
  }

  void set_beam(const RenderView& view, const ViewRays& rays, glm::ivec2 first_px, std::size_t n) {
    glm::vec3 low(kFarthestLand), high(-kFarthestLand);
    // With all of the pixels' samples.
    for (const float y : {-0.5f, kSquare_px - 0.5f})
      for (const float x : {-0.5f, kSquare_px - 0.5f}) {
        const glm::vec2 at = glm::vec2(first_px) + glm::vec2(x, y);
        const glm::vec3 corner = rays.ray + at.x * rays.ray_dx + at.y * rays.ray_dy;
        low = glm::min(low, corner), high = glm::max(high, corner);
      }
    const LowestPath path = lowest_path(view, low, high);
    x_low_[n] = low.x, x_high_[n] = high.x, y_low_[n] = low.y, y_high_[n] = high.y;
    z_[n] = path.z, z_t_[n] = path.z_t, z_tt_[n] = path.z_tt;
    floor_[n] = path.floor, begin_[n] = path.begin;
  }

  void cast(const RenderView& view, const terrain::HeightPyramid& heights, std::size_t count,
            Values& t_free) const {
    const auto first = [&](const Values& values) { return std::span(values).first(count); };
    terrain::cast_beams(heights, glm::dvec2(view.camera.eye_world),
                        {first(x_low_), first(x_high_), first(y_low_), first(y_high_), first(z_),
                         first(z_t_), first(z_tt_), first(floor_), first(begin_)},
                        std::span(t_free).first(count));
  }

  int columns_;
  Values x_low_, x_high_, y_low_, y_high_, z_, z_t_, z_tt_, floor_, begin_, free_, free_around_;
};

float lower(float a, float b) { return a < b ? a : b; }

// Rays of one tile of a view, any number of them, as many at once as there is room for.
class LandRayBatch {
 public:
  // block_px: as terrain::kBlock_px. depth, primitive: what is there; changes where the land is
  // nearer, by flush() at the latest.
  LandRayBatch(const RenderView& view, const raster::PixelBox& box, float block_px,
               std::span<float> depth, std::span<std::uint32_t> primitive)
      : view_(view),
        rays_(make_rays(view.camera)),
        detail_m_per_t_(block_px * rays_.pixel_angle),
        ways_(view, rays_, box),
        depth_(depth),
        primitive_(primitive) {}

  // Makes room for so many rays, no more than kBatch.
  void reserve(std::size_t rays) {
    if (count_ + rays > kBatch) flush();
  }

  // Rays of a square, (x, y) being one of its pixels in the tile: through places of the picture,
  // a pixel apart in a row, for so many elements of the buffers.
  void add(int x, int y, glm::vec2 first_px, std::size_t first_element, std::size_t count) {
    const float free = ways_.of_map(x, y), free_around = ways_.around(x, y);
    for (std::size_t k = 0; k < count; ++k) {
      x_px_[count_ + k] = first_px.x + static_cast<float>(k);
      y_px_[count_ + k] = first_px.y;
      there_[count_ + k] = depth_[first_element + k];
      element_[count_ + k] = static_cast<std::uint32_t>(first_element + k);
      free_[count_ + k] = free;
      free_around_[count_ + k] = free_around;
    }
    count_ += count;
  }

  // Depth as in the buffer before which no ray of the square at (x, y) of the tile meets land, but
  // for rounding; 0: none ever does.
  float farthest_z(int x, int y) const {
    return 1.0001f * rays_.near_m / std::min(ways_.of_map(x, y), ways_.around(x, y));
  }

  void flush() {
    std::ranges::fill(first(towards_), 0.0f);
    cast();
    // Each time along the chord to what was met before: three times take it to where the bent ray
    // meets the land, but for a thousandth.
    const bool bends = view_.paper_refraction && view_.kind == ViewKind::kRefraction;
    for (int again = 0; bends && again < 3; ++again) {
      std::ranges::copy(first(met_), towards_.begin());
      cast();
    }
    take_nearer();
    count_ = 0;
  }

 private:
  static constexpr std::size_t kBatch = 256;
  using Values = std::array<float, kBatch>;

  std::span<float> first(Values& values) const { return std::span(values).first(count_); }

  void cast() {
    set_land_rays(view_, rays_,
                  {first(x_px_), first(y_px_), first(there_), first(free_), first(free_around_),
                   first(towards_), first(x_), first(y_), first(z_), first(z_t_), first(z_tt_),
                   first(begin_), first(begin_around_), first(end_)});
    cast(view_.land->map, begin_, met_);
    if (view_.land_has_apron) {
      bool any = false;
      for (std::size_t n = 0; n < count_; ++n) {
        end_[n] = lower(met_[n], end_[n]);
        any |= begin_around_[n] < end_[n];
      }
      if (any) {
        cast(view_.land->around, begin_around_, met_around_);
        for (std::size_t n = 0; n < count_; ++n) met_[n] = lower(met_around_[n], met_[n]);
      }
    }
  }

  void cast(const terrain::HeightPyramid& heights, Values& begin, Values& t) {
    terrain::cast_rays(
        heights, glm::dvec2(view_.camera.eye_world), detail_m_per_t_,
        {first(x_), first(y_), first(z_), first(z_t_), first(z_tt_), first(begin), first(end_)},
        first(t));
  }

  void take_nearer() {
    const std::uint32_t land = view_.primitives.begin(SurfaceKind::kTerrain);
    for (std::size_t n = 0; n < count_; ++n) {
      const float z = rays_.near_m / met_[n];  // 0 at infinity
      if (z > there_[n]) depth_[element_[n]] = lower(z, 1.0f), primitive_[element_[n]] = land;
    }
  }

  const RenderView& view_;
  ViewRays rays_;
  float detail_m_per_t_;
  FreeWays ways_;
  std::span<float> depth_;
  std::span<std::uint32_t> primitive_;
  std::size_t count_ = 0;
  std::array<std::uint32_t, kBatch> element_;
  Values x_px_, y_px_, there_, free_, free_around_, towards_;
  Values x_, y_, z_, z_t_, z_tt_, begin_, begin_around_, end_, met_, met_around_;
};

// Samples lie nearer to each other than pixels do, and an outline follows the surface's height.
constexpr float kFineBlock_px = 0.25f * terrain::kBlock_px;

}  // namespace

int cast_land(const RenderView& view, const raster::TileGrid& grid, int tile, bool fresh,
              std::span<float> depth, std::span<std::uint32_t> primitive) {
  if (fresh) {
    std::ranges::fill(depth, 0.0f);
    std::ranges::fill(primitive, raster::kNoPrimitive);
  }
  const raster::PixelBox box = raster::tile_box(view.viewport(), grid, tile);
  LandRayBatch batch(view, box, view.land->outline_m ? kFineBlock_px : terrain::kBlock_px, depth,
                     primitive);
  // Square by square: their rays go much the same way.
  for (int y0 = 0; y0 < box.height_px; y0 += kSquare_px)
    for (int x0 = 0; x0 < box.width_px; x0 += kSquare_px) {
      const float farthest_z = batch.farthest_z(x0, y0);
      if (farthest_z == 0.0f) continue;
      batch.reserve(kSquare_px * kSquare_px);
      const int width = std::min(kSquare_px, box.width_px - x0);
      for (int y = y0; y < std::min(y0 + kSquare_px, box.height_px); ++y) {
        const auto at = static_cast<std::size_t>(y * grid.tile_size_px + x0);
        const auto there = depth.subspan(at, static_cast<std::size_t>(width));
        if (std::ranges::any_of(there, [&](float z) { return z < farthest_z; }))
          batch.add(x0, y, glm::vec2(box.x0_px + x0, box.y0_px + y), at, there.size());
      }
    }
  batch.flush();
  // Beyond the viewport nothing is covered.
  return static_cast<int>(primitive.size()) -
         static_cast<int>(std::ranges::count(primitive, raster::kNoPrimitive));
}

void cast_land_samples(const RenderView& view, const raster::PixelBox& box, int samples,
                       const raster::PixelMask& mask, std::span<float> depth,
                       std::span<std::uint32_t> primitive) {
  const auto positions = raster::sample_positions(samples);
  LandRayBatch batch(view, box, kFineBlock_px, depth, primitive);
  std::size_t n = 0;
  for (int y = 0; y < box.height_px; ++y)
    for (std::uint64_t left = mask.row(y); left != 0; left &= left - 1) {
      const int x = std::countr_zero(left);
      batch.reserve(positions.size());
      for (const raster::SamplePosition& sample : positions) {
        const glm::vec2 from_corner = glm::vec2(sample.x_fx8, sample.y_fx8) * (1.0f / 256.0f);
        batch.add(x, y, glm::vec2(box.x0_px + x, box.y0_px + y) + from_corner - 0.5f, n, 1);
        ++n;
      }
    }
  batch.flush();
}

}  // namespace swell::render
