#include "render/materials/object.h"

#include "render/frame/parts.h"
#include "render/sky/light.h"
#include "render/view/objects_drawn.h"
#include "render/view/render_view.h"

namespace swell::render {

void fill(const MaterialInputs& in, const RenderView& view, Object& object) {
  object.primitives = in.objects.drawn_in(view.kind).primitives;
  object.has_textures = !in.without.has(Part::kTextures);
  // Besides its own light the sea mirrors some of the sky.
  object.sea_light = in.media.body + 0.15f * in.light.ambient;
}

}  // namespace swell::render
