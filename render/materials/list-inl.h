// The per-pixel code of the materials in list.h, one line each: tile/surfel-inl.h says what each
// file holds.
#if defined(SWELL_RENDER_MATERIALS_LIST_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_LIST_INL_H_
#undef SWELL_RENDER_MATERIALS_LIST_INL_H_
#else
#define SWELL_RENDER_MATERIALS_LIST_INL_H_
#endif

#include "render/materials/object-inl.h"
#include "render/materials/river-inl.h"
#include "render/materials/terrain-inl.h"
#include "render/materials/tree-inl.h"
#include "render/materials/underside-inl.h"

#endif  // per-target include guard
