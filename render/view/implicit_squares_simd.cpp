#include <array>
#include <cstddef>

#include "render/view/implicit_squares.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/view/implicit_squares_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/view/implicit_tables-inl.h"
#include "render/view/implicit_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

constexpr std::size_t kSquareCount = kSquares * kSquares;

// What rounding of floats may change a quadric by over all squares: 64 units in the last place of
// the sum of its terms' sizes.
float rounding_of(const RayQuadric& f, glm::vec3 reach) {
  const auto size = [](float v) { return v < 0.0f ? -v : v; };
  const RayQuadric sizes = {size(f.xx), size(f.yy), size(f.zz),    size(f.xy),
                            size(f.xz), size(f.yz), glm::abs(f.b), size(f.c)};
  constexpr float kRounding = 64.0f * 6e-8f;
  return kRounding * (glm::dot(reach, sizes.times(reach) + 2.0f * sizes.b) + sizes.c);
}

// The points of a packet's squares.
struct Beams {
  V3 middle, along;
  glm::vec3 across, down;
  glm::vec3 reach;  // of all squares, from the part's middle
};

// The most of q + g s + k s^2 for s in [-1, 1].
HWY_INLINE V MostAlong(V q, V g, V k) {
  const V size = Abs(g), bend = -(k + k);
  const V turn = MulAdd(g * g, 0.5f / bend, q);
  return IfThenElse(size < bend, turn, q + (size + k));
}

// A quadric over beams is q + g.s + s^T K s. Along the beam its range is exact; the squares' sides
// widen it.
struct Range {
  V low, high;
};

HWY_INLINE Range RangeOf(const RayQuadric& f, const Beams& beams) {
  const V3 b = Constant(f.b), bent = Times(f, beams.middle), along = Times(f, beams.along);
  const V3 half_slope = bent + b;
  const V q = Dot(beams.middle, half_slope + b) + f.c;
  const V g = 2.0f * Dot(half_slope, beams.along);
  const V k = Dot(along, beams.along);
  const V3 across = Constant(beams.across), down = Constant(beams.down);
  const glm::vec3 bent_across = f.times(beams.across), bent_down = f.times(beams.down);
  const float both = glm::dot(beams.across, bent_down);
  const V mixed = Abs(Dot(along, across)) + (Abs(Dot(along, down)) + (both < 0.0f ? -both : both));
  const V g_across = 2.0f * Dot(half_slope, across);
  const V g_down = 2.0f * Dot(half_slope, down);
  const V k_across = Constant(glm::dot(beams.across, bent_across));
  const V k_down = Constant(glm::dot(beams.down, bent_down));
  const V zero = hn::Zero(D());
  const V wider = MulAdd(2.0f, mixed, rounding_of(f, beams.reach));
  const V more = MostAlong(zero, g_across, k_across) + MostAlong(zero, g_down, k_down);
  const V less = MostAlong(zero, g_across, -k_across) + MostAlong(zero, g_down, -k_down);
  return {-(MostAlong(-q, g, -k) + (less + wider)), MostAlong(q, g, k) + (more + wider)};
}

HWY_INLINE V MostOf(const PosedImplicit& implicit, const RayTerm& term, const Beams& beams) {
  V most = RangeOf(term.quadric, beams).high;
  for (std::size_t i = 0; i < term.perturbations; ++i) {
    const RayPerturbation& r = implicit.perturbations[term.first_perturbation + i];
    const Range range = RangeOf(r.quadric, beams);
    const V q = Max(r.factor > 0.0f ? range.high : range.low, 0.0f);
    constexpr float kRounding = 1e-5f;
    const float factor = r.factor * (r.factor > 0.0f ? 1.0f + kRounding : 1.0f - kRounding);
    most = MulAdd(factor, q * q * q, most);
  }
  return most;
}

// The most that heights are over beams, and over their threshold: by the blocks of the table whose
// size is that of the beams' projection.
HWY_INLINE V MostOf(const RayTable& table, const Beams& beams) {
  constexpr float kRounding = 64.0f * 6e-8f, kRounding_posts = 0.02f;
  const V3 at = InTable(table, beams.middle), along = Turned(table.linear, beams.along);
  const glm::mat3 sizes(glm::abs(table.linear[0]), glm::abs(table.linear[1]),
                        glm::abs(table.linear[2]));
  const glm::vec3 aside = glm::abs(table.linear * beams.across) +
                          glm::abs(table.linear * beams.down) +
                          kRounding * (sizes * beams.reach + glm::abs(table.at)) +
                          glm::vec3(kRounding_posts, kRounding_posts, 0.0f);
  const V u = Abs(along.x) + aside.x, v = Abs(along.y) + aside.y, z = Abs(along.z) + aside.z;
  return WithHeights(table, [&](const auto& of) HWY_ATTR {
    V highest = heights::HighestOver(of, at.x - u, at.x + u, at.y - v, at.y + v);
    highest = MulAdd(Abs(highest), kRounding, highest);
    return highest - Max(at.z - z, table.threshold_m);
  });
}

glm::vec3 reach_of(const SquareBeams& b) {
  constexpr float kLast = kSquares - 1;
  return glm::abs(b.middle) + glm::abs(b.along) + glm::abs(b.across) + glm::abs(b.down) +
         kLast * (glm::abs(b.middle_dx) + glm::abs(b.middle_dy) + glm::abs(b.along_dx) +
                  glm::abs(b.along_dy));
}

std::uint64_t SquaresShowing(const PosedImplicit& implicit, const RayPart& part,
                             const SquareBeams& beams, std::uint64_t squares) {
  static_assert(kSquareCount % kLanes == 0);
  const D d;
  const glm::vec3 reach = reach_of(beams);
  std::uint64_t showing = 0;
  constexpr std::uint64_t kPacket = (std::uint64_t{1} << kLanes) - 1;
  for (std::size_t first = 0; first < kSquareCount; first += kLanes) {
    if ((squares >> first & kPacket) == 0) continue;
    const hn::RebindToSigned<D> di;
    const auto number = hn::Iota(di, static_cast<int>(first));
    const V i = hn::ConvertTo(d, number & (kSquares - 1));
    const V j = hn::ConvertTo(d, hn::ShiftRight<3>(number));
    const auto at = [&](glm::vec3 base, glm::vec3 dx, glm::vec3 dy) HWY_ATTR {
      return MulAdd(Constant(dx), i, MulAdd(Constant(dy), j, Constant(base)));
    };
    const Beams of_packet = {at(beams.middle, beams.middle_dx, beams.middle_dy),
                             at(beams.along, beams.along_dx, beams.along_dy), beams.across,
                             beams.down, reach};
    M may = hn::FirstN(d, kLanes);
    for (std::uint32_t term = 0; term < part.terms && !hn::AllFalse(d, may); ++term) {
      const V most = MostOf(implicit, implicit.terms[part.first_term + term], of_packet);
      may = may & (most >= 0.0f);
    }
    if (part.table != RayPart::kNoTable) {
      const RayTable& table = implicit.tables[static_cast<std::size_t>(part.table)];
      may = may & (MostOf(table, of_packet) >= 0.0f);
    }
    std::array<std::uint8_t, 8> bits{};
    hn::StoreMaskBits(d, may, bits.data());
    std::uint64_t of_lanes = 0;
    for (std::size_t n = 0; n < kLanes; n += 8) of_lanes |= std::uint64_t{bits[n / 8]} << n;
    showing |= (of_lanes & kPacket) << first;
  }
  return showing & squares;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(SquaresShowing);

std::uint64_t squares_showing(const PosedImplicit& implicit, const RayPart& part,
                              const SquareBeams& beams, std::uint64_t squares) {
  return HWY_DYNAMIC_DISPATCH(SquaresShowing)(implicit, part, beams, squares);
}

}  // namespace swell::render
#endif
