// A flat floor under shallow water, for tests of the light that falls on it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "scratch_folder.h"
#include "texture/image/image_io.h"

namespace swell::render {

// With a folder for its height image, and for more.
class FlatFloor : public testing::Test {
 protected:
  FlatFloor() { write("floor.png", {2, 2, 1, std::vector<std::uint8_t>(4, 0)}); }

  void write(const std::string& name, const texture::Image8& image) const {
    texture::write_file(folder_ / name, texture::encode_image(image, ".png"));
  }

  // Under a breeze, whose waves are so many times as high as usual, and a sun straight above.
  scene::Scene flat_floor(double depth_m, double waves) const {
    scene::Scene scene;
    scene.terrain = scene::TerrainDescription{};
    scene.terrain->height_image = folder_ / "floor.png";
    scene.terrain->metres_per_pixel = 500.0;
    scene.terrain->low_m = -depth_m;
    scene.terrain->high_m = -0.5 * depth_m;
    scene.sky.sun_elevation_rad = radians(90.0);
    scene.sky.sun_direction = {0.0f, 0.0f, 1.0f};
    scene.sky.cloud_cover = 0.0;
    scene.sea.wind_speed_mps = 4.0;
    scene.sea.patch_lengths_m = {97.0, 23.0, 5.3};
    scene.sea.resolution = 128;
    scene.sea.amplitude_scale = waves;
    scene.water.distortion = 0.0;
    scene.water.lookup_scale = 1.0;
    return scene;
  }

  const ScratchFolder scratch_;
  const std::filesystem::path folder_ = scratch_.path();
};

}  // namespace swell::render
