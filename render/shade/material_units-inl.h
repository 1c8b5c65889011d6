// The door to the materials, each of which is a translation unit (material_unit.cpp.in): one call a
// tile and material.
#if defined(SWELL_RENDER_SHADE_MATERIAL_UNITS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_SHADE_MATERIAL_UNITS_INL_H_
#undef SWELL_RENDER_SHADE_MATERIAL_UNITS_INL_H_
#else
#define SWELL_RENDER_SHADE_MATERIAL_UNITS_INL_H_
#endif

#include "render/labels/shaded_labels.h"
#include "render/shade/pixel_lists-inl.h"
#include "render/tile/shading_result-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Shades the pixels of material M in the view of s.kind, and in the window the tile's fragments of
// it; their colours go into `scratch`, and what labels want of the window's pixels into `labels`,
// if any. Defined in the unit of M.
template <class M>
void ShadeMaterial(const Shading& s, const TilePixels& tile, const PixelList& list,
                   ShadeScratch& scratch, ShadedLabels* labels);

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
