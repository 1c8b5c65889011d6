// The peer where Swell was built without EGL.
#include <stdexcept>

#include "tools/peer/peer.h"

namespace swell::apps {

struct Peer::State {};

Peer::Peer(int) {
  throw std::runtime_error(
      "peer: this program was built without OpenGL; install libegl-dev, libopengl-dev and "
      "libgl1-mesa-dri, and build it again");
}
Peer::~Peer() = default;
std::string Peer::renderer() const { return {}; }
std::string Peer::version() const { return {}; }
void Peer::take(const render::Workspace&) {}
void Peer::draw() {}
std::array<double, kPeerPasses> Peer::draw_by_pass() { return {}; }
void Peer::read(std::span<std::uint32_t>) const {}

}  // namespace swell::apps
