// Files of periodic maps of waves.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "fuzz/expect.h"
#include "ocean/open_sea/periodic_map.h"

namespace swell::fuzz {
namespace {

void read_map(std::span<const std::uint8_t> bytes) {
  ocean::PeriodicMap map;
  try {
    map = ocean::decode_map(bytes, "map");
  } catch (const std::invalid_argument&) {
    return;
  }
  expect(map.height.size() == map.frame_samples() * static_cast<std::size_t>(map.frames),
         "a map has all of its samples");
  expect(std::isfinite(map.mean_wave_number()), "a map has a mean wave number");
  expect(ocean::encode_map(map).size() == bytes.size(), "a map is written as it was read");
}

}  // namespace
}  // namespace swell::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  swell::fuzz::read_map({data, size});
  return 0;
}
