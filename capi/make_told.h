// Worlds whose caller is told how far they are, and may end their making.
#pragma once

#include <functional>
#include <memory>

#include "capi/handles.h"

namespace swell::capi {

// Returns make(making), which may run on a thread of its own: the calling thread calls the
// functions of `scene` meanwhile. Throws what make() throws, and Stopped if the caller ends it.
std::shared_ptr<const NamedWorld> make_told(
    const swell_scene& scene,
    const std::function<std::shared_ptr<const NamedWorld>(render::WorldMaking)>& make);

}  // namespace swell::capi
