#include "render/view/implicits.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "raster/sample_pattern.h"
#include "render/view/implicit_squares.h"
#include "render/view/render_view.h"
#include "scene/implicit_surface.h"

namespace swell::render {
namespace {

constexpr int kBlock_px = 16, kCell_px = 8;  // rays have one middle in a block
constexpr int kEdgeCell_px = 4;

// A list of part numbers, near ones first.
struct Parts {
  std::array<std::uint16_t, scene::kMostImplicitParts> number;
  std::size_t count = 0;
  std::span<const std::uint16_t> list() const { return {number.data(), count}; }
};

// kSquares x kSquares squares of the picture. They begin at multiples of their size.
struct Region {
  int x0_px, y0_px, square_px;

  int end_x_px() const { return x0_px + kSquares * square_px; }
  int end_y_px() const { return y0_px + kSquares * square_px; }
};

// Squares [i0, i1] x [j0, j1] of a region.
std::uint64_t squares_between(int i0, int j0, int i1, int j1) {
  i0 = std::max(i0, 0), j0 = std::max(j0, 0);
  i1 = std::min(i1, kSquares - 1), j1 = std::min(j1, kSquares - 1);
  if (i0 > i1 || j0 > j1) return 0;
  const std::uint64_t row = (std::uint64_t{2} << i1) - (std::uint64_t{1} << i0);
  std::uint64_t squares = 0;
  for (int j = j0; j <= j1; ++j) squares |= row << (kSquares * j);
  return squares;
}

// The squares that share a pixel with [x0, x1] x [y0, y1].
std::uint64_t squares_with(const Region& region, int x0, int y0, int x1, int y1) {
  const auto number = [&](int at, int begin) {
    return at < begin ? -1 : (at - begin) / region.square_px;
  };
  if (x1 < region.x0_px || y1 < region.y0_px || x0 > x1 || y0 > y1) return 0;
  return squares_between(number(x0, region.x0_px), number(y0, region.y0_px),
                         number(x1, region.x0_px), number(y1, region.y0_px));
}

std::uint64_t squares_with(const Region& region, const PartPlace& place) {
  const auto pixel = [](float at, int begin, int end) {
    return static_cast<int>(
        std::floor(std::clamp(at, static_cast<float>(begin) - 1.0f, static_cast<float>(end))));
  };
  if (place.x0 > place.x1) return 0;
  return squares_with(region, pixel(place.x0, region.x0_px, region.end_x_px()),
                      pixel(place.y0, region.y0_px, region.end_y_px()),
                      pixel(place.x1, region.x0_px, region.end_x_px()),
                      pixel(place.y1, region.y0_px, region.end_y_px()));
}

// The points that the squares' rays pass between a part's depths: rays through a middle, and to
// the sides.
SquareBeams beams_of(const ImplicitsInView& in, const ImplicitInView& implicit, const RayPart& part,
                     const PartPlace& place, const Region& region) {
  const double half = 0.5 * region.square_px;
  const double middle_m = 0.5 * (static_cast<double>(place.nearest_m) + place.farthest_m);
  const double half_m = 0.5 * (static_cast<double>(place.farthest_m) - place.nearest_m);
  const glm::dvec3 ray = implicit.implicit_from_ray * (in.ray + (region.x0_px + half) * in.ray_dx +
                                                       (region.y0_px + half) * in.ray_dy);
  const glm::dvec3 dx = implicit.implicit_from_ray * in.ray_dx,
                   dy = implicit.implicit_from_ray * in.ray_dy;
  const double aside = half * place.farthest_m, step_px = region.square_px;
  return {glm::vec3(implicit.implicit_from_eye - glm::dvec3(part.middle) + middle_m * ray),
          glm::vec3(step_px * middle_m * dx),
          glm::vec3(step_px * middle_m * dy),
          glm::vec3(half_m * ray),
          glm::vec3(step_px * half_m * dx),
          glm::vec3(step_px * half_m * dy),
          glm::vec3(aside * dx),
          glm::vec3(aside * dy)};
}

// Which parts a region's squares may show.
struct RegionParts {
  Region region;
  Parts parts;
  std::array<std::uint64_t, scene::kMostImplicitParts> squares;  // of each of them
  std::uint64_t any = 0;

  void list(std::uint64_t in_squares, Parts& some) const {
    some.count = 0;
    for (std::size_t i = 0; i < parts.count; ++i)
      if (squares[i] & in_squares) some.number[some.count++] = parts.number[i];
  }
};

// Returns the parts that the squares shared by a box and the implicit surface may show.
RegionParts parts_in(const ImplicitsInView& in, const ImplicitInView& implicit,
                     const Region& region, const raster::PixelBox& box) {
  RegionParts found;
  found.region = region;
  const std::uint64_t shared =
      squares_with(region, std::max(box.x0_px, implicit.x0), std::max(box.y0_px, implicit.y0),
                   std::min(box.x0_px + box.width_px - 1, implicit.x1),
                   std::min(box.y0_px + box.height_px - 1, implicit.y1));
  const bool tries_all = !in.squares || implicit.bent;
  const std::span order =
      std::span(in.order).subspan(implicit.first_in_order, implicit.implicit->parts.size());
  for (const std::uint16_t number : order) {
    std::uint64_t squares = shared;
    if (!tries_all) {
      const PartPlace& place = in.places[implicit.first_place + number];
      squares &= squares_with(region, place);
      const RayPart& part = implicit.implicit->parts[number];
      if (squares)
        squares = squares_showing(*implicit.implicit, part,
                                  beams_of(in, implicit, part, place, region), squares);
    }
    if (squares == 0) continue;
    found.squares[found.parts.count] = squares;
    found.parts.number[found.parts.count++] = number;
    found.any |= squares;
  }
  return found;
}

// Blocks begin at multiples of their size in the picture, so that tiles of any size see the same.
RayBlock block_at(const ImplicitsInView& in, const ImplicitInView& implicit, int x0_px, int y0_px,
                  BentRays& bent) {
  const double x = x0_px + 0.5 * kBlock_px, y = y0_px + 0.5 * kBlock_px;
  const glm::dvec3 ray = in.ray + x * in.ray_dx + y * in.ray_dy;
  RayBlock block;
  block.ray = glm::vec3(implicit.implicit_from_ray * ray);
  block.ray_dx = glm::vec3(implicit.implicit_from_ray * in.ray_dx);
  block.ray_dy = glm::vec3(implicit.implicit_from_ray * in.ray_dy);
  block.middle_depth_m = static_cast<float>(implicit.middle_depth_m);
  block.middle =
      glm::vec3(implicit.implicit_from_eye +
                implicit.implicit_from_ray * ray * static_cast<double>(block.middle_depth_m));
  block.near_m = in.near_m;
  block.planes = implicit.planes, block.plane_count = implicit.plane_count;
  block.bent = nullptr;
  if (implicit.bent) {
    bent = *implicit.bent;
    bent.ray += static_cast<float>(x) * bent.ray_dx + static_cast<float>(y) * bent.ray_dy;
    block.bent = &bent;
  }
  return block;
}

// Calls visit(region) for the regions of squares that a box and an implicit surface share.
template <class Visit>
void for_regions(const ImplicitInView& implicit, const raster::PixelBox& box, int square_px,
                 const Visit& visit) {
  const int x0 = std::max(box.x0_px, implicit.x0),
            x1 = std::min(box.x0_px + box.width_px - 1, implicit.x1);
  const int y0 = std::max(box.y0_px, implicit.y0),
            y1 = std::min(box.y0_px + box.height_px - 1, implicit.y1);
  if (x0 > x1) return;
  const int size_px = kSquares * square_px;
  for (int y = y0 / size_px * size_px; y <= y1; y += size_px)
    for (int x = x0 / size_px * size_px; x <= x1; x += size_px) visit(Region{x, y, square_px});
}

bool meets(const ImplicitInView& implicit, const raster::PixelBox& box) {
  return implicit.x0 < box.x0_px + box.width_px && implicit.x1 >= box.x0_px &&
         implicit.y0 < box.y0_px + box.height_px && implicit.y1 >= box.y0_px;
}

// A cell's pixels, side by side.
constexpr std::size_t kCellPixels = kCell_px * kCell_px;

struct Rays {
  alignas(64) std::array<float, kCellPixels> x, y, z;
  alignas(64) std::array<std::uint32_t, kCellPixels> primitive;
};

// What a tile's buffers hold, side_px^2 long.
struct TileBuffers {
  const raster::PixelBox& box;
  int side_px;
  std::span<float> depth;
  std::span<std::uint32_t> primitive;
};

// Draws the cell at (x0, y0) of the picture with the rays of the block at block_px.
void draw_cell(const ImplicitInView& implicit, const Parts& parts, const RayBlock& block,
               glm::ivec2 block_px, int x0, int y0, const TileBuffers& tile) {
  Rays rays;
  const raster::PixelBox& box = tile.box;
  const int columns = std::min(kCell_px, box.x0_px + box.width_px - x0);
  const int rows = std::min(kCell_px, box.y0_px + box.height_px - y0);
  const auto at = [&](int row) {
    return static_cast<std::size_t>(y0 - box.y0_px + row) * static_cast<std::size_t>(tile.side_px) +
           static_cast<std::size_t>(x0 - box.x0_px);
  };
  for (int row = 0; row < kCell_px; ++row)
    for (int column = 0; column < kCell_px; ++column) {
      const std::size_t i = static_cast<std::size_t>(row * kCell_px + column);
      const bool inside = row < rows && column < columns;
      rays.x[i] = static_cast<float>(x0 + column - block_px.x) + 0.5f - 0.5f * kBlock_px;
      rays.y[i] = static_cast<float>(y0 + row - block_px.y) + 0.5f - 0.5f * kBlock_px;
      rays.z[i] = inside ? tile.depth[at(row) + static_cast<std::size_t>(column)] : 1.0f;
      rays.primitive[i] = inside ? tile.primitive[at(row) + static_cast<std::size_t>(column)] : 0;
    }
  cast_rays({*implicit.implicit, parts.list(), implicit.first_primitive}, block, rays.x, rays.y,
            rays.z, rays.primitive);
  for (int row = 0; row < rows; ++row) {
    const auto first = static_cast<std::ptrdiff_t>(row * kCell_px);
    std::copy_n(rays.z.begin() + first, columns,
                tile.depth.begin() + static_cast<std::ptrdiff_t>(at(row)));
    std::copy_n(rays.primitive.begin() + first, columns,
                tile.primitive.begin() + static_cast<std::ptrdiff_t>(at(row)));
  }
}

constexpr int kBlockCells = kBlock_px / kCell_px;  // along a side

// Calls visit(found, squares, x0_px, y0_px) for the blocks of rays where a box and an implicit
// surface meet, with the region's squares that are the block's.
template <class Visit>
void for_blocks(const ImplicitsInView& in, const ImplicitInView& implicit,
                const raster::PixelBox& box, const Visit& visit) {
  for_regions(implicit, box, kCell_px, [&](const Region& region) {
    const RegionParts found = parts_in(in, implicit, region, box);
    if (found.any == 0) return;
    for (int j0 = 0; j0 < kSquares; j0 += kBlockCells)
      for (int i0 = 0; i0 < kSquares; i0 += kBlockCells) {
        const std::uint64_t squares =
            squares_between(i0, j0, i0 + kBlockCells - 1, j0 + kBlockCells - 1);
        if (found.any & squares)
          visit(found, squares, region.x0_px + i0 * kCell_px, region.y0_px + j0 * kCell_px);
      }
  });
}

void draw_implicit(const ImplicitsInView& in, const ImplicitInView& implicit,
                   const TileBuffers& tile) {
  for_blocks(in, implicit, tile.box,
             [&](const RegionParts& found, std::uint64_t squares, int x0, int y0) {
               BentRays bent;
               const RayBlock block = block_at(in, implicit, x0, y0, bent);
               Parts of_cell;
               for (std::uint64_t left = squares & found.any; left != 0; left &= left - 1) {
                 const int square = std::countr_zero(left);
                 found.list(std::uint64_t{1} << square, of_cell);
                 const int x = found.region.x0_px + square % kSquares * kCell_px;
                 const int y = found.region.y0_px + square / kSquares * kCell_px;
                 draw_cell(implicit, of_cell, block, {x0, y0}, x, y, tile);
               }
             });
}

// The rays of a block's samples, cast as many at once as a cell has pixels.
class SampleRays {
 public:
  SampleRays(const ImplicitInView& implicit, const Parts& parts, const RayBlock& block,
             std::span<float> depth, std::span<std::uint32_t> primitive)
      : implicit_(implicit), parts_(parts), block_(block), depth_(depth), primitive_(primitive) {}

  // Adds the ray of a sample at (x, y) from the block's middle.
  void add(float x, float y, std::size_t sample) {
    rays_.x[count_] = x;
    rays_.y[count_] = y;
    rays_.z[count_] = depth_[sample];
    rays_.primitive[count_] = primitive_[sample];
    sample_[count_++] = sample;
    if (count_ == kCellPixels) cast();
  }

  // Casts those that were added since.
  void cast() {
    if (count_ == 0) return;
    for (std::size_t i = count_; i < kCellPixels; ++i)
      rays_.x[i] = rays_.y[i] = 0.0f, rays_.z[i] = 1.0f, rays_.primitive[i] = 0;
    cast_rays({*implicit_.implicit, parts_.list(), implicit_.first_primitive}, block_, rays_.x,
              rays_.y, rays_.z, rays_.primitive);
    for (std::size_t i = 0; i < count_; ++i)
      depth_[sample_[i]] = rays_.z[i], primitive_[sample_[i]] = rays_.primitive[i];
    count_ = 0;
  }

 private:
  const ImplicitInView& implicit_;
  const Parts& parts_;
  const RayBlock& block_;
  std::span<float> depth_;
  std::span<std::uint32_t> primitive_;
  Rays rays_;
  std::array<std::size_t, kCellPixels> sample_;
  std::size_t count_ = 0;
};

}  // namespace

int draw_implicits(const ImplicitsInView& implicits, const raster::PixelBox& box, int side_px,
                   int covered, std::span<float> depth, std::span<std::uint32_t> primitive) {
  if (std::ranges::none_of(implicits.implicits,
                           [&](const ImplicitInView& f) { return meets(f, box); }))
    return covered;
  if (covered < 0) {
    std::ranges::fill(depth, 0.0f);
    std::ranges::fill(primitive, raster::kNoPrimitive);
  }
  for (const ImplicitInView& implicit : implicits.implicits)
    if (meets(implicit, box)) draw_implicit(implicits, implicit, {box, side_px, depth, primitive});
  // Beyond the viewport nothing is covered.
  return static_cast<int>(primitive.size()) -
         static_cast<int>(std::ranges::count(primitive, raster::kNoPrimitive));
}

void mark_implicits(const ImplicitsInView& implicits, const raster::PixelBox& box, int side_px,
                    std::span<const std::uint32_t> primitive, raster::PixelMask& mask) {
  for (const ImplicitInView& implicit : implicits.implicits) {
    if (!meets(implicit, box)) continue;
    const auto parts = static_cast<std::uint32_t>(implicit.implicit->parts.size());
    const auto shows = [&](int x, int y) {
      const int column = x - box.x0_px, row = y - box.y0_px;
      if (column < 0 || row < 0 || column >= box.width_px || row >= box.height_px) return true;
      const auto at = static_cast<std::size_t>(row * side_px + column);
      return primitive[at] - implicit.first_primitive < parts;
    };
    for_regions(implicit, box, kEdgeCell_px, [&](const Region& region) {
      const std::uint64_t any = parts_in(implicits, implicit, region, box).any;
      for (std::uint64_t left = any; left != 0; left &= left - 1) {
        const int square = std::countr_zero(left);
        const int x = region.x0_px + square % kSquares * kEdgeCell_px,
                  y = region.y0_px + square / kSquares * kEdgeCell_px;
        bool inside = true;
        for (int j = -1; j <= kEdgeCell_px && inside; ++j)
          for (int i = -1; i <= kEdgeCell_px; ++i) inside = inside && shows(x + i, y + j);
        if (inside) continue;
        for (int j = y; j < std::min(y + kEdgeCell_px, box.y0_px + box.height_px); ++j)
          for (int i = x; i < std::min(x + kEdgeCell_px, box.x0_px + box.width_px); ++i)
            mask.add(i - box.x0_px, j - box.y0_px);
      }
    });
  }
}

void draw_implicit_samples(const ImplicitsInView& implicits, const raster::PixelBox& box,
                           int samples, const raster::PixelMask& mask, std::span<float> depth,
                           std::span<std::uint32_t> primitive) {
  const auto positions = raster::sample_positions(samples);
  // Which sample is the first of each row of pixels.
  std::array<std::size_t, raster::PixelMask::kMaxRows + 1> first_of_row{};
  for (int y = 0; y < raster::PixelMask::kMaxRows; ++y)
    first_of_row[static_cast<std::size_t>(y) + 1] =
        first_of_row[static_cast<std::size_t>(y)] +
        static_cast<std::size_t>(std::popcount(mask.row(y)) * samples);
  // Draws the samples of the block at (x0, y0).
  const auto draw_block = [&](const ImplicitInView& implicit, const RegionParts& found,
                              std::uint64_t squares, int x0, int y0) {
    const int column = x0 - box.x0_px;
    const std::uint64_t columns = std::uint64_t{0xFFFF} << column;
    const auto row_of = [&](int y) { return mask.row(y - box.y0_px) & columns; };
    const int end_y = std::min(y0 + kBlock_px, box.y0_px + box.height_px);
    bool any = false;
    for (int y = y0; y < end_y; ++y) any = any || row_of(y) != 0;
    if (!any) return;
    BentRays bent;
    const RayBlock block = block_at(implicits, implicit, x0, y0, bent);
    Parts parts;
    found.list(squares, parts);
    SampleRays rays(implicit, parts, block, depth, primitive);
    for (int y = y0; y < end_y; ++y) {
      const int row = y - box.y0_px;
      for (std::uint64_t left = row_of(y); left != 0; left &= left - 1) {
        const int bit = std::countr_zero(left);
        const std::uint64_t before = mask.row(row) & ((std::uint64_t{1} << bit) - 1);
        const std::size_t first = first_of_row[static_cast<std::size_t>(row)] +
                                  static_cast<std::size_t>(std::popcount(before) * samples);
        for (std::size_t s = 0; s < static_cast<std::size_t>(samples); ++s)
          rays.add(static_cast<float>(bit - column) - 0.5f * kBlock_px +
                       static_cast<float>(positions[s].x_fx8) * (1.0f / 256.0f),
                   static_cast<float>(y - y0) - 0.5f * kBlock_px +
                       static_cast<float>(positions[s].y_fx8) * (1.0f / 256.0f),
                   first + s);
      }
    }
    rays.cast();
  };
  for (const ImplicitInView& implicit : implicits.implicits)
    if (meets(implicit, box))
      for_blocks(implicits, implicit, box,
                 [&](const RegionParts& found, std::uint64_t squares, int x0, int y0) {
                   draw_block(implicit, found, squares, x0, y0);
                 });
}

}  // namespace swell::render
