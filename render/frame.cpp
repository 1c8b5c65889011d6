#include "render/frame.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>

namespace swell::render {

struct World::State {
  scene::Scene scene;
};
World::World(scene::Scene scene) : state_(std::make_unique<State>(State{std::move(scene)})) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
const scene::Scene& World::scene() const { return state_->scene; }

struct Workspace::State {};
Workspace::Workspace() : state_(std::make_unique<State>()) {}
Workspace::~Workspace() = default;
Workspace::Workspace(Workspace&&) noexcept = default;
Workspace& Workspace::operator=(Workspace&&) noexcept = default;

std::string_view stage_name(Stage stage) {
  constexpr std::string_view kNames[] = {"sea",        "triangulate", "displace",
                                         "visibility", "lookups",     "shade"};
  return kNames[static_cast<std::size_t>(stage)];
}

FrameStatistics render_frame(const World&, const View& view, double, const FrameOptions&,
                             Workspace&, Target& target, Workers&) {
  target.width_px = view.width_px;
  target.height_px = view.height_px;
  target.rgba.assign(static_cast<std::size_t>(view.width_px) * view.height_px, 0xff806040u);
  return {};
}

std::uint64_t picture_hash(const Target& target) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(target.rgba.size() * 3);
  for (const std::uint32_t p : target.rgba)
    for (int c = 0; c < 3; ++c) rgb.push_back(static_cast<std::uint8_t>(p >> (8 * c)));
  return XXH3_64bits(rgb.data(), rgb.size());
}

}  // namespace swell::render
