// What the handles of swell.h stand for.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "math/parallel.h"
#include "math/view.h"
#include "ocean/below_frame.h"
#include "ocean/open_sea/sea.h"
#include "ocean/open_sea/whitecaps.h"
#include "ocean/velocity.h"
#include "render/frame.h"
#include "render/measure/lidar.h"
#include "render/measure/pick.h"
#include "swell.h"

namespace swell::capi {

// A world with the texts that its handle gives out.
struct NamedWorld {
  NamedWorld(scene::Scene scene, const render::WorldMaking& making);

  render::World world;
  std::string text;                      // scene::dump_scene
  std::vector<std::string> class_names;  // by class
  std::vector<std::uint32_t> object_classes;
};

// A frame is kept with its time; t_s empty: there is none yet.
template <class Frame>
struct AtTime {
  std::optional<double> t_s;
  Frame frame;
};

}  // namespace swell::capi

struct swell_world {
  std::shared_ptr<const swell::capi::NamedWorld> named;
};

struct swell_session {
  swell_session(std::shared_ptr<const swell::capi::NamedWorld> of, int threads)
      : named(std::move(of)), workers(threads) {}

  std::shared_ptr<const swell::capi::NamedWorld> named;
  swell::Workers workers;
  swell::render::Workspace workspace;
  swell::render::Workspaces workspaces;   // of several frames at once
  std::optional<swell::View> drawn_view;  // of the workspace's last frame
  swell::render::PickScratch pick_scratch;
  swell::ocean::SeaFrame camera_sea;  // for cameras that objects carry
  // For what is asked.
  swell::capi::AtTime<swell::ocean::SeaFrame> sea;
  swell::capi::AtTime<swell::ocean::VelocityFrame> velocity;
  swell::capi::AtTime<swell::ocean::WhitecapFrame> whitecaps;
  std::unique_ptr<swell::render::Lidar> lidar;  // once one is asked for
  swell::capi::AtTime<swell::ocean::BelowFrame> below;
  std::atomic_flag busy{};
};

struct swell_picture {
  swell::render::Target target;
  std::optional<swell::View> view;  // none: nothing has been drawn
  // Of labels that follow from the depth, once they are asked for.
  std::array<std::vector<float>, swell::render::kLabelCount> lengths;
  std::array<std::vector<glm::dvec3>, swell::render::kLabelCount> places;
  std::atomic_flag busy{};
};
