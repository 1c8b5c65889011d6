// One pass over triangles: clip, set up, bin into tiles; then each tile finds, for every pixel,
// the nearest triangle. Knows nothing of materials: the result is a visibility buffer.
//
// Rules (docs/look_up/conventions.md): window x right, y down, pixel centres at +0.5; vertices snap
// to 1/256 px (round to nearest even); top-left fill rule; reversed-Z depth near/w, larger is
// nearer; of equal depths the first submitted triangle wins.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>

#include "math/parallel.h"

namespace swell::raster {

inline constexpr std::uint32_t kNoPrimitive = 0xFFFFFFFFu;
inline constexpr int kMaxViewport = 8192;

// Which triangles to leave out, by their winding in the window (y down).
enum class Cull : std::uint8_t { kNone, kClockwise, kCounterClockwise };

// By so many planes a draw may be cut, besides the view's own.
inline constexpr std::size_t kClipDistances = 2;
using ClipDistances = std::array<std::span<const float>, kClipDistances>;

// Triangles that share vertices by index. Spans are borrowed during prepare_pass only.
struct Draw {
  std::span<const glm::vec4> p_clip;       // x, y in [-w, w] visible, 0 <= z <= w, reversed-Z
  std::span<const std::uint32_t> indices;  // 3 per triangle, each < p_clip.size()
  // Each empty, or one per vertex: the part where all are >= 0 is kept. Linear over a triangle.
  ClipDistances clip_distance = {};
  std::uint32_t first_primitive = 0;  // triangle n is primitive first_primitive + n
  Cull cull = Cull::kNone;
};

struct Viewport {
  int width_px = 0, height_px = 0;  // each in [1, kMaxViewport]
};

struct PassStatistics {
  std::uint64_t submitted = 0;              // triangles
  std::uint64_t culled_outside = 0;         // wholly outside a clip plane or the viewport
  std::uint64_t culled_facing = 0;          // by Draw::cull
  std::uint64_t culled_degenerate = 0;      // zero area after snapping, or a NaN or infinite input
  std::uint64_t culled_between_pixels = 0;  // no pixel centre, and no sample, in the bounding box
  std::uint64_t clipped = 0;                // cut by the near, user or guard-band planes
  std::uint64_t set_up = 0;                 // triangles after clipping
  std::uint64_t set_up_for_samples = 0;     // of these, without a pixel centre in the bounding box
  std::uint64_t binned = 0;                 // (tile, triangle) pairs
};

// Storage of one pass, kept between frames so that a steady state allocates nothing.
class Pass {
 public:
  Pass();
  ~Pass();
  Pass(Pass&&) noexcept;
  Pass& operator=(Pass&&) noexcept;

  struct State;
  State& state() { return *state_; }
  const State& state() const { return *state_; }

 private:
  std::unique_ptr<State> state_;
};

// Clips, sets up and bins `draws`, in submission order. tile_size_px in {16, 32, 64}; it changes
// no pixel. Primitive numbers must not reach kNoPrimitive. `samples` in {0, 4, 8}: with 4 or 8 the
// pass keeps also what only samples can see, for the functions of raster/samples.h; draw_tile gives
// the same bits. The result is the same bits for any worker count.
void prepare_pass(std::span<const Draw> draws, Viewport viewport, int tile_size_px, Pass& pass,
                  Workers& workers, int samples = 0);

const PassStatistics& pass_statistics(const Pass& pass);

struct TileGrid {
  int tile_size_px = 0, tiles_x = 0, tiles_y = 0;
  int count() const { return tiles_x * tiles_y; }
  int tile_log2() const { return std::countr_zero(static_cast<unsigned>(tile_size_px)); }
};
TileGrid tile_grid(Viewport viewport, int tile_size_px);

// The pixels of a tile that lie in the viewport.
struct PixelBox {
  int x0_px, y0_px, width_px, height_px;
};
PixelBox tile_box(Viewport viewport, const TileGrid& grid, int tile);

// True if any triangle may touch the tile, or a sample in it. Tiles are numbered row by row from
// the top left.
bool tile_has_triangles(const Pass& pass, int tile);

// True if a triangle of draws that have primitives in [first_primitive, end_primitive) may touch
// the tile, or a sample in it.
bool tile_has_triangles(const Pass& pass, int tile, std::uint32_t first_primitive,
                        std::uint32_t end_primitive);

// Fills the tile's depth and primitive buffers, each tile_size_px^2 long, row by row (pixels
// outside the viewport too: as never covered). Pixels without a triangle get depth 0 and
// kNoPrimitive. Different tiles may be drawn by different threads at one time. Returns the number
// of covered pixels inside the viewport.
int draw_tile(const Pass& pass, int tile, std::span<float> depth,
              std::span<std::uint32_t> primitive);

}  // namespace swell::raster
