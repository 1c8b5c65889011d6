// What a Workspace holds: what the stages of a frame write. Nothing here is an input of a later
// frame.
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "render/frame.h"
#include "render/frame/profile.h"
#include "render/picture/enlarge.h"
#include "render/picture/label_tables.h"
#include "render/picture/planar_maps.h"
#include "render/picture/shade_picture.h"
#include "render/picture/thread_scratch.h"
#include "render/sea/sea_maps.h"
#include "render/sky/sky_frame.h"
#include "render/tile/cloud_picture.h"
#include "render/tile/stored_fog.h"
#include "render/view/crossing.h"
#include "render/view/meshes.h"
#include "render/view/render_view.h"
#include "render/view/visibility.h"
#include "render/wide_frame.h"

namespace swell::render {

struct FrameState {
  Profile profile;
  SeaMaps own_sea;
  const SeaMaps* sea = &own_sea;  // of the frame's time; views of one time may share it
  SkyFrame sky;
  Meshes meshes;
  RenderView window;
  VisibilityBuffer visibility;
  EdgeBuffer edges;
  Crossing crossing;
  RiverMirrors river_mirrors;
  CloudPicture clouds;                      // volumetric ones, in the window
  StoredFog fog;                            // the same window's
  PlanarMaps planar_maps, wet_planar_maps;  // where the waterline crosses the picture, both
  ViewShading shading, wet_shading;         // of the window
  std::vector<ShadedPixels> shaded;         // per tile
  LabelTables labels;
  std::vector<std::unique_ptr<ThreadScratch>> scratch;
  Target small;   // the picture before it is enlarged
  Target moment;  // one of those whose light a picture adds up
  EnlargeTables enlarge;
  std::unique_ptr<Workspaces> of_faces;  // of wide views, once there is one
};

// What Workspaces hold: the sea at one time, and a workspace and its worker a thread.
struct MomentState {
  explicit MomentState(int threads) : workspaces(static_cast<std::size_t>(threads)) {
    while (alone.size() < workspaces.size()) alone.emplace_back(1);
  }

  Profile profile;
  SeaMaps sea;
  std::vector<Workspace> workspaces;
  std::deque<Workers> alone;
  std::deque<WideFrame> wide;  // one a request of a wide view
};

}  // namespace swell::render
