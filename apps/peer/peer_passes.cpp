#include "apps/peer/peer.h"

namespace swell::apps {

std::string_view peer_pass_name(PeerPass pass) {
  constexpr std::string_view kNames[] = {"reflection", "refraction", "visible",
                                         "land",       "water",      "sky"};
  return kNames[static_cast<std::size_t>(pass)];
}

}  // namespace swell::apps
