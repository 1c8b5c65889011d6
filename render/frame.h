// Drawing a frame: the library's main entry.
//
//   swell::Workers workers(2);
//   swell::render::World world(swell::scene::load_scene("open_ocean.toml"));
//   swell::render::Workspace workspace;
//   swell::render::Target target;
//   swell::ocean::SeaFrame sea;
//   const auto view = world_view(world, t_s, 1280, 720, sea, workers);  // world_view.h
//   swell::render::render_frame(world, view, t_s, {}, workspace, target, workers);
//   // target.rgba: 1280 * 720 pixels, R in the low byte
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "math/enum_table.h"
#include "math/parallel.h"
#include "math/view.h"
#include "render/labels/labels.h"
#include "render/parts.h"
#include "scene/scene.h"

namespace swell::render {

// The stages of a frame, in order: rows of the profile, the bench table and the trace.
enum class Stage : std::uint8_t {
  kSea,          // advance the waves, make their maps
  kTriangulate,  // adapt the triangulations
  kDisplace,     // displace vertices, transform them
  kTrees,        // choose which trees are drawn, and place them
  kVisibility,   // clip, set up, bin, find what is visible
  kRays,         // rays to forms and to land without triangles
  kPlanarMaps,   // reflection and refraction images
  kClouds,       // rays through volumetric clouds
  kShade,        // shade and resolve every visible pixel once; labels
};
inline constexpr std::size_t kStages = kEnumerators<Stage>;
std::string_view stage_name(Stage stage);  // "sea", "triangulate", ...

// A scene made ready to draw: sea state, terrain, static maps. Read-only while frames are drawn;
// several threads may draw the same World with a Workspace each. One that was moved from may only
// be assigned to or destroyed; whatever else is done with it aborts with a message.
class World {
 public:
  // Builds the same bits with any number of threads, in [1, 256]. Throws scene::SceneError (a value
  // out of its range, as for files), texture::FileError (a height image), or std::runtime_error if
  // there are not so many threads to be had.
  explicit World(scene::Scene scene, int threads = available_cpus());

  // Builds the same bits sooner: what both scenes describe alike (sky, sea, terrain with its maps,
  // coast) is shared with `like`, and height images are not read again. On `threads` threads; with
  // another wind alone 20 ms, 200 ms more for the trains of a coast.
  World(scene::Scene scene, const World& like, int threads);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;
  const scene::Scene& scene() const;

  struct State;
  const State& state() const;

 private:
  std::unique_ptr<State> state_;
};

inline constexpr int kMostTriangles = 1'000'000;

// Values outside the ranges are refused by render_frame.
struct FrameOptions {
  int tile_size_px = 64;      // 16, 32 or 64; changes no pixel
  int water_triangles = 0;    // [2, kMostTriangles]; 0: the scene's
  int terrain_triangles = 0;  // the same
  double lookup_scale = 0.0;  // [0.01, 1]; 0: the scene's
  // Far vertices of the sea leave out waves that move them by less than this, at most 8; 0: they
  // leave out none, below 0: the scene's.
  double background_error_px = -1.0;
  // The picture is drawn at this share of the view's size each way, in (0, 1], and enlarged. Not
  // with keep_linear, which is for pictures that are kept.
  double picture_scale = 1.0;
  // Storage for so many triangles of each surface at once: a later frame that asks for more than
  // any before, but no more than this, need not build its triangulation anew; at most
  // kMostTriangles. Changes no pixel.
  int triangle_capacity = 0;
  // Bounds on triangulating each surface in one frame, 0: none; the most important is done first,
  // the rest in the frames after. Pictures then depend on the frames before them: for viewers.
  int lod_operations = 0;    // splits and merges
  double lod_ms = 0.0;       // time
  int lod_groups = 1;        // of priorities, one of which is worked out anew
  bool wireframe = false;    // triangle edges, tinted by level of detail
  bool keep_linear = false;  // fill Target::linear
  // Samples a pixel where surfaces meet, 0, 4 or 8; below 0: the scene's. Labels do not change.
  int edge_samples = -1;
  // (A, B, C, D) of a plane in the world: of all surfaces, in the window, the mirror and under
  // water, only what lies where A x + B y + C z + D >= 0 is drawn. Finite, (A, B, C) not 0.
  // Shadows, queries, and whether the eye is in water stay those of the whole world.
  std::optional<glm::dvec4> clip_plane = {};
  PartSet without = {};  // leave these parts of the picture out
  LabelSet labels = {};  // fill these of Target::labels; not with picture_scale below 1
  // For the label of motion: the camera of the next frame, of the same size, and how much later it
  // is, over 0.
  std::optional<View> next_view = {};  // none: as this frame's
  double next_frame_s = 1.0 / 60.0;
  // Objects that the caller puts where he likes in this frame (at most one pose an object; aborts
  // unless scene::check_given_poses() passes them), and for the label of motion in the next one.
  // Read during the call only.
  std::span<const scene::GivenPose> poses = {}, next_poses = {};
  // What disturbs the water besides the scene's own list: of its values (ocean/disturbance.h), with
  // two points or more in a hull's path. Read during the call only.
  std::span<const ocean::Disturbance> disturbances = {};
};

// The options with the scene's own numbers in place of zeros.
FrameOptions with_scene_defaults(const FrameOptions& options, const scene::Scene& scene);

// The finished picture. Sized by render_frame; capacity is kept.
struct Target {
  int width_px = 0, height_px = 0;
  std::vector<std::uint32_t> rgba;  // 8-bit sRGB, R in the low byte, alpha 255; row by row
  std::vector<float> linear;        // RGB linear light before the tone curve, if asked for
  Labels labels;                    // as asked for
};

struct FrameStatistics {
  std::array<double, kStages> stage_ms{};
  double frame_ms = 0.0;
  int water_triangles = 0, terrain_triangles = 0;
  int object_triangles = 0;  // of those that the view may show
  int splits = 0, merges = 0;
  bool lod_stopped = false;          // at one of the bounds, with work left
  std::uint64_t visible_pixels = 0;  // pixels that show water, terrain or an object
  std::uint64_t shaded_pixels = 0;   // surface shader runs; equal to visible_pixels
};

// What happened when, for --trace: one row per stage and thread.
struct TraceEvent {
  Stage stage;
  int thread;               // worker slot
  double start_us, end_us;  // since the frame's start
};

// Everything that is reused from frame to frame: a cache, never an input. One frame at a time. One
// that was moved from: as a World.
class Workspace {
 public:
  Workspace();
  ~Workspace();
  Workspace(Workspace&&) noexcept;
  Workspace& operator=(Workspace&&) noexcept;

  struct State;
  State& state();
  const State& state() const;
  // The trace is that of the last frame; it is empty unless trace_enabled was set before that
  // frame.
  bool trace_enabled = false;
  std::vector<TraceEvent> trace;

 private:
  std::unique_ptr<State> state_;
};

// Draws the world at time t_s. The picture depends on (world, view, t_s, options) alone: any
// worker count, SIMD target, tile size and history give the same bits. Aborts with a message where
// the view has no size in [1, 8192] x [1, 8192], is not finite or its axes are no unit vectors,
// where t_s is not finite, and where an option lies outside its range.
FrameStatistics render_frame(const World& world, const View& view, double t_s,
                             const FrameOptions& options, Workspace& workspace, Target& target,
                             Workers& workers);

// XXH3-64 of the picture's RGB bytes, row by row.
std::uint64_t picture_hash(const Target& target);

}  // namespace swell::render
