// Building PackedMap2 and PackedMap1: quantise, filter down, pack the 2 x 2 neighbourhoods.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "texture/packed_map_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include "math/check.h"
#include "math/for_each_row.h"
#include "math/lanes-inl.h"
#include "math/large_array.h"
#include "math/stop.h"
#include "texture/packed_map.h"

HWY_BEFORE_NAMESPACE();
namespace swell::texture {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

using D = hn::CappedTag<float, 8>;
using V = hn::Vec<D>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));
constexpr int kQuadsAtOnce = 16;
constexpr int kMostLevels = std::bit_width(static_cast<unsigned>(kMostPackedSize));

// Calls body(first, end) for rows of a level, on all threads of `workers` where that is worth it.
template <class Body>
void ForPieces(int rows, Workers* workers, const Body& body) {
  constexpr int kFewRows = 64;
  if (workers && rows > kFewRows)
    for_each_piece(rows, *workers, body);
  else
    body(0, rows);
}

// Sums of squares in eight columns on every target, so that they have one order.
class ColumnSums {
 public:
  static constexpr int kColumns = 8;

  HWY_INLINE ColumnSums() {
    for (V& sum : sums_) sum = hn::Zero(D());
  }
  // value(column) has those of the columns from there on.
  template <class Value>
  HWY_INLINE void add_squares(const Value& value) {
    for (int k = 0; k < kVectors; ++k) {
      const V v = value(k * kLanes);
      sums_[k] = MulAdd(v, v, sums_[k]);
    }
  }
  HWY_INLINE double total() const {
    HWY_ALIGN float columns[kColumns];
    for (int k = 0; k < kVectors; ++k) hn::Store(sums_[k], D(), columns + k * kLanes);
    double total = 0.0;
    for (const float column : columns) total += column;
    return total;
  }

 private:
  static constexpr int kVectors = kColumns / kLanes;
  V sums_[kVectors];
};

// max |value| over `count` floats.
float max_magnitude(const float* HWY_RESTRICT values, std::size_t count) {
  const D d;
  auto largest = hn::Zero(d);
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    largest = Max(Abs(hn::LoadU(d, values + i)), largest);
  }
  float result = hn::GetLane(hn::MaxOfLanes(d, largest));
  for (; i < count; ++i) result = std::max(result, std::abs(values[i]));
  return result;
}

// Sum of squares of one row: floats in eight columns, then the columns in order.
double sum_of_squares(const float* HWY_RESTRICT row, int size) {
  if (size < ColumnSums::kColumns) {
    double total = 0.0;
    for (int i = 0; i < size; ++i) total += row[i] * row[i];
    return total;
  }
  ColumnSums sums;
  for (int i = 0; i < size; i += ColumnSums::kColumns)
    sums.add_squares([&](int column) HWY_ATTR { return hn::LoadU(D(), row + i + column); });
  return sums.total();
}

// Bytes of one row, rounded to nearest even and clamped; one more repeats the first.
void quantize_row(const float* HWY_RESTRICT row, int size, float per_unit,
                  std::int8_t* HWY_RESTRICT bytes) {
  const D d;
  const hn::RebindToSigned<D> di;
  const hn::Rebind<std::int8_t, D> d8;
  const auto limit = hn::Set(d, 127.0f);
  const auto quantize = [&](auto value) HWY_ATTR {
    const auto scaled = value * per_unit;
    return hn::NearestInt(Min(Max(scaled, -limit), limit));
  };
  if (size < kLanes) {
    HWY_ALIGN float padded[kLanes] = {};
    HWY_ALIGN std::int32_t integers[kLanes];
    std::copy_n(row, size, padded);
    hn::Store(quantize(hn::Load(d, padded)), di, integers);
    for (int i = 0; i < size; ++i) bytes[i] = static_cast<std::int8_t>(integers[i]);
  } else {
    for (int i = 0; i < size; i += kLanes) {
      hn::StoreU(hn::DemoteTo(d8, quantize(hn::LoadU(d, row + i))), d8, bytes + i);
    }
  }
  bytes[size] = bytes[0];
}

// out[i] = (v[2i - 1] + 2 v[2i] + v[2i + 1]) / 4 where v is the same sum down the three rows.
// `column` has room for size + 1 floats; v[x] goes to column[x + 1], column[0] is v[size - 1].
void filter_row(const float* HWY_RESTRICT above, const float* HWY_RESTRICT row,
                const float* HWY_RESTRICT below, int size, float* HWY_RESTRICT column,
                float* HWY_RESTRICT out) {
  const D d;
  const int half = size / 2;
  if (half < kLanes) {
    for (int x = 0; x < size; ++x) column[x + 1] = 0.25f * (above[x] + below[x]) + 0.5f * row[x];
    column[0] = column[size];
    for (int i = 0; i < half; ++i) {
      out[i] = 0.25f * (column[2 * i] + column[2 * i + 2]) + 0.5f * column[2 * i + 1];
    }
    return;
  }
  const auto tent = [&](auto left, auto middle, auto right)
                        HWY_ATTR { return 0.25f * (left + right) + 0.5f * middle; };
  for (int x = 0; x < size; x += kLanes) {
    const auto v = tent(hn::LoadU(d, above + x), hn::LoadU(d, row + x), hn::LoadU(d, below + x));
    hn::StoreU(v, d, column + x + 1);
  }
  column[0] = column[size];
  for (int i = 0; i < half; i += kLanes) {
    const auto low = hn::LoadU(d, column + 2 * i), high = hn::LoadU(d, column + 2 * i + kLanes);
    const auto next_low = hn::LoadU(d, column + 2 * i + 1);
    const auto next_high = hn::LoadU(d, column + 2 * i + 1 + kLanes);
    const auto left = hn::ConcatEven(d, high, low), middle = hn::ConcatOdd(d, high, low);
    const auto right = hn::ConcatOdd(d, next_high, next_low);
    hn::StoreU(tent(left, middle, right), d, out + i);
  }
}

// Halves a channel of size x size.
void filter_down(const float* HWY_RESTRICT from, int size, Workers* workers,
                 float* HWY_RESTRICT to) {
  ForPieces(size / 2, workers, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
    std::array<float, kMostPackedSize + 1> column;
    check_stop();
    for (std::ptrdiff_t j = first; j < end; ++j) {
      const std::ptrdiff_t y = 2 * j, above = (y + size - 1) & (size - 1);
      filter_row(from + above * size, from + y * size, from + (y + 1) * size, size, column.data(),
                 to + j * (size / 2));
    }
  });
}

// Quads of one row from the byte rows j (0) and j + 1 (1) of both channels.
void pack_row(const std::int8_t* HWY_RESTRICT a0, const std::int8_t* HWY_RESTRICT a1,
              const std::int8_t* HWY_RESTRICT b0, const std::int8_t* HWY_RESTRICT b1, int size,
              PackedQuad* HWY_RESTRICT quads) {
  const hn::CappedTag<std::int8_t, 16> d8;
  const hn::Repartition<std::int16_t, decltype(d8)> d16;
  const hn::Repartition<std::int32_t, decltype(d8)> d32;
  const hn::Repartition<std::uint64_t, decltype(d8)> d64;
  int i = 0;
  for (; i + kQuadsAtOnce <= size; i += kQuadsAtOnce) {
    // Neighbours in x side by side, then rows, then channels.
    const auto pairs = [&](const std::int8_t* row, auto& low, auto& high) HWY_ATTR {
      const auto left = hn::LoadU(d8, row + i), right = hn::LoadU(d8, row + i + 1);
      low = hn::BitCast(d16, hn::InterleaveLower(d8, left, right));
      high = hn::BitCast(d16, hn::InterleaveUpper(d8, left, right));
    };
    hn::Vec<decltype(d16)> a0_pairs[2], a1_pairs[2], b0_pairs[2], b1_pairs[2];
    pairs(a0, a0_pairs[0], a0_pairs[1]);
    pairs(a1, a1_pairs[0], a1_pairs[1]);
    pairs(b0, b0_pairs[0], b0_pairs[1]);
    pairs(b1, b1_pairs[0], b1_pairs[1]);
    for (int h = 0; h < 2; ++h) {
      PackedQuad* const out = quads + i + 8 * h;
      const auto a_low = hn::BitCast(d32, hn::InterleaveLower(d16, a0_pairs[h], a1_pairs[h]));
      const auto a_high = hn::BitCast(d32, hn::InterleaveUpper(d16, a0_pairs[h], a1_pairs[h]));
      const auto b_low = hn::BitCast(d32, hn::InterleaveLower(d16, b0_pairs[h], b1_pairs[h]));
      const auto b_high = hn::BitCast(d32, hn::InterleaveUpper(d16, b0_pairs[h], b1_pairs[h]));
      hn::StoreU(hn::BitCast(d64, hn::InterleaveLower(d32, a_low, b_low)), d64, out);
      hn::StoreU(hn::BitCast(d64, hn::InterleaveUpper(d32, a_low, b_low)), d64, out + 2);
      hn::StoreU(hn::BitCast(d64, hn::InterleaveLower(d32, a_high, b_high)), d64, out + 4);
      hn::StoreU(hn::BitCast(d64, hn::InterleaveUpper(d32, a_high, b_high)), d64, out + 6);
    }
  }
  for (; i < size; ++i) {
    const std::int8_t taps[8] = {a0[i], a0[i + 1], a1[i], a1[i + 1],
                                 b0[i], b0[i + 1], b1[i], b1[i + 1]};
    PackedQuad quad = 0;
    for (int n = 8; n-- > 0;) quad = quad << 8 | static_cast<std::uint8_t>(taps[n]);
    quads[i] = quad;
  }
}

// Sum of (to[i + shift] - from[i])^2 over rows that repeat, in the order of sum_of_squares().
double squared_differences(const float* HWY_RESTRICT from, const float* HWY_RESTRICT to, int shift,
                           int size) {
  const D d;
  ColumnSums sums;
  int i = 0;
  for (; i + ColumnSums::kColumns + shift <= size; i += ColumnSums::kColumns)
    sums.add_squares([&](int column) HWY_ATTR {
      return hn::LoadU(d, to + i + column + shift) - hn::LoadU(d, from + i + column);
    });
  double total = sums.total();
  for (; i < size; ++i) {
    const double difference = static_cast<double>(to[(i + shift) & (size - 1)]) - from[i];
    total += difference * difference;
  }
  return total;
}

// Adds to the sums of rows what row j of a channel has.
void add_row(const float* values, int size, std::ptrdiff_t j, std::size_t channel,
             PackedRowSums& sums) {
  const float* const row = values + j * size;
  const float* const next = values + ((j + 1) & (size - 1)) * size;
  sums.squares += sum_of_squares(row, size);
  sums.beside[channel] =
      squared_differences(row, row, 1, size) + squared_differences(row, next, 0, size);
  sums.across[channel] =
      squared_differences(row, next, 1, size) + squared_differences(next, row, 1, size);
}

// The sum over a level's texels of both channels' squares, less what bilinear samples between
// texels lack of them in the mean over all places. Along one axis (1 - t) v + t w has the mean
// square (v^2 + v w + w^2) / 3: (v - w)^2 / 6 less than the mean of the squares.
struct LevelSquares {
  double texels = 0.0, lost_between = 0.0;
};

LevelSquares sum_level(const float* a, const float* b, int size, Workers* workers,
                       std::span<PackedRowSums> rows) {
  ForPieces(size, workers, [&](int first, int end) {
    check_stop();
    for (int j = first; j < end; ++j) {
      PackedRowSums& sums = rows[static_cast<std::size_t>(j)];
      sums.squares = 0.0;
      add_row(a, size, j, 0, sums);
      add_row(b, size, j, 1, sums);
    }
  });
  LevelSquares all;
  std::array<double, 2> beside{}, across{};
  for (const PackedRowSums& row : rows.first(static_cast<std::size_t>(size))) {
    all.texels += row.squares;
    for (std::size_t channel = 0; channel < 2; ++channel) {
      beside[channel] += row.beside[channel];
      across[channel] += row.across[channel];
    }
  }
  for (std::size_t channel = 0; channel < 2; ++channel)
    all.lost_between += beside[channel] / 9.0 + across[channel] / 36.0;
  return all;
}

// A row of a channel's level as bytes, and the one below it.
class ByteRows {
 public:
  ByteRows(const float* values, int size, float per_unit)
      : values_(values), size_(size), per_unit_(per_unit) {}

  // Goes to row j; downwards one by one each row is made once.
  void go_to(std::ptrdiff_t j) {
    if (at_ == j) return;
    const bool is_next = at_ + 1 == j;
    if (is_next) upper_ = 1 - upper_;
    at_ = j;
    if (!is_next) make(j, upper_);
    make((j + 1) & (size_ - 1), 1 - upper_);
  }
  const std::int8_t* row() const { return bytes_[upper_].data(); }
  const std::int8_t* next() const { return bytes_[1 - upper_].data(); }

 private:
  void make(std::ptrdiff_t j, std::size_t at) {
    quantize_row(values_ + j * size_, size_, per_unit_, bytes_[at].data());
  }

  const float* values_;
  int size_;
  float per_unit_;
  std::ptrdiff_t at_ = -2;  // next to none
  std::size_t upper_ = 0;
  std::array<std::array<std::int8_t, kMostPackedSize + 1>, 2> bytes_;
};

// A level of both channels.
struct LevelRows {
  ByteRows a, b;

  LevelRows(const float* values_a, const float* values_b, int size, float per_unit)
      : a(values_a, size, per_unit), b(values_b, size, per_unit) {}
  void go_to(std::ptrdiff_t j) {
    a.go_to(j);
    b.go_to(j);
  }
  void pack(int first, int count, PackedQuad* quads) const {
    pack_row(a.row() + first, a.next() + first, b.row() + first, b.next() + first, count, quads);
  }
};

// Puts quads of a row beside those of the next coarser level around them.
void join_quads(const PackedQuad* HWY_RESTRICT fine, const PackedQuad* HWY_RESTRICT coarse,
                int count, PackedWord* HWY_RESTRICT words) {
  const hn::Full128<PackedQuad> d;
  for (int i = 0; i < count; i += 2) {
    const auto pair = hn::LoadU(d, fine + i), around = hn::Set(d, coarse[i / 2]);
    auto* const out = reinterpret_cast<PackedQuad*>(words + i);
    hn::Store(hn::InterleaveLower(d, pair, around), d, out);
    hn::Store(hn::InterleaveUpper(d, pair, around), d, out + 2);
  }
}

// The words of a row, whose quads lie beside those of `coarse`, or beside 0 if that is null.
void join_row(const LevelRows& fine, const LevelRows* coarse, int size,
              PackedWord* HWY_RESTRICT words) {
  constexpr int kChunk = 256;
  std::array<PackedQuad, kChunk> quads, around;
  for (int first = 0; first < size; first += kChunk) {
    const int count = std::min(size - first, kChunk);
    fine.pack(first, count, quads.data());
    if (coarse) {
      coarse->pack(first / 2, count / 2, around.data());
      join_quads(quads.data(), around.data(), count, words + first);
    } else {
      for (int i = 0; i < count; ++i) words[first + i] = {quads[static_cast<std::size_t>(i)], 0};
    }
  }
}

// Words of one row from the byte rows j (0) and j + 1 (1).
void pack_row1(const std::int8_t* HWY_RESTRICT row0, const std::int8_t* HWY_RESTRICT row1, int size,
               std::uint32_t* HWY_RESTRICT words) {
  const hn::CappedTag<std::int8_t, 16> d8;
  const hn::Repartition<std::int16_t, decltype(d8)> d16;
  const hn::Repartition<std::uint32_t, decltype(d8)> d32;
  int i = 0;
  for (; i + kQuadsAtOnce <= size; i += kQuadsAtOnce) {
    const auto left0 = hn::LoadU(d8, row0 + i), right0 = hn::LoadU(d8, row0 + i + 1);
    const auto left1 = hn::LoadU(d8, row1 + i), right1 = hn::LoadU(d8, row1 + i + 1);
    const auto store = [&](auto pairs0, auto pairs1, std::uint32_t* out) HWY_ATTR {
      const auto p0 = hn::BitCast(d16, pairs0), p1 = hn::BitCast(d16, pairs1);
      hn::StoreU(hn::BitCast(d32, hn::InterleaveLower(d16, p0, p1)), d32, out);
      hn::StoreU(hn::BitCast(d32, hn::InterleaveUpper(d16, p0, p1)), d32, out + 4);
    };
    store(hn::InterleaveLower(d8, left0, right0), hn::InterleaveLower(d8, left1, right1),
          words + i);
    store(hn::InterleaveUpper(d8, left0, right0), hn::InterleaveUpper(d8, left1, right1),
          words + i + 8);
  }
  for (; i < size; ++i) {
    const std::int8_t taps[4] = {row0[i], row0[i + 1], row1[i], row1[i + 1]};
    words[i] = 0;
    for (int n = 4; n-- > 0;) words[i] = words[i] << 8 | static_cast<std::uint8_t>(taps[n]);
  }
}

void build_map1(const float* values, PackedMap1& map, Workers* workers) {
  float* next = map.scratch.data();
  for (int size = map.size;; size /= 2) {
    std::uint32_t* const words = map.words.data() + static_cast<std::ptrdiff_t>(size) * size;
    ForPieces(size, workers, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
      check_stop();
      ByteRows rows(values, size, 127.0f);
      for (std::ptrdiff_t j = first; j < end; ++j) {
        rows.go_to(j);
        pack_row1(rows.row(), rows.next(), size, words + j * size);
      }
    });
    if (size == 1) break;
    filter_down(values, size, workers, next);
    values = next;
    next += static_cast<std::ptrdiff_t>(size / 2) * (size / 2);
  }
}

// Both channels of a level.
struct LevelValues {
  const float *a, *b;
};

void pack_level(const LevelValues& fine, const LevelValues* coarse, int size, float per_unit,
                Workers* workers, PackedWord* words) {
  ForPieces(size, workers, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
    check_stop();
    LevelRows rows(fine.a, fine.b, size, per_unit);
    LevelRows around(coarse ? coarse->a : nullptr, coarse ? coarse->b : nullptr, size / 2,
                     per_unit);
    for (std::ptrdiff_t j = first; j < end; ++j) {
      rows.go_to(j);
      if (coarse) around.go_to(j / 2);
      join_row(rows, coarse ? &around : nullptr, size, words + j * size);
    }
  });
}

void build_map(const float* a, const float* b, float fixed_scale, float least_variance,
               PackedMap2& map, Workers* workers) {
  const std::size_t texels = static_cast<std::size_t>(map.size) * map.size;
  map.scale = fixed_scale;
  if (!(fixed_scale > 0.0f)) {
    const float largest = std::max(max_magnitude(a, texels), max_magnitude(b, texels));
    map.scale = largest > 1e-30f ? largest / 127.0f : 1.0f;
  }
  std::array<LevelValues, kMostLevels> levels;
  float* next = map.scratch.data();
  double first_mean = 0.0;
  for (int level = 0; level < map.levels; ++level) {
    const int size = map.size >> level;
    const std::ptrdiff_t level_texels = static_cast<std::ptrdiff_t>(size) * size;
    levels[static_cast<std::size_t>(level)] = {a, b};
    const LevelSquares squares = sum_level(a, b, size, workers, map.scratch_sums);
    if (level == 0) first_mean = squares.texels / static_cast<double>(level_texels);
    const double mean = (squares.texels - squares.lost_between) / static_cast<double>(level_texels);
    map.lost_variance[level] = static_cast<float>(std::max(0.0, first_mean - mean));
    if (mean < static_cast<double>(least_variance))
      map.detail_levels = std::min(map.detail_levels, level);
    if (size == 1) break;
    filter_down(a, size, workers, next);
    filter_down(b, size, workers, next + level_texels / 4);
    a = next;
    b = next + level_texels / 4;
    next += level_texels / 2;
  }
  if (map.detail_levels == 0) {
    std::ranges::fill(map.words, PackedWord{0, 0});
    return;
  }
  for (int level = 0; level < map.levels; ++level) {
    const auto at = static_cast<std::size_t>(level);
    const bool blends = level + 1 < map.levels && level + 1 != map.detail_levels;
    pack_level(levels[at], blends ? &levels[at + 1] : nullptr, map.size >> level, 1.0f / map.scale,
               workers, map.words.data() + map.level_offset[at]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::texture
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::texture {

HWY_EXPORT(build_map);
HWY_EXPORT(build_map1);

void pack_map1(int size, std::span<const float> values, PackedMap1& map, Workers* workers) {
  const std::size_t texels = static_cast<std::size_t>(size) * size;
  SWELL_CHECK(size >= 1 && size <= kMostPackedSize &&
                  std::has_single_bit(static_cast<unsigned>(size)) && values.size() == texels,
              "size={} values={}", size, values.size());
  map.size = size;
  map.levels = std::countr_zero(static_cast<unsigned>(size)) + 1;
  resize_large(map.words, 2 * texels);
  resize_large(map.scratch, texels / 3 + 1);
  HWY_DYNAMIC_DISPATCH(build_map1)(values.data(), map, workers);
  if (workers) map.scratch = {};
}

void pack_map2(int size, std::span<const float> a, std::span<const float> b, float fixed_scale,
               PackedMap2& map, float least_variance, Workers* workers) {
  SWELL_CHECK(
      size >= 1 && size <= kMostPackedSize && std::has_single_bit(static_cast<unsigned>(size)),
      "size={}", size);
  const std::size_t texels = static_cast<std::size_t>(size) * size;
  SWELL_CHECK(a.size() == texels && b.size() == texels, "a={} b={} size={}", a.size(), b.size(),
              size);
  map.size = size;
  map.levels = std::countr_zero(static_cast<unsigned>(size)) + 1;
  map.detail_levels = std::clamp(map.levels - 2, 1, kMostDetailLevels);
  resize_large(map.words, 2 * texels);
  map.level_offset.resize(map.levels);
  map.lost_variance.resize(map.levels);
  for (int level = 0; level < map.levels; ++level) {
    const std::uint32_t side = static_cast<std::uint32_t>(size) >> level;
    map.level_offset[level] = side * side;
  }
  resize_large(map.scratch, 2 * texels / 3 + 1);
  map.scratch_sums.resize(size);
  HWY_DYNAMIC_DISPATCH(build_map)
  (a.data(), b.data(), fixed_scale, least_variance, map, workers);
  if (workers) map.scratch = {};
}

}  // namespace swell::texture
#endif  // HWY_ONCE
