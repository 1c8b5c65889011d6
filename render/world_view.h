// The camera of a world's scene at a time, also where an object on the waves carries it.
//
//   ocean::SeaFrame sea;  // reused from frame to frame
//   const View view = render::world_view(world, t_s, 1280, 720, sea, workers);
//
// Where the caller puts the object that carries the camera:
//
//   options.poses = poses;
//   options.next_poses = next_poses;  // for the label of motion
//   const View view = render::world_view(world, t_s, options, {1280, 720}, sea, workers);
//   options.next_view = render::next_world_view(world, t_s, options, {1280, 720}, sea, workers);
#pragma once

#include <vector>

#include "math/parallel.h"
#include "math/view.h"
#include "ocean/open_sea/sea.h"
#include "render/frame.h"

namespace swell::render {

// The view of the scene's camera at t_s (finite) for a picture of at least 1 x 1 pixels. Where an
// object carries the camera it fills `sea` with the waves of that time, in as long as a frame's
// stage "sea" takes; else `sea` stays as it is.
View world_view(const World& world, double t_s, int width_px, int height_px, ocean::SeaFrame& sea,
                Workers& workers);

// The view of the scene's camera in a frame that is drawn with these options. The camera goes with
// the object that carries it: where the frame's poses put that object, which needs no waves, or
// where the waves and the frame's disturbances move it. Aborts unless scene::check_given_poses()
// passes the poses.
View world_view(const World& world, double t_s, const FrameOptions& options, glm::ivec2 size_px,
                ocean::SeaFrame& sea, Workers& workers);

// The view in the frame after that one, for FrameOptions::next_view: options.next_frame_s later,
// with options.next_poses.
View next_world_view(const World& world, double t_s, const FrameOptions& options,
                     glm::ivec2 size_px, ocean::SeaFrame& sea, Workers& workers);

// The views of the moments of such a frame, for FrameOptions::exposed_views; empty: there is one.
std::vector<View> exposed_views(const World& world, double t_s, const FrameOptions& options,
                                glm::ivec2 size_px, ocean::SeaFrame& sea, Workers& workers);

}  // namespace swell::render
