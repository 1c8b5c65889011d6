#include "render/picture/enlarge.h"

#include <algorithm>

#include "math/check.h"

namespace swell::render {
namespace {

constexpr int kRowsPerTask = 16;
constexpr std::size_t kMostLanes = 16;  // of 32 bits, in a vector

// Between which samples of `from` the centre of sample i of `to` lies.
struct Tap {
  int first, weight_fx8;  // of the next one, [0, 255], 0 if there is none
};
Tap tap_of(int i, int from, int to) {
  // Centres at +0.5: position (i + 0.5) from / to - 0.5 in 1/256 samples, rounded down.
  const std::int64_t fx8 =
      ((2 * static_cast<std::int64_t>(i) + 1) * from * 128) / to - 128;  // below 2^22
  const auto clamped = static_cast<int>(std::clamp<std::int64_t>(fx8, 0, 256 * (from - 1)));
  return {clamped >> 8, clamped & 255};
}

void prepare(PictureExtent from, PictureExtent to, int threads, EnlargeTables& tables) {
  // Whole vectors, and a neighbour for the last column.
  tables.rows.resize(static_cast<std::size_t>(threads));
  for (auto& row : tables.rows)
    row.resize(static_cast<std::size_t>(from.width_px) + kMostLanes + 1);
  if (tables.from == from && tables.to == to) return;
  tables.from = from, tables.to = to;
  const std::size_t columns = static_cast<std::size_t>(to.width_px) + kMostLanes;
  tables.first.assign(columns, 0);
  tables.weight_fx8_twice.assign(columns, 0);
  for (int x = 0; x < to.width_px; ++x) {
    const Tap tap = tap_of(x, from.width_px, to.width_px);
    tables.first[static_cast<std::size_t>(x)] = static_cast<std::uint32_t>(tap.first);
    tables.weight_fx8_twice[static_cast<std::size_t>(x)] =
        0x10001u * static_cast<std::uint32_t>(tap.weight_fx8);
  }
}

}  // namespace

void enlarge(std::span<const std::uint32_t> small, PictureExtent from,
             std::span<std::uint32_t> large, PictureExtent to, EnlargeTables& tables,
             Workers& workers) {
  SWELL_CHECK(from.width_px <= to.width_px && from.height_px <= to.height_px, "{}x{} to {}x{}",
              from.width_px, from.height_px, to.width_px, to.height_px);
  const auto pixels = [](PictureExtent size) {
    return static_cast<std::size_t>(size.width_px) * static_cast<std::size_t>(size.height_px);
  };
  SWELL_CHECK(small.size() == pixels(from) && large.size() == pixels(to),
              "{} pixels of {}x{}, {} of {}x{}", small.size(), from.width_px, from.height_px,
              large.size(), to.width_px, to.height_px);
  prepare(from, to, workers.thread_count(), tables);
  const auto small_row = [&](int y) {
    return small.data() + static_cast<std::size_t>(y) * from.width_px;
  };
  const auto tasks = static_cast<std::size_t>((to.height_px + kRowsPerTask - 1) / kRowsPerTask);
  workers.for_each(tasks, [&](std::size_t task, int slot) {
    const int first = static_cast<int>(task) * kRowsPerTask;
    for (int y = first; y < std::min(first + kRowsPerTask, to.height_px); ++y) {
      const Tap tap = tap_of(y, from.height_px, to.height_px);
      enlarge_row(tables, small_row(tap.first),
                  small_row(std::min(tap.first + 1, from.height_px - 1)), tap.weight_fx8,
                  tables.rows[static_cast<std::size_t>(slot)].data(),
                  large.data() + static_cast<std::size_t>(y) * to.width_px);
    }
  });
}

}  // namespace swell::render
