#include "tools/figures/wave_figures.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/elementary.h"
#include "ocean/spectrum/sea_scale.h"

namespace swell::apps {
namespace {

using Rgb = glm::dvec3;  // sRGB bytes

constexpr Rgb kBlack{6, 22, 46}, kWhite{244, 249, 250};
constexpr Rgb kDeepWater{34, 98, 142}, kShallowWater{84, 172, 166};
constexpr Rgb kBeach{222, 206, 164}, kHill{142, 152, 104};

texture::Image8 empty_picture(int size_px) {
  return {size_px, size_px, 3, std::vector<std::uint8_t>(std::size_t{3} * size_px * size_px)};
}

void set_pixel(texture::Image8& image, int x, int y, Rgb colour) {
  for (int c = 0; c < 3; ++c) {
    const double byte = std::clamp(std::floor(colour[c] + 0.5), 0.0, 255.0);
    image.pixels[3 * (std::size_t(y) * image.width + x) + c] = static_cast<std::uint8_t>(byte);
  }
}

// Black at 0, `middle` at 1/2, white at 1.
Rgb ramp(Rgb middle, double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t < 0.5 ? glm::mix(kBlack, middle, 2.0 * t) : glm::mix(middle, kWhite, 2.0 * t - 1.0);
}

// The surface in the middles of a map's pixels.
struct MapFields {
  std::vector<glm::dvec2> p_world;
  std::vector<float> height_m, depth_m;  // depth of the floor below mean sea level
  std::vector<glm::dvec2> slope;
};

// Fills `slope` with differences over two pixels: waves shorter than that are no use in a map.
void take_slopes(MapFields& map, const MapView& view) {
  const int last = view.size_px - 1;
  const double pixel_m = view.side_m / view.size_px;
  const auto z = [&](int x, int y) {
    return double{map.height_m[std::size_t(y) * view.size_px + x]};
  };
  for (int y = 0; y <= last; ++y) {
    for (int x = 0; x <= last; ++x) {
      const int west = std::max(x - 1, 0), east = std::min(x + 1, last);
      const int north = std::max(y - 1, 0), south = std::min(y + 1, last);
      map.slope.push_back({(z(east, y) - z(west, y)) / ((east - west) * pixel_m),
                           (z(x, north) - z(x, south)) / ((south - north) * pixel_m)});
    }
  }
}

MapFields sample_map(const scene::WaterSurface& surface, const terrain::HeightGrid* terrain,
                     const MapView& view) {
  MapFields map;
  const double pixel_m = view.side_m / view.size_px, middle = 0.5 * view.size_px;
  for (int y = 0; y < view.size_px; ++y)
    for (int x = 0; x < view.size_px; ++x)
      map.p_world.push_back(view.centre_m +
                            pixel_m * glm::dvec2(x + 0.5 - middle, middle - y - 0.5));
  map.height_m.resize(map.p_world.size());
  map.depth_m.assign(map.p_world.size(), HUGE_VALF);
  surface.heights(map.p_world, map.height_m);
  take_slopes(map, view);
  if (!terrain) return map;
  terrain::sample_heights(*terrain, map.p_world, map.depth_m);
  for (float& depth : map.depth_m) depth = -depth;
  return map;
}

// Over the water; never 0.
struct MapScale {
  double rms_height_m = 1e-9, rms_slope = 1e-9;
};

MapScale scale_of(const MapFields& map) {
  double heights = 0.0, slopes = 0.0, count = 0.0;
  for (std::size_t i = 0; i < map.slope.size(); ++i) {
    if (map.depth_m[i] <= 0.0f) continue;
    heights += double{map.height_m[i]} * map.height_m[i];
    slopes += glm::dot(map.slope[i], map.slope[i]);
    ++count;
  }
  if (count == 0.0) return {};
  return {std::max(std::sqrt(heights / count), 1e-9), std::max(std::sqrt(slopes / count), 1e-9)};
}

// 0 on land and in less than a metre, 1 from 1 m, 2 from 2 m, 3 from 4 m, ...
int depth_step(float depth_m) {
  if (depth_m < 1.0f) return 0;
  return std::isfinite(depth_m) ? std::ilogb(depth_m) + 1 : 1000;
}

bool on_depth_line(const MapFields& map, int x, int y, int size_px) {
  const std::size_t at = std::size_t(y) * size_px + x;
  const int step = depth_step(map.depth_m[at]);
  return (x + 1 < size_px && depth_step(map.depth_m[at + 1]) != step) ||
         (y + 1 < size_px && depth_step(map.depth_m[at + size_px]) != step);
}

Rgb map_colour(const MapFields& map, std::size_t at, glm::dvec2 to_light, MapScale scale) {
  const double depth = map.depth_m[at];
  if (depth <= 0.0) return glm::mix(kBeach, kHill, std::min(1.0, -depth / 12.0));
  const double high = map.height_m[at] / scale.rms_height_m;
  const double lit = -glm::dot(map.slope[at], to_light) / scale.rms_slope;
  const double shallow = 4.0 / (4.0 + depth);
  return ramp(glm::mix(kDeepWater, kShallowWater, shallow), 0.5 + 0.13 * high + 0.1 * lit);
}

}  // namespace

texture::Image8 draw_filter(const ocean::WaveSystem& wind, int size_px) {
  const double k_m = 2.0 * kPi / ocean::peak_wavelength_m(wind);
  const double pixel = 6.0 * k_m / size_px, middle = 0.5 * size_px;
  const auto k_at = [&](int x, int y) {
    return pixel * glm::dvec2(x + 0.5 - middle, middle - y - 0.5);
  };
  // The filter's values, to be scaled by the largest.
  std::vector<double> gain;
  for (int y = 0; y < size_px; ++y)
    for (int x = 0; x < size_px; ++x)
      gain.push_back(std::sqrt(ocean::wave_vector_spectrum(wind, k_at(x, y))));
  const double most = *std::ranges::max_element(gain);
  texture::Image8 image = empty_picture(size_px);
  for (int y = 0; y < size_px; ++y) {
    for (int x = 0; x < size_px; ++x) {
      const double k = glm::length(k_at(x, y));
      const bool ring = std::abs(k - k_m) < 0.5 * pixel || std::abs(k - 2.0 * k_m) < 0.5 * pixel;
      const Rgb colour = ramp(kDeepWater, gain[std::size_t(y) * size_px + x] / most);
      set_pixel(image, x, y, ring ? glm::mix(colour, kWhite, 0.5) : colour);
    }
  }
  return image;
}

texture::Image8 draw_map(const scene::WaterSurface& surface, const terrain::HeightGrid* terrain,
                         const MapView& view) {
  const MapFields map = sample_map(surface, terrain, view);
  const MapScale scale = scale_of(map);
  texture::Image8 image = empty_picture(view.size_px);
  for (int y = 0; y < view.size_px; ++y) {
    for (int x = 0; x < view.size_px; ++x) {
      const std::size_t at = std::size_t(y) * view.size_px + x;
      const Rgb colour = map_colour(map, at, view.to_light, scale);
      const bool line = terrain && on_depth_line(map, x, y, view.size_px);
      set_pixel(image, x, y, line ? glm::mix(colour, kBlack, 0.6) : colour);
    }
  }
  return image;
}

}  // namespace swell::apps
