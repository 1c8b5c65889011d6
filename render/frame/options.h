// What a caller asks of a frame.
#pragma once

#include <optional>
#include <span>

#include "math/view.h"
#include "render/frame/parts.h"
#include "render/labels/labels.h"
#include "scene/scene.h"

namespace swell::render {

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
  // with keep_linear, which is for pictures that are kept, nor of wide views.
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
  bool wireframe = false;    // triangle edges, tinted by level of detail; not of wide views
  bool keep_linear = false;  // fill Target::linear
  bool is_face = false;      // of a wide picture: keep_linear leaves the shading as it is
  // Samples a pixel where surfaces meet, 0, 4 or 8; below 0: the scene's. Labels do not change.
  int edge_samples = -1;
  // (A, B, C, D) of a plane in the world: of all surfaces, in the window, the mirror and under
  // water, only what lies where A x + B y + C z + D >= 0 is drawn. Finite, (A, B, C) not 0.
  // Shadows, queries, and whether the eye is in water stay those of the whole world.
  std::optional<glm::dvec4> clip_plane = {};
  // Which pixels are shaded; none: as the scene says. With keep_linear all are.
  std::optional<scene::ShadingRate> shading = {};
  // What multiplies radiance [10 000 cd/m^2; of a gradient: its unit] in the picture, over 0, as
  // scene::camera_exposure() has it; Target::linear is light so exposed then. None: that of the
  // scene's camera, if it has an f-number, else what follows from the sky.
  std::optional<double> exposure = {};
  // The noise of the picture's sensor; none: as the scene says. Every pixel is shaded for it.
  std::optional<scene::SensorNoise> noise = {};
  PartSet without = {};  // leave these parts of the picture out
  LabelSet labels = {};  // fill these of Target::labels; not with picture_scale below 1
  // For the label of motion: the camera of the next frame, of the same size, and how much later it
  // is, over 0.
  std::optional<View> next_view = {};  // none: as this frame's
  double next_frame_s = 1.0 / 60.0;
  // Where the scene's shutter is open for several moments (camera.shutter_samples): the camera in
  // each, the frame's own first, all of one size. Empty: it stands still. Read during the call
  // only.
  std::span<const View> exposed_views = {};
  // Objects that the caller puts where he likes in this frame (at most one pose an object; aborts
  // unless scene::check_given_poses() passes them), and for the label of motion in the next one.
  // Read during the call only.
  std::span<const scene::GivenPose> poses = {}, next_poses = {};
  // What disturbs the water besides the scene's own list: of its values
  // (ocean/wakes/disturbance.h), with two points or more in a hull's path. Read during the call
  // only.
  std::span<const ocean::Disturbance> disturbances = {};
};

// The options with the scene's own numbers in place of zeros.
FrameOptions with_scene_defaults(const FrameOptions& options, const scene::Scene& scene);

}  // namespace swell::render
