#include "render/tile/edges.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "render/view/cast_land.h"
#include "render/view/visibility.h"

namespace swell::render {
namespace {

// The primitives of what samples are told apart by: a surface, one of its parts if it has some, or
// the sky, which has kNoPrimitive alone. No two begin alike.
struct SurfaceRange {
  std::uint32_t begin = raster::kNoPrimitive, size = 1;
  // A triangle is one place however deep it is: towards the horizon it may be kilometres in one
  // pixel. All land that rays find is one primitive.
  bool one_place = true;
  bool is_part = false;
  bool holds(std::uint32_t primitive) const { return primitive - begin < size; }
};

SurfaceRange range_of(const RenderView& window, std::uint32_t primitive) {
  for (const SurfaceKind kind : kAllSurfaces) {
    if (!window.primitives.holds(kind, primitive)) continue;
    const std::uint32_t begin = window.primitives.begin(kind), end = window.primitives.end(kind);
    const DrawRecord& record = window.draws[kind];
    if (record.parts.empty())
      return {.begin = begin, .size = end - begin, .one_place = !record.is_cast};
    const DrawPart& part = record.part_of(primitive - begin);
    return {.begin = begin + part.first_triangle, .size = part.triangles, .is_part = true};
  }
  return {};
}

// The samples of one pixel that show one surface.
struct Group {
  SurfaceRange surface;
  int count = 0;
  float nearest = 0.0f, x_px = 0.0f, y_px = 0.0f, z = 0.0f;  // z and place: sums
  std::uint32_t primitive = raster::kNoPrimitive;
};

bool same_place(float a, float b) {
  return std::abs(a - b) <= kPartOfDiscontinuity * std::max(a, b);
}

// What one sample shows.
struct Sample {
  std::uint32_t primitive;
  SurfaceRange surface;
  float z;
};

// Into which of the groups a sample goes; a new one while there is room.
Group& group_of(const Sample& sample, std::span<Group, kMaxFragments> groups, std::size_t& count) {
  for (Group& g : groups.first(count))
    if (g.surface.begin == sample.surface.begin &&
        ((g.primitive == sample.primitive && sample.surface.one_place) ||
         same_place(g.nearest, sample.z)))
      return g;
  if (count < kMaxFragments) {
    groups[count] = {.surface = sample.surface, .nearest = sample.z, .primitive = sample.primitive};
    return groups[count++];
  }
  // No room: to the like, or the last.
  for (Group& g : groups)
    if (g.surface.begin == sample.surface.begin) return g;
  return groups.back();
}

struct Pixel {
  std::uint16_t at;
  int x_px, y_px;  // in the picture
  // What the pixel's centre shows.
  float z;
  std::uint32_t primitive;
  SurfaceRange surface;
};

// The triangle that most of the group's samples show, the first of equals: a part is shaded as it,
// and a box's side that one sample grazes must not stand for its front.
std::uint32_t most_seen(const Group* group, std::span<const Group* const> group_of_sample,
                        std::span<const std::uint32_t> primitive) {
  std::uint32_t best = group->primitive;
  int most = 0;
  for (std::size_t s = 0; s < primitive.size(); ++s) {
    int same = 0;
    for (std::size_t t = 0; t < primitive.size(); ++t)
      same += group_of_sample[t] == group && primitive[t] == primitive[s];
    if (group_of_sample[s] == group && same > most) most = same, best = primitive[s];
  }
  return best;
}

// Whether all samples lie on the centre's triangle, or on its surface near its depth, as most do.
template <std::size_t kSamples>
bool shows_one_place(const Pixel& pixel, std::span<const float, kSamples> depth,
                     std::span<const std::uint32_t, kSamples> primitive) {
  std::uint32_t other_triangle = 0, other_place = !same_place(depth[0], pixel.z);
  for (std::size_t s = 0; s < kSamples; ++s) other_triangle |= primitive[s] ^ pixel.primitive;
  if (other_triangle == 0 && pixel.surface.one_place) return true;
  for (std::size_t s = 0; s < kSamples; ++s)
    other_place |= int{!pixel.surface.holds(primitive[s])} | int{!same_place(depth[0], depth[s])};
  return other_place == 0;
}

// Appends the fragments of a pixel that shows more than one place; none if all of its samples show
// what the centre does.
void add_fragments(const Pixel& pixel, std::span<const float> depth,
                   std::span<const std::uint32_t> primitive, const RenderView& window,
                   std::vector<EdgeFragment>& out) {
  const auto positions = raster::sample_positions(static_cast<int>(depth.size()));
  std::array<Group, kMaxFragments> groups;
  std::array<const Group*, raster::kMaxSamples> group_of_sample{};
  std::size_t count = 0;
  for (std::size_t s = 0; s < depth.size(); ++s) {
    const bool like_centre = pixel.surface.holds(primitive[s]);
    const SurfaceRange surface = like_centre ? pixel.surface : range_of(window, primitive[s]);
    Group& g = group_of({primitive[s], surface, depth[s]}, groups, count);
    ++g.count;
    group_of_sample[s] = &g;
    g.x_px += static_cast<float>(positions[s].x_fx8) * (1.0f / 256.0f) - 0.5f;
    g.y_px += static_cast<float>(positions[s].y_fx8) * (1.0f / 256.0f) - 0.5f;
    g.z += depth[s];
  }
  bool centre_found = false;
  const auto is_centre = [&](const Group& g) {
    return !centre_found && g.surface.begin == pixel.surface.begin &&
           ((g.primitive == pixel.primitive && pixel.surface.one_place) ||
            same_place(g.nearest, pixel.z));
  };
  if (count == 1 && is_centre(groups[0])) return;
  for (const Group& g : std::span(groups).first(count)) {
    const float part = 1.0f / static_cast<float>(g.count);
    const bool centre = is_centre(g);
    centre_found |= centre;
    out.push_back(
        {.x_px = static_cast<float>(pixel.x_px) + part * g.x_px,
         .y_px = static_cast<float>(pixel.y_px) + part * g.y_px,
         .z = part * g.z,
         .primitive = g.surface.is_part ? most_seen(&g, group_of_sample, primitive) : g.primitive,
         .pixel = pixel.at,
         .samples = static_cast<std::uint8_t>(g.count),
         .is_centre = centre});
  }
}

// Returns the tiles that points lie in, and the depth of the nearest.
std::pair<TileBox, float> extent_of(std::span<const glm::vec4> p_clip, raster::Viewport viewport,
                                    const raster::TileGrid& grid) {
  glm::vec3 low(1.0f), high(-1.0f);
  for (const glm::vec4& p : p_clip) {
    // Beside or behind the eye: anywhere.
    if (!(p.w > p.z)) return {{0, 0, grid.tiles_x - 1, grid.tiles_y - 1}, 1.0f};
    low = glm::min(low, glm::vec3(p) / p.w);
    high = glm::max(high, glm::vec3(p) / p.w);
  }
  // One pixel more, for rounding.
  const auto tile_at = [&](float ndc, int size_px, float more_px, int tiles) {
    const float px = (0.5f + 0.5f * ndc) * static_cast<float>(size_px) + more_px;
    const float tile = std::floor(px / static_cast<float>(grid.tile_size_px));
    return static_cast<int>(std::clamp(tile, -1.0f, static_cast<float>(tiles)));
  };
  return {{tile_at(low.x, viewport.width_px, -1.0f, grid.tiles_x),
           tile_at(-high.y, viewport.height_px, -1.0f, grid.tiles_y),
           tile_at(high.x, viewport.width_px, 1.0f, grid.tiles_x),
           tile_at(-low.y, viewport.height_px, 1.0f, grid.tiles_y)},
          high.z};
}

// Marks what a part's triangles touch, but for the pixels inside it and those that hide it.
void mark_part(const RenderView& window, const VisibilityBuffer& visibility, int tile,
               const PartExtent& part, const DiscontinuityScratch& scratch,
               raster::PixelMask& mask) {
  const raster::PixelMask interior =
      find_interior(visibility, window.viewport(), tile, part.begin, part.end);
  const int side = visibility.grid.tile_size_px;
  const raster::PixelMask behind = find_behind(scratch, side, part.nearest_z);
  const auto may_show = [&](int y) { return behind.row(y) & ~interior.row(y); };
  // Triangles with nothing but other and marked pixels around need no look.
  raster::PixelMask touched = mask;
  for (int y = 0; y < side; ++y) touched.add_to_row(y, ~may_show(y));
  raster::mark_touched(window.pass, tile, part.begin, part.end, touched);
  for (int y = 0; y < side; ++y) mask.add_to_row(y, touched.row(y) & may_show(y));
}

raster::PixelMask mark_pixels(const RenderView& window, const VisibilityBuffer& visibility,
                              std::span<const PartExtent> parts, int tile,
                              DiscontinuityScratch& scratch) {
  raster::PixelMask mask;
  mark_discontinuities(visibility, window, tile, scratch, mask);
  const int tiles_x = visibility.grid.tiles_x;
  for (const PartExtent& part : parts)
    if (part.tiles.holds(tile % tiles_x, tile / tiles_x))
      mark_part(window, visibility, tile, part, scratch, mask);
  mark_implicits(window.implicits, raster::tile_box(window.viewport(), visibility.grid, tile),
                 visibility.grid.tile_size_px, visibility.primitive_of(tile), mask);
  return mask;
}

// The fragments of the marked pixels, whose samples are in the scratch.
template <std::size_t kSamples>
void sort_samples(const RenderView& window, const VisibilityBuffer& visibility, int tile,
                  const raster::PixelMask& mask, const EdgeScratch& scratch,
                  std::vector<EdgeFragment>& out) {
  const raster::PixelBox box = raster::tile_box(window.viewport(), visibility.grid, tile);
  const std::span<const float> depth = visibility.depth_of(tile);
  const std::span<const std::uint32_t> primitive = visibility.primitive_of(tile);
  const float* sample_depth = scratch.depth.data();
  const std::uint32_t* sample_primitive = scratch.primitive.data();
  for (int y = 0; y < box.height_px; ++y) {
    for (std::uint64_t left = mask.row(y); left != 0; left &= left - 1) {
      const int x = std::countr_zero(left);
      const auto at = static_cast<std::uint16_t>(y * visibility.grid.tile_size_px + x);
      const Pixel pixel{.at = at,
                        .x_px = box.x0_px + x,
                        .y_px = box.y0_px + y,
                        .z = depth[at],
                        .primitive = primitive[at],
                        .surface = range_of(window, primitive[at])};
      const std::span<const float, kSamples> depths(sample_depth, kSamples);
      const std::span<const std::uint32_t, kSamples> primitives(sample_primitive, kSamples);
      if (!shows_one_place(pixel, depths, primitives))
        add_fragments(pixel, depths, primitives, window, out);
      sample_depth += kSamples, sample_primitive += kSamples;
    }
  }
}

}  // namespace

void prepare_edges(const RenderView& window, const VisibilityBuffer& visibility, int samples,
                   EdgeBuffer& edges) {
  edges.samples = samples;
  edges.of_tile.resize(static_cast<std::size_t>(visibility.grid.count()));
  for (std::vector<EdgeFragment>& fragments : edges.of_tile) fragments.clear();
  edges.parts.clear();
  if (samples == 0) return;
  for (const SurfaceKind kind : kAllSurfaces) {
    const std::span<const glm::vec4> p_clip = window.vertices_of(kind).p_clip;
    for (const DrawPart& part : window.draws[kind].parts) {
      const auto [tiles, nearest_z] = extent_of(p_clip.subspan(part.first_vertex, part.vertices),
                                                window.viewport(), visibility.grid);
      const std::uint32_t begin = window.primitives.begin(kind) + part.first_triangle;
      edges.parts.push_back({tiles, nearest_z, begin, begin + part.triangles});
    }
  }
}

void find_edges(const RenderView& window, const VisibilityBuffer& visibility, int tile,
                EdgeScratch& scratch, EdgeBuffer& edges) {
  if (edges.samples == 0 || visibility.covered[static_cast<std::size_t>(tile)] < 0) return;
  const raster::PixelMask mask =
      mark_pixels(window, visibility, edges.parts, tile, scratch.discontinuities);
  const auto samples =
      static_cast<std::size_t>(mask.count()) * static_cast<std::size_t>(edges.samples);
  if (samples == 0) return;
  scratch.depth.resize(samples);
  scratch.primitive.resize(samples);
  raster::draw_samples(window.pass, tile, mask, scratch.depth, scratch.primitive);
  if (window.land)
    cast_land_samples(window, raster::tile_box(window.viewport(), visibility.grid, tile),
                      edges.samples, mask, scratch.depth, scratch.primitive);
  draw_implicit_samples(window.implicits,
                        raster::tile_box(window.viewport(), visibility.grid, tile), edges.samples,
                        mask, scratch.depth, scratch.primitive);
  std::vector<EdgeFragment>& fragments = edges.of_tile[static_cast<std::size_t>(tile)];
  if (edges.samples == 8)
    sort_samples<8>(window, visibility, tile, mask, scratch, fragments);
  else
    sort_samples<4>(window, visibility, tile, mask, scratch, fragments);
}

}  // namespace swell::render
