// The volumetric clouds over the sea as the blurred sky shows them.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

namespace swell::render {

struct StageRun;
struct VolumeClouds;

// The clouds over the sea as the blurred sky shows them (SkyMaps::soft): texels of kSide^2, of
// light and of the part that passes.
struct CloudSky {
  static constexpr int kSide = 64;
  bool any = false;
  static constexpr std::size_t kChannels = 4, kOpacity = 3;
  std::array<std::vector<float>, kChannels> texels;
};

// clouds: as seen from the sea's level under the eye. horizon, inv_haze_m, inv_haze_height_m:
// colour and density of the haze that far clouds are lost in.
struct CloudAir {
  glm::vec3 horizon{0.0f};
  float inv_haze_m = 0.0f, inv_haze_height_m = 0.0f;
};
void draw_cloud_sky(const VolumeClouds& clouds, const CloudAir& air, CloudSky& sky,
                    const StageRun& run);
void write_cloud_sky_row(const VolumeClouds& clouds, const CloudAir& air, int y, CloudSky& sky);

}  // namespace swell::render
