#include "tools/peer/peer.h"

namespace swell::apps {

std::string_view peer_pass_name(PeerPass pass) {
  using enum PeerPass;
  constexpr auto kNames = enum_words<PeerPass>({
      {kReflection, "reflection"},
      {kRefraction, "refraction"},
      {kVisible, "visible"},
      {kLand, "land"},
      {kWater, "water"},
      {kSky, "sky"},
  });
  return kNames[pass];
}

}  // namespace swell::apps
