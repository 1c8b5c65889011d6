// Forms as files have them: tables [[form]], one a part (docs/forms.md).
#pragma once

#include <string>
#include <string_view>

#include "scene/form.h"

namespace swell::scene {

// The tables' key; a scene file may have them beside its own.
inline constexpr std::string_view kFormsKey = "form";

// Throws SceneError for a file that cannot be read or says nothing that can be drawn.
Form load_form(const std::string& path);
Form parse_form(std::string_view text, const std::string& file_name);

}  // namespace swell::scene
