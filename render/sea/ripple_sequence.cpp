#include "render/sea/ripple_sequence.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "ocean/open_sea/sea_state.h"
#include "ocean/open_sea/small_sea.h"
#include "scene/check_scene.h"
#include "scene/file/parameters.h"

namespace swell::render {
namespace {

// Fixed, so that codes do not flicker: five standard deviations.
constexpr float kSlopeScale = 5.0f * 0.7071068f * texture::kBumpSlope / 127.0f;

ocean::SmallSea small_sea(const scene::Scene& scene) {
  ocean::SmallSea sea;
  sea.length_m = scene.ripples.length_m;
  sea.loop_s = scene.ripples.loop_s;
  sea.frames = scene.ripples.frames;
  sea.wind_from_rad = scene.sea.wind_from_rad;
  sea.gravity_mps2 = scene.sea.gravity_mps2;
  sea.seed = scene.sea.seed;
  return sea;
}

texture::BumpSequence make_own_sequence(const ocean::SmallSea& sea, Workers& workers) {
  std::vector<texture::ImageF> frames;
  for (std::vector<float>& heights : ocean::small_sea_heights(sea, workers))
    frames.push_back({sea.size, sea.size, 1, std::move(heights)});
  return texture::make_bump_sequence(frames);
}

}  // namespace

texture::BumpSequence build_ripple_sequence(const scene::Scene& scene, Workers& workers) {
  const scene::Ripples& ripples = scene.ripples;
  if (ripples.sequence.empty()) return make_own_sequence(small_sea(scene), workers);
  std::string key = "ripples.sequence";
  try {
    texture::BumpSequence sequence = texture::read_bump_sequence(
        ripples.sequence, ripples.frames,
        ripples.pictures == scene::RipplePictures::kNormals ? texture::BumpPictures::kNormals
                                                            : texture::BumpPictures::kHeights);
    key = "ripples.detail";
    if (!ripples.detail.empty()) texture::read_bump_details(ripples.detail, sequence);
    return sequence;
  } catch (const std::runtime_error& error) {
    throw scene::SceneError(scene::one_line(
        fmt::format("{}: {}: {}", scene::place_of_key(scene, key), key, error.what())));
  }
}

double ripple_loop_part(const scene::Scene& scene, double t_s) {
  ocean::SeaDescription loop = scene.sea;
  double loops = 1.0;
  if (loop.loop_s == 0.0)
    loop.loop_s = scene.ripples.loop_s;
  else
    loops = std::max(1.0, std::nearbyint(loop.loop_s / scene.ripples.loop_s));
  const double part = loops * (ocean::wave_time_s(loop, t_s) / loop.loop_s);
  // Times that are whole loops apart differ by rounding: they have the same frame in 2^-16.
  const double steps = std::nearbyint((part - std::floor(part)) * scene.ripples.frames * 0x1p16);
  return std::min(steps * 0x1p-16 / scene.ripples.frames, 1.0);
}

void pack_ripples(const scene::Scene& scene, const texture::BumpSequence& sequence, double t_s,
                  RippleMaps& maps) {
  texture::blend_frames(sequence, ripple_loop_part(scene, t_s), maps.frame);
  const texture::BumpFrame& frame = maps.frame;
  texture::pack_map2(sequence.size, frame.slope_x, frame.slope_y, kSlopeScale, maps.slopes);
  if (scene.ripples.lighting == scene::RippleLighting::kPaper)
    pack_tint(sequence.size, frame.detail, maps.detail);
}

}  // namespace swell::render
