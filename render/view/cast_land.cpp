#include "render/view/cast_land.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "render/tile/shading.h"
#include "render/world/land_rays.h"
#include "terrain/height_rays.h"

namespace swell::render {
namespace {

constexpr float kFarthest = 1e9f;

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
  float floor = -kFarthest, begin = 0.0f;
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
  const LowestPath straight{eye_z, low.z, least_sag, -kFarthest, near_m};
  if (view.kind == ViewKind::kWindow) return straight;

  // The first that any of them meets the level.
  const auto level_t = view.eye.submerged ? first_crossing(above_m, high.z, most_sag)
                                          : first_crossing(above_m, low.z, least_sag);
  const float from = std::max(level_t.value_or(0.0f) * 0.9999f, near_m);
  if (view.kind == ViewKind::kReflection)
    return {level_m - above_m, -high.z, -most_sag,
            beyond || view.eye.submerged ? -kFarthest : level_m - kLevel_m, beyond ? near_m : from};
  if (beyond) return straight;
  if (view.eye.submerged)
    return {level_m - view.clip_margin_m - kLevel_m, 0.0f, 0.0f, -kFarthest, near_m};
  // As steep as the steepest, from where the first begins.
  const float n2 = view.refraction_index * view.refraction_index;
  const float most_down = std::sqrt((n2 - 1.0f) * most2 + n2 * low.z * low.z);
  const float least_down = std::sqrt((n2 - 1.0f) * least2);
  const float before = view.clip_margin_m / std::max(least_down, 1e-6f);
  const float begin = std::max(from - before, near_m);
  return {level_m + begin * most_down, -most_down, 0.0f, -kFarthest, begin};
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

  // Of the pixel (x, y) of the tile.
  float of_map(int x, int y) const { return free_[number(x, y)]; }
  float around(int x, int y) const { return free_around_[number(x, y)]; }

 private:
  static constexpr std::size_t kMost = 64;
  using Values = std::array<float, kMost>;

  std::size_t number(int x, int y) const {
    return static_cast<std::size_t>(y / kSquare_px * columns_ + x / kSquare_px);
  }

  void set_beam(const RenderView& view, const ViewRays& rays, glm::ivec2 first_px, std::size_t n) {
    glm::vec3 low(kFarthest), high(-kFarthest);
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

// The part of a path that lies above a height: where it comes down to it, or from where it rises.
void clip_to_outline(float outline_m, LandPath& path) {
  const float above = path.z + path.begin * (path.z_t + path.begin * path.z_tt) - outline_m;
  const float rise = path.z_t + 2.0f * path.z_tt * path.begin;
  const std::optional<float> way = first_crossing(above, rise, path.z_tt);
  if (above >= 0.0f) {
    if (way) path.end = std::min(path.end, path.begin + *way);
  } else {
    path.begin = way ? path.begin + *way : path.end;
  }
}

// Rays of one tile of a view, any number of them, as many at once as there is room for.
class LandRayBatch {
 public:
  LandRayBatch(const RenderView& view, const raster::PixelBox& box)
      : view_(view), rays_(make_rays(view.camera)), ways_(view, rays_, box), box_(box) {}

  // A ray at a place of the picture, in the pixel (x, y) of the tile, and what is there: both
  // change where the land is nearer, by flush() at the latest.
  void add(int x, int y, glm::vec2 at_px, float& depth, std::uint32_t& primitive) {
    if (count_ == kBatch) flush();
    const std::size_t n = count_++;
    const glm::vec3 direction = rays_.ray + at_px.y * rays_.ray_dy + at_px.x * rays_.ray_dx;
    LandPath path = land_path(view_, direction);
    if (view_.land->outline_m) clip_to_outline(*view_.land->outline_m, path);
    x_[n] = direction.x, y_[n] = direction.y;
    z_[n] = path.z, z_t_[n] = path.z_t, z_tt_[n] = path.z_tt;
    begin_[n] = std::min(std::max(path.begin, ways_.of_map(x, y)), kFarthest);
    begin_around_[n] = std::min(std::max(path.begin, ways_.around(x, y)), kFarthest);
    end_[n] = depth > 0.0f ? std::min(path.end, rays_.near_m / depth) : path.end;
    depth_[n] = &depth, primitive_[n] = &primitive;
  }

  // Depth as in the buffer before which no ray of the square at (x, y) of the tile meets land, but
  // for rounding; 0: none ever does.
  float farthest_z(int x, int y) const {
    return 1.0001f * rays_.near_m / std::min(ways_.of_map(x, y), ways_.around(x, y));
  }

  void flush() {
    cast(view_.land->map, begin_, end_, met_);
    if (view_.land_has_apron) {
      for (std::size_t n = 0; n < count_; ++n) end_[n] = std::min(end_[n], met_[n]);
      cast(view_.land->around, begin_around_, end_, met_around_);
      for (std::size_t n = 0; n < count_; ++n) met_[n] = std::min(met_[n], met_around_[n]);
    }
    const std::uint32_t land = view_.primitives.begin(SurfaceKind::kTerrain);
    for (std::size_t n = 0; n < count_; ++n) {
      const float z = rays_.near_m / met_[n];  // 0 at infinity
      if (z > *depth_[n]) *depth_[n] = std::min(z, 1.0f), *primitive_[n] = land;
    }
    count_ = 0;
  }

 private:
  static constexpr std::size_t kBatch = 64;
  using Values = std::array<float, kBatch>;

  void cast(const terrain::HeightPyramid& heights, const Values& begin, const Values& end,
            Values& t) const {
    const auto first = [&](const Values& values) { return std::span(values).first(count_); };
    terrain::cast_rays(
        heights, glm::dvec2(view_.camera.eye_world), rays_.pixel_angle,
        {first(x_), first(y_), first(z_), first(z_t_), first(z_tt_), first(begin), first(end)},
        std::span(t).first(count_));
  }

  const RenderView& view_;
  ViewRays rays_;
  FreeWays ways_;
  raster::PixelBox box_;
  std::size_t count_ = 0;
  Values x_, y_, z_, z_t_, z_tt_, begin_, begin_around_, end_, met_, met_around_;
  std::array<float*, kBatch> depth_;
  std::array<std::uint32_t*, kBatch> primitive_;
};

}  // namespace

LandPath land_path(const RenderView& view, glm::vec3 direction) {
  const float h2 = direction.x * direction.x + direction.y * direction.y;
  const float sag = view.drop_per_m2 * h2, near_m = view.camera.near_m;
  const auto eye_z = static_cast<float>(view.camera.eye_world.z);
  const LandPath straight{eye_z, direction.z, sag, near_m, kFarthest};
  if (view.kind == ViewKind::kWindow) return straight;

  const float level_m = view.level_m, above_m = eye_z - level_m;
  const std::optional<float> level_t = first_crossing(above_m, direction.z, sag);
  // The eye may be on the other side already.
  const bool beyond = view.eye.submerged == (above_m > 0.0f);
  if (!level_t && !beyond) return {};
  if (view.kind == ViewKind::kReflection)
    return {level_m - above_m, -direction.z, -sag, beyond ? near_m : std::max(*level_t, near_m),
            kFarthest};

  if (beyond) return straight;
  const float t = *level_t, z_t = direction.z + 2.0f * sag * t;
  const float n = view.eye.submerged ? 1.0f / view.refraction_index : view.refraction_index;
  const float down2 = n * n * (h2 + z_t * z_t) - h2;
  if (down2 <= 0.0f) return {};  // mirrored wholly
  const float down = view.eye.submerged ? std::sqrt(down2) : -std::sqrt(down2);
  const float before = view.clip_margin_m / std::abs(down);
  return {level_m - t * down, down, 0.0f, std::max(t - before, near_m), kFarthest};
}

int cast_land(const RenderView& view, const raster::TileGrid& grid, int tile, bool fresh,
              std::span<float> depth, std::span<std::uint32_t> primitive) {
  if (fresh) {
    std::ranges::fill(depth, 0.0f);
    std::ranges::fill(primitive, raster::kNoPrimitive);
  }
  const raster::PixelBox box = raster::tile_box(view.viewport(), grid, tile);
  LandRayBatch batch(view, box);
  // Square by square: their rays go much the same way.
  for (int y0 = 0; y0 < box.height_px; y0 += kSquare_px)
    for (int x0 = 0; x0 < box.width_px; x0 += kSquare_px) {
      const float farthest_z = batch.farthest_z(x0, y0);
      if (farthest_z == 0.0f) continue;
      for (int y = y0; y < std::min(y0 + kSquare_px, box.height_px); ++y)
        for (int x = x0; x < std::min(x0 + kSquare_px, box.width_px); ++x) {
          const auto at = static_cast<std::size_t>(y * grid.tile_size_px + x);
          if (depth[at] < farthest_z)
            batch.add(x, y, glm::vec2(box.x0_px + x, box.y0_px + y), depth[at], primitive[at]);
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
  LandRayBatch batch(view, box);
  std::size_t n = 0;
  for (int y = 0; y < box.height_px; ++y)
    for (std::uint64_t left = mask.row(y); left != 0; left &= left - 1) {
      const int x = std::countr_zero(left);
      for (const raster::SamplePosition& sample : positions) {
        const glm::vec2 from_corner = glm::vec2(sample.x_fx8, sample.y_fx8) * (1.0f / 256.0f);
        batch.add(x, y, glm::vec2(box.x0_px + x, box.y0_px + y) + from_corner - 0.5f, depth[n],
                  primitive[n]);
        ++n;
      }
    }
  batch.flush();
}

}  // namespace swell::render
