// Rays of caustics: bent, gathered, softened.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/sea/caustic_maps_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "math/check.h"
#include "render/sea/caustic_maps.h"
#include "render/world/land_shadow.h"
//
#include "math/elementary-inl.h"
#include "math/lanes-inl.h"
#include "ocean/open_sea/sea.h"

#ifndef SWELL_RENDER_WORLD_CAUSTIC_RAYS_
#define SWELL_RENDER_WORLD_CAUSTIC_RAYS_
namespace swell::render {

// What all rays of a light share.
struct RayConstants {
  glm::vec3 to_light;
  glm::vec2 from_height;  // what a height moves a ray by on its way to the level
  glm::vec2 flat;         // slant under flat water, or above it of mirrored light
  float inv_n = 1.0f;
  glm::vec2 texels_per_m{1.0f};
};

// The points of a patch that rays come from.
struct WaveFields {
  const float* height_m = nullptr;
  const float *slope_x = nullptr, *slope_y = nullptr;
};

inline constexpr float kLeastRise = 0.1f;  // of mirrored light, in a metre of its way

// A pass that softens texels. It adds the variance 2 part stride^2 [texels^2] along each axis; part
// in [0, 1/4].
struct SoftPass {
  glm::vec2 part;
  int stride;
};

}  // namespace swell::render
#endif

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

// How a ray -l leaves a surface with normal N = (-grad h, 1) / |.|: as
// share (-l) + along N, up or down.
struct Leaving {
  V along;       // over |(-grad h, 1)|
  V away;        // from the surface in height
  float share;   // of the ray
  float higher;  // by how much a higher surface lengthens the way
};

// t = -l / n + (cos_i / n - cos_t) N, cos_t^2 = 1 - (1 - cos_i^2) / n^2.
struct Refract {
  HWY_INLINE Leaving operator()(const RayConstants& c, V cos_i, V inv_length) const {
    const D d;
    const V inv_n = hn::Set(d, c.inv_n), one = hn::Set(d, 1.0f);
    const V sin2_t = NegMulAdd(cos_i, cos_i, one) * (inv_n * inv_n);
    const V along = MulSub(cos_i, inv_n, Sqrt(one - sin2_t)) * inv_length;
    return {along, MulSub(c.to_light.z, inv_n, along), c.inv_n, 1.0f};
  }
};

// r = -l + 2 cos_i N. Waves that mirror light down are taken to mirror it far sideways.
struct Mirror {
  HWY_INLINE Leaving operator()(const RayConstants& c, V cos_i, V inv_length) const {
    const V along = (cos_i + cos_i) * inv_length;
    const V up = along - c.to_light.z;
    return {along, Max(up, kLeastRise), 1.0f, -1.0f};
  }
};

template <class Leave>
HWY_INLINE void TurnRays(const RayConstants& c, const WaveFields& waves, const Leave& leave,
                         CausticRays& rays) {
  const D d;
  const auto set = [&](float x) HWY_ATTR { return hn::Set(d, x); };
  const V one = set(1.0f), lx = set(c.to_light.x), ly = set(c.to_light.y), lz = set(c.to_light.z);
  const std::size_t count = rays.per_depth_x.size();
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const V sx = hn::LoadU(d, waves.slope_x + i), sy = hn::LoadU(d, waves.slope_y + i);
    const V inv_length = one / Sqrt(MulAdd(sx, sx, MulAdd(sy, sy, one)));
    const V facing = NegMulAdd(sx, lx, NegMulAdd(sy, ly, lz));
    const V cos_i = Max(facing * inv_length, set(0.02f));
    const Leaving ray = leave(c, cos_i, inv_length);
    const auto slant = [&](V l, V slope) HWY_ATTR {
      const V sideways = MulAdd(l, set(ray.share), slope * ray.along);
      return -sideways / ray.away;
    };
    const V slant_x = slant(lx, sx), slant_y = slant(ly, sy), higher = set(ray.higher);
    const V x_per_m = set(c.texels_per_m.x), y_per_m = set(c.texels_per_m.y);
    const V height_m = hn::LoadU(d, waves.height_m + i);
    hn::StoreU(height_m * x_per_m * MulAdd(slant_x, higher, set(c.from_height.x)), d,
               rays.from_height_x.data() + i);
    hn::StoreU(height_m * y_per_m * MulAdd(slant_y, higher, set(c.from_height.y)), d,
               rays.from_height_y.data() + i);
    hn::StoreU((slant_x - set(c.flat.x)) * x_per_m, d, rays.per_depth_x.data() + i);
    hn::StoreU((slant_y - set(c.flat.y)) * y_per_m, d, rays.per_depth_y.data() + i);
  }
}

void refract_rays(const RayConstants& c, const WaveFields& waves, CausticRays& rays) {
  TurnRays(c, waves, Refract(), rays);
}

void mirror_rays(const RayConstants& c, const WaveFields& waves, CausticRays& rays) {
  TurnRays(c, waves, Mirror(), rays);
}

// Adds each ray's 2^16 parts to the corners of the square it falls into: quad (i, j) holds what
// texels (i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1) get of the rays between them, so that a ray
// costs one load, one sum and one store. The largest sum, all rays in one place, is 2^30. Half a
// texel is added to their places: on a texel the shares of rays that have moved a little would
// depend on the side they moved to.
void add_rays(const CausticRays& rays, float depth_m, std::uint32_t* HWY_RESTRICT quads) {
  const D d;
  const DU du;
  const hn::CappedTag<std::uint32_t, 4> dq;
  const int size = rays.size;
  const auto mask = hn::Set(du, static_cast<std::uint32_t>(size - 1));
  const auto low_byte = hn::Set(du, 255u), whole = hn::Set(du, 256u);
  const int rows_log2 = std::countr_zero(static_cast<unsigned>(size));
  HWY_ALIGN std::uint32_t parts[4 * kLanes];
  HWY_ALIGN std::uint32_t at[kLanes];
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; i += static_cast<int>(kLanes)) {
      const std::size_t n = static_cast<std::size_t>(j) * size + i;
      const auto texel_fx8 = [&](V first, const float* from_height,
                                 const float* per_depth) HWY_ATTR {
        const V x =
            MulAdd(hn::LoadU(d, per_depth + n), depth_m, hn::LoadU(d, from_height + n) + first);
        return hn::BitCast(du, swell::HWY_NAMESPACE::RoundToInt(x * 256.0f));
      };
      const V column = hn::Iota(d, 0) + (static_cast<float>(i) + 0.5f);
      const auto x = texel_fx8(column, rays.from_height_x.data(), rays.per_depth_x.data());
      const auto y = texel_fx8(hn::Set(d, static_cast<float>(j) + 0.5f), rays.from_height_y.data(),
                               rays.per_depth_y.data());
      const auto right = x & low_byte, below = y & low_byte;
      const auto left = whole - right, above = whole - below;
      hn::StoreInterleaved4(left * above, right * above, left * below, right * below, du, parts);
      const auto row = hn::ShiftRight<8>(y) & mask;
      hn::Store(hn::ShiftLeftSame(row, rows_log2) | (hn::ShiftRight<8>(x) & mask), du, at);
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        std::uint32_t* const quad = quads + 4 * static_cast<std::size_t>(at[lane]);
        hn::Store(hn::Load(dq, quad) + hn::Load(dq, parts + 4 * lane), dq, quad);
      }
    }
  }
}

// What each texel gets of the four quads around it. `row` has room for size + 1.
void sum_quads(const std::uint32_t* HWY_RESTRICT quads, int size, float* HWY_RESTRICT row,
               float* HWY_RESTRICT intensity) {
  const D d;
  const DU du;
  const hn::RebindToSigned<D> di;
  const V unit = hn::Set(d, 0x1p-16f);
  const auto step = static_cast<int>(hn::Lanes(d));
  for (int j = 0; j < size; ++j) {
    const auto row_of = [&](int y) {
      return quads + 4 * static_cast<std::size_t>(y & (size - 1)) * size;
    };
    const std::uint32_t *const here = row_of(j), *const above = row_of(j - 1);
    float* const out = intensity + static_cast<std::size_t>(j) * size;
    for (int i = 0; i < size; i += step) {
      hn::Vec<DU> q0, q1, q2, q3, p0, p1, p2, p3;
      hn::LoadInterleaved4(du, here + 4 * i, q0, q1, q2, q3);
      hn::LoadInterleaved4(du, above + 4 * i, p0, p1, p2, p3);
      const auto value = [&](hn::Vec<DU> sum)
                             HWY_ATTR { return hn::ConvertTo(d, hn::BitCast(di, sum)) * unit; };
      hn::StoreU(value(q0 + p2), d, out + i);
      hn::StoreU(value(q1 + p3), d, row + i + 1);  // of the texels to the right
    }
    row[0] = row[size];
    for (int i = 0; i < size; i += step)
      hn::StoreU(hn::LoadU(d, out + i) + hn::LoadU(d, row + i), d, out + i);
  }
}

// (part, 1 - 2 part, part) along each axis, of texels `stride` apart. `row` has room for
// size + 2 stride.
void soften(const float* HWY_RESTRICT from, int size, SoftPass pass, float* HWY_RESTRICT row,
            float* HWY_RESTRICT to) {
  const D d;
  const int stride = pass.stride;
  const V part_x = hn::Set(d, pass.part.x), part_y = hn::Set(d, pass.part.y);
  const auto blend = [&](V part, V before, V here, V after) HWY_ATTR {
    const V around = NegMulAdd(2.0f, here, before + after);
    return MulAdd(part, around, here);
  };
  const auto step = static_cast<int>(hn::Lanes(d));
  for (int j = 0; j < size; ++j) {
    const auto row_of = [&](int y) {
      return from + static_cast<std::size_t>(y & (size - 1)) * size;
    };
    const float *const above = row_of(j - stride), *const here = row_of(j);
    const float* const below = row_of(j + stride);
    for (int i = 0; i < size; i += step)
      hn::StoreU(
          blend(part_y, hn::LoadU(d, above + i), hn::LoadU(d, here + i), hn::LoadU(d, below + i)),
          d, row + stride + i);
    std::copy_n(row + size, stride, row);
    std::copy_n(row + stride, stride, row + stride + size);
    float* const out = to + static_cast<std::size_t>(j) * size;
    for (int i = 0; i < size; i += step)
      hn::StoreU(blend(part_x, hn::LoadU(d, row + i), hn::LoadU(d, row + stride + i),
                       hn::LoadU(d, row + 2 * stride + i)),
                 d, out + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(refract_rays);
HWY_EXPORT(mirror_rays);
HWY_EXPORT(add_rays);
HWY_EXPORT(sum_quads);
HWY_EXPORT(soften);

namespace {

constexpr SoftPass kTent = {glm::vec2(0.25f), 1};  // [1 2 1] / 4
constexpr int kWidestPass = 4;

// Every 2nd, 4th, ... point of a field of size x size, each time after a tent filter.
void coarsen(std::span<const float> field, int size, CausticRays& rays,
             std::vector<float>& coarse) {
  coarse.assign(field.begin(), field.end());
  rays.filtered.resize(field.size());
  rays.row.resize(static_cast<std::size_t>(size) + 2 * kTent.stride);
  for (; size > rays.size; size /= 2) {
    HWY_DYNAMIC_DISPATCH(soften)(coarse.data(), size, kTent, rays.row.data(), rays.filtered.data());
    const int half = size / 2;
    for (int j = 0; j < half; ++j)
      for (int i = 0; i < half; ++i)
        coarse[static_cast<std::size_t>(j) * half + i] =
            rays.filtered[static_cast<std::size_t>(2 * j) * size + 2 * i];
  }
}

RayConstants ray_constants(glm::vec3 to_light, glm::vec2 flat, const CausticRays& rays) {
  RayConstants c;
  c.to_light = to_light;
  c.from_height = glm::vec2(to_light) / std::max(to_light.z, 0.2f);
  c.flat = flat;
  c.texels_per_m = static_cast<double>(rays.size) / rays.length_m;
  return c;
}

// Sizes the rays of a patch.
WaveFields begin_rays(const ocean::PatchFrame& patch, glm::vec3 to_light, CausticRays& rays) {
  SWELL_CHECK(
      patch.resolution >= 16 && std::has_single_bit(static_cast<unsigned>(patch.resolution)),
      "resolution={}", patch.resolution);
  SWELL_CHECK(to_light.z > 0.0f, "to_light.z={}", to_light.z);
  rays.size = std::min(patch.resolution, kMostCausticSize);
  rays.length_m = patch.length_m;
  const std::size_t count = static_cast<std::size_t>(rays.size) * rays.size;
  for (auto* const field :
       {&rays.from_height_x, &rays.from_height_y, &rays.per_depth_x, &rays.per_depth_y})
    field->resize(count);
  if (patch.resolution == rays.size)
    return {patch.height_m.data(), patch.slope_x.data(), patch.slope_y.data()};
  coarsen(patch.height_m, patch.resolution, rays, rays.height_m);
  coarsen(patch.slope_x, patch.resolution, rays, rays.slope_x);
  coarsen(patch.slope_y, patch.resolution, rays, rays.slope_y);
  return {rays.height_m.data(), rays.slope_x.data(), rays.slope_y.data()};
}

}  // namespace

glm::vec2 mirrored_slant(glm::vec3 to_light) {
  return -glm::vec2(to_light) / std::max(to_light.z, kLeastRise);
}

void trace_rays(const ocean::PatchFrame& patch, glm::vec3 to_light, float n, CausticRays& rays) {
  SWELL_CHECK(n >= 1.0f, "n={}", n);
  const WaveFields waves = begin_rays(patch, to_light, rays);
  const glm::vec2 flat(-underwater_slant(to_light, static_cast<double>(n)));
  RayConstants constants = ray_constants(to_light, flat, rays);
  constants.inv_n = 1.0f / n;
  HWY_DYNAMIC_DISPATCH(refract_rays)(constants, waves, rays);
}

void trace_mirrored_rays(const ocean::PatchFrame& patch, glm::vec3 to_light, CausticRays& rays) {
  const WaveFields waves = begin_rays(patch, to_light, rays);
  HWY_DYNAMIC_DISPATCH(mirror_rays)
  (ray_constants(to_light, mirrored_slant(to_light), rays), waves, rays);
}

std::span<const float> gather_rays(const CausticRays& rays, float depth_m, float spread_per_m,
                                   CausticScratch& scratch) {
  const std::size_t count = static_cast<std::size_t>(rays.size) * rays.size;
  scratch.quads.assign(4 * count, 0);
  scratch.intensity.resize(count);
  scratch.softened.resize(count);
  scratch.row.resize(static_cast<std::size_t>(rays.size) + 2 * kWidestPass);
  HWY_DYNAMIC_DISPATCH(add_rays)(rays, depth_m, scratch.quads.data());
  HWY_DYNAMIC_DISPATCH(sum_quads)
  (scratch.quads.data(), rays.size, scratch.row.data(), scratch.intensity.data());
  // Passes twice as wide each time, the last one as strong as is left to do: at most 10 texels^2.
  const glm::vec2 texels_per_m(static_cast<double>(rays.size) / rays.length_m);
  const glm::vec2 spread = spread_per_m * depth_m * texels_per_m;
  glm::vec2 variance = 2.0f * kTent.part + spread * spread;
  for (int stride = 1; stride <= kWidestPass && variance != glm::vec2(0.0f); stride *= 2) {
    const auto unit = static_cast<float>(2 * stride * stride);
    const SoftPass pass = {glm::min(variance / unit, kTent.part), stride};
    HWY_DYNAMIC_DISPATCH(soften)
    (scratch.intensity.data(), rays.size, pass, scratch.row.data(), scratch.softened.data());
    std::swap(scratch.intensity, scratch.softened);
    variance = glm::max(variance - pass.part * unit, 0.0f);
  }
  return scratch.intensity;
}

}  // namespace swell::render
#endif  // HWY_ONCE
