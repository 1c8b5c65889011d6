// The sea floor and the land: heights on a square, from a height image, from a coast line or from
// noise. From noise, the border of the square is the deep floor. Beyond the square the ground goes
// on and sinks into the sea (terrain/apron.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "math/parallel.h"
#include "terrain/height_grid.h"

namespace swell::terrain {

// What is wrong with a description or its height image: what() is one line, 'WHERE, got what,
// allowed what', WHERE a key as scenes have it or 'FILE: what'.
struct TerrainError : std::runtime_error {
  explicit TerrainError(const std::string& of_file) : std::runtime_error(of_file) {}
  TerrainError(const std::string& of_key, const std::string& has, const std::string& may)
      : std::runtime_error(of_key + ", got " + has + ", allowed " + may),
        key(of_key),
        got(has),
        allowed(may) {}

  std::string key, got, allowed;  // empty: what a file holds is wrong
};

// What the land is made of above the beach. Colours are linear reflectances.
struct GroundMaterials {
  glm::vec3 sand{0.63f, 0.555f, 0.415f};
  glm::vec3 grass{0.066f, 0.094f, 0.028f};
  glm::vec3 dry{0.235f, 0.195f, 0.085f};  // reeds by the beach, straw on the hills
  glm::vec3 soil{0.175f, 0.125f, 0.082f};
  glm::vec3 rock{0.215f, 0.20f, 0.18f};
  double grass_from_m = 2.2;  // height from which things grow
  double rock_slope = 0.75;   // rise over way from which rock shows

  bool operator==(const GroundMaterials&) const = default;
};

struct TerrainDescription {
  // From a square image (grey or first channel, north on top, at most 4096 x 4096): PNG, PNM and
  // TIFF have height = low_m + value * (high_m - low_m), EXR and HDR metres; then minus
  // sea_level_m.
  std::filesystem::path height_image = {};  // empty: islands from noise
  double metres_per_pixel = 2.0;
  double low_m = -20.0, high_m = 40.0;
  double sea_level_m = 0.0;
  glm::dvec2 centre_m{0.0};
  // From noise: one island of this radius on a floor of this depth, with shallow water around it.
  double island_radius_m = 180.0;
  double island_height_m = 35.0;
  double floor_depth_m = 14.0;
  // More than one: the largest is that one, and they lie on a square of this side, anywhere.
  int islands = 1;
  double archipelago_size_m = 40000.0;
  // From a coast line of two points or more, the sea on the left when walking from the first to the
  // last (terrain/sea_floor.h): a beach of one slope on a square around centre_m, down to
  // floor_depth_m; on land the slope goes on up to dunes of less than 8 m.
  std::vector<glm::dvec2> coast_m = {};  // empty: not used; excludes height_image
  double beach_slope = 0.02;
  double beach_size_m = 1200.0;  // the square's side
  std::uint64_t seed = 3;        // of the island or of the dunes
  double checker_m = 0.0;        // side of white and black squares laid over the ground; 0: none
  // The next two are for land that rays find.
  bool bicubic = false;                  // between samples; false: bilinear
  std::optional<double> outline_m = {};  // what is lower is not there
  // The water boundary, read from a file (terrain/boundary.h); empty: made from the heights.
  std::filesystem::path boundary = {};
  // Whether the heights themselves are those of that file; needs one.
  bool ground_from_boundary = false;
  GroundMaterials ground = {};

  bool operator==(const TerrainDescription&) const = default;
};

// Images are at most this many pixels a side.
inline constexpr int kMaxImageSide = 4096;

// The side of the square that build_terrain() makes; none for images, whose size is in the file.
std::optional<double> described_size_m(const TerrainDescription& description);

// A square of heights with an apron, lowest_m and highest_m set: 1025 samples a side from noise
// (2049 with several islands), 513 from a coast line, the image's side from images, where one pixel
// makes a flat square of 2 x 2; of a finer boundary, whose heights they are, as many as that has.
// Rows go northwards. The same bits with any threads; without workers on one. Throws TerrainError
// (bad values) or texture::FileError (bad image).
HeightGrid build_terrain(const TerrainDescription& description, Workers& workers);
HeightGrid build_terrain(const TerrainDescription& description);

}  // namespace swell::terrain
