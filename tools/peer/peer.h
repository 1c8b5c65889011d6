// The peer: the frame that Swell drew, drawn again by OpenGL on Mesa's software rasterizer
// llvmpipe. Same meshes, maps, camera and light; what a program without a GPU would run otherwise.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "math/enum_table.h"
#include "render/frame.h"

namespace swell::apps {

// The passes of a frame, in order.
enum class PeerPass : std::uint8_t {
  kReflection,  // both planar maps; nothing without land and objects
  kRefraction,
  kVisible,  // objects, and where land and water are nearest
  kLand,
  kWater,
  kSky,
};
inline constexpr std::size_t kPeerPasses = kEnumerators<PeerPass>;
std::string_view peer_pass_name(PeerPass pass);  // "reflection", "refraction", ...

// Parts of the picture that the peer does not draw.
inline constexpr render::PartSet kPeerLacks = *render::parse_parts(
    "whitecaps,clouds,shadows,hulls,textures,caustics,sequence,sun-slide,image-blur,"
    "wakes,land-detail,fog,stars,volume-clouds,cloud-shadows,shelter,surf-fronts");

// On one thread, one at a time: OpenGL has one current context.
class Peer {
 public:
  // Draws with so many threads, in [1, 256]; llvmpipe takes at most 16. Before other threads start:
  // it sets environment variables. Throws std::runtime_error where OpenGL does not start, or Swell
  // was built without it.
  explicit Peer(int threads);
  ~Peer();
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  std::string renderer() const;  // OpenGL's own words
  std::string version() const;

  // Takes over what the workspace's last frame was drawn from, whose world still lives: uploads
  // vertices and maps, sets constants, compiles shaders where the scene needs others. Frames with
  // edge samples, wireframe or parts in kPeerLacks are drawn without.
  void take(const render::Workspace& workspace);

  // Draws the frame that was taken and waits until it is finished.
  void draw();

  // Draws it and waits after each pass; returns the ms of each.
  std::array<double, kPeerPasses> draw_by_pass();

  // The picture as Target::rgba: of the size that was taken.
  void read(std::span<std::uint32_t> rgba) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace swell::apps
