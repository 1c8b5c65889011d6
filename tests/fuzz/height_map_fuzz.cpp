// Height images and water boundaries: a letter for what the file is, a byte for the heights that it
// spans, then the file.
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "fuzz/expect.h"
#include "fuzz/scratch_parent.h"
#include "terrain/boundary.h"
#include "terrain/terrain.h"
#include "texture/image/image_io.h"

namespace swell::fuzz {
namespace {

void read_heights(const std::filesystem::path& file, double span_m) {
  const terrain::HeightGrid land = terrain::build_terrain(
      {.height_image = file, .metres_per_pixel = 0.5, .low_m = -span_m, .high_m = span_m});
  expect(land.height_m.size() == land.grid.size(), "a height map has all of its heights");
  expect(std::isfinite(land.lowest_m) && land.lowest_m <= land.highest_m,
         "a height map has a lowest height");
  expect(std::isfinite(terrain::height_at(land, {1.5, -1.5})), "there is a height everywhere");
}

// A slope of 2 x 2 samples.
terrain::HeightGrid small_land() {
  terrain::HeightGrid land{{.spacing_m = 10.0, .samples_x = 2, .samples_y = 2}, {-1, 1, -1, 1}};
  land.lowest_m = -1.0f, land.highest_m = 1.0f;
  return land;
}

void read_boundary(const std::filesystem::path& file) {
  static const terrain::HeightGrid land = small_land();
  const terrain::ShoreMap shore = terrain::read_boundary(file, land);
  expect(shore.height_m().size() == shore.grid().size(), "a boundary has all of its heights");
}

void read_file(std::span<const char> input) {
  static const ScratchFolder folder(scratch_parent());
  if (input.size() < 2) return;
  const char letter = input[0];
  const bool is_boundary = letter == 'b';
  const bool is_exr = is_boundary || letter == 'e';
  const char* const name = is_exr ? "map.exr" : letter == 'n' ? "map.pgm" : "map.png";
  const auto file = folder.write(name, std::string_view(input.begin() + 2, input.end()));
  try {
    if (is_boundary)
      read_boundary(file);
    else
      read_heights(file, static_cast<unsigned char>(input[1]));
  } catch (const texture::FileError&) {
  } catch (const terrain::TerrainError&) {
  }
}

}  // namespace
}  // namespace swell::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  swell::fuzz::read_file({reinterpret_cast<const char*>(data), size});
  return 0;
}
