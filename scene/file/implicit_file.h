// Implicit surfaces as files have them: tables [[form]], one a part (docs/understand/forms.md).
#pragma once

#include <string>
#include <string_view>

#include "scene/implicit_surface.h"

namespace swell::scene {

// The tables' key; a scene file may have them beside its own.
inline constexpr std::string_view kImplicitsKey = "form";

// Throws SceneError for a file that cannot be read or says nothing that can be drawn.
ImplicitSurface load_implicit(const std::string& path);
ImplicitSurface parse_implicit(std::string_view text, const std::string& file_name);

}  // namespace swell::scene
