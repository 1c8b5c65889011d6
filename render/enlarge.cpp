#include "render/enlarge.h"

#include <algorithm>

#include "math/check.h"

namespace swell::render {
namespace {

using Tap = EnlargeTables::Tap;
constexpr int kRowsPerTask = 16;

// Between which samples of `from` the centre of sample i of `to` lies.
Tap tap_of(int i, int from, int to) {
  // Centres at +0.5: position (i + 0.5) from / to - 0.5 in 1/256 samples, rounded down.
  const std::int64_t fx8 =
      ((2 * static_cast<std::int64_t>(i) + 1) * from * 128) / to - 128;  // below 2^22
  const std::int64_t clamped = std::clamp<std::int64_t>(fx8, 0, 256 * (from - 1));
  const auto first = static_cast<std::uint16_t>(clamped >> 8);
  return {first, static_cast<std::uint16_t>(std::min<int>(first + 1, from - 1)),
          static_cast<std::uint16_t>(clamped & 255)};
}

void prepare(PictureExtent from, PictureExtent to, int threads, EnlargeTables& tables) {
  tables.rows.resize(static_cast<std::size_t>(threads));
  for (auto& row : tables.rows) row.resize(static_cast<std::size_t>(from.width_px));
  if (tables.from == from && tables.to == to) return;
  tables.from = from, tables.to = to;
  tables.taps.clear();
  for (int x = 0; x < to.width_px; ++x)
    tables.taps.push_back(tap_of(x, from.width_px, to.width_px));
}

// The four bytes of a pixel in the low bytes of four 16-bit fields: R and B, then G and A.
std::uint64_t spread_bytes(std::uint32_t p) {
  return (p & 0x00ff00ffu) | static_cast<std::uint64_t>(p & 0xff00ff00u) << 24;
}
std::uint32_t gather_bytes(std::uint64_t v) {
  return static_cast<std::uint32_t>(v) | static_cast<std::uint32_t>(v >> 24);
}

// Four fields at once; each sum is below 2^16.
std::uint64_t blend(std::uint64_t a, std::uint64_t b, std::uint64_t weight_fx8) {
  constexpr std::uint64_t kHalf = 0x0080008000800080u, kBytes = 0x00ff00ff00ff00ffu;
  return (a * (256 - weight_fx8) + b * weight_fx8 + kHalf) >> 8 & kBytes;
}

}  // namespace

void enlarge(std::span<const std::uint32_t> small, PictureExtent from,
             std::span<std::uint32_t> large, PictureExtent to, EnlargeTables& tables,
             Workers& workers) {
  SWELL_CHECK(from.width_px <= to.width_px && from.height_px <= to.height_px, "{}x{} to {}x{}",
              from.width_px, from.height_px, to.width_px, to.height_px);
  prepare(from, to, workers.thread_count(), tables);
  const auto columns = static_cast<std::size_t>(from.width_px);
  const auto enlarge_row = [&](int y, std::uint64_t* row) {
    const Tap vertical = tap_of(y, from.height_px, to.height_px);
    const std::uint32_t* a = small.data() + vertical.first * columns;
    const std::uint32_t* b = small.data() + vertical.second * columns;
    for (std::size_t x = 0; x < columns; ++x)
      row[x] = blend(spread_bytes(a[x]), spread_bytes(b[x]), vertical.weight_fx8);
    std::uint32_t* result = large.data() + static_cast<std::size_t>(y) * to.width_px;
    for (const Tap& tap : tables.taps)
      *result++ = gather_bytes(blend(row[tap.first], row[tap.second], tap.weight_fx8));
  };
  const auto tasks = static_cast<std::size_t>((to.height_px + kRowsPerTask - 1) / kRowsPerTask);
  workers.for_each(tasks, [&](std::size_t task, int slot) {
    const int first = static_cast<int>(task) * kRowsPerTask;
    for (int y = first; y < std::min(first + kRowsPerTask, to.height_px); ++y)
      enlarge_row(y, tables.rows[static_cast<std::size_t>(slot)].data());
  });
}

}  // namespace swell::render
