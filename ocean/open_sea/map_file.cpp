// Files of periodic maps.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "ocean/open_sea/map_statistics.h"
#include "ocean/open_sea/periodic_map.h"

namespace swell::ocean {
namespace {

constexpr std::array<std::uint8_t, 8> kMagic = {'S', 'W', 'E', 'L', 'L', 'M', 'A', 'P'};
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeaderBytes = 8 + 4 * 4 + 3 * 8;

static_assert(std::endian::native == std::endian::little);

template <class T>
void put(T value, std::vector<std::uint8_t>& bytes) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof(T));
  std::memcpy(bytes.data() + at, &value, sizeof(T));
}

// Takes values off the front of bytes that are long enough.
template <class T>
T take(std::span<const std::uint8_t>& bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof(T));
  bytes = bytes.subspan(sizeof(T));
  return value;
}

[[noreturn]] void fail(const std::string& name, const std::string& got,
                       const std::string& allowed) {
  throw std::invalid_argument(fmt::format("{}: map file, got {}, allowed {}", name, got, allowed));
}

void take_codes(std::size_t count, int bits, std::span<const std::uint8_t>& bytes,
                std::vector<std::int16_t>& codes) {
  codes.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    codes.push_back(bits == 8 ? take<std::int8_t>(bytes) : take<std::int16_t>(bytes));
}

// Sizes and numbers of a header that make sense.
PeriodicMap take_header(std::span<const std::uint8_t>& bytes, const std::string& name) {
  if (bytes.size() < kHeaderBytes || !std::equal(kMagic.begin(), kMagic.end(), bytes.begin()))
    fail(name, "another kind of file", "one of swell-bench waves --make-map");
  bytes = bytes.subspan(kMagic.size());
  if (const auto version = take<std::uint32_t>(bytes); version != kVersion)
    fail(name, fmt::format("version {}", version), fmt::format("version {}", kVersion));
  const auto size = take<std::uint32_t>(bytes), frames = take<std::uint32_t>(bytes);
  const auto bits = take<std::uint32_t>(bytes);
  if (!std::has_single_bit(size) || size < kMinMapSize || size > kMaxMapSize)
    fail(name, fmt::format("{} samples a side", size),
         fmt::format("powers of two from {} to {}", kMinMapSize, kMaxMapSize));
  if (frames < kMinMapFrames || frames > kMaxMapFrames ||
      std::size_t{frames} * size * size > kMaxMapSamples)
    fail(name, fmt::format("{} frames of {} x {}", frames, size, size),
         fmt::format("{} to {} frames, {} samples in all", kMinMapFrames, kMaxMapFrames,
                     kMaxMapSamples));
  if (bits != 8 && bits != 16) fail(name, fmt::format("{} bits a sample", bits), "8 or 16");
  PeriodicMap map;
  map.size = static_cast<int>(size), map.frames = static_cast<int>(frames);
  map.bits = static_cast<int>(bits);
  map.travel = take<double>(bytes);
  const auto height_scale = take<double>(bytes), slope_scale = take<double>(bytes);
  for (const double value : {map.travel, height_scale, slope_scale})
    if (!(value >= 1e-6 && value <= 1e6))
      fail(name, fmt::format("{} for its travel or a scale", value), "0.000001 to 1000000");
  map.height_scale = static_cast<float>(height_scale);
  map.slope_scale = static_cast<float>(slope_scale);
  return map;
}

}  // namespace

std::vector<std::uint8_t> encode_map(const PeriodicMap& map) {
  std::vector<std::uint8_t> bytes(kMagic.begin(), kMagic.end());
  put(kVersion, bytes);
  for (const int number : {map.size, map.frames, map.bits})
    put(static_cast<std::uint32_t>(number), bytes);
  put(map.travel, bytes);
  put(static_cast<double>(map.height_scale), bytes);
  put(static_cast<double>(map.slope_scale), bytes);
  for (const auto* codes : {&map.height, &map.slope_x, &map.slope_y})
    for (const std::int16_t code : *codes) {
      if (map.bits == 8)
        put(static_cast<std::int8_t>(code), bytes);
      else
        put(code, bytes);
    }
  return bytes;
}

PeriodicMap decode_map(std::span<const std::uint8_t> bytes, const std::string& name) {
  const std::size_t whole = bytes.size();
  PeriodicMap map = take_header(bytes, name);
  const std::size_t samples = map.frame_samples() * static_cast<std::size_t>(map.frames);
  const std::size_t expected = 3 * samples * static_cast<std::size_t>(map.bits / 8);
  if (bytes.size() != expected)
    fail(name, fmt::format("{} bytes", whole),
         fmt::format("{} for {} frames of {} x {}", kHeaderBytes + expected, map.frames, map.size,
                     map.size));
  for (auto* codes : {&map.height, &map.slope_x, &map.slope_y})
    take_codes(samples, map.bits, bytes, *codes);
  measure(map);
  if (map.variance <= 0.0 || map.slope_variance <= 0.0) fail(name, "a flat map", "one with waves");
  return map;
}

PeriodicMap read_map(const std::string& path) {
  constexpr std::size_t kMost = kHeaderBytes + 6 * kMaxMapSamples;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    fail(path, error ? error.message() : "not a file", "a readable map file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error || size > kMost)
    fail(path, fmt::format("{} bytes", size), fmt::format("at most {}", kMost));
  std::ifstream file(path, std::ios::binary);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file || file.gcount() != std::ssize(bytes)) fail(path, "a read error", "a readable file");
  return decode_map(bytes, path);
}

}  // namespace swell::ocean
