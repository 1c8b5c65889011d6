// Which Swell this is.
#pragma once

#include <string>

namespace swell::apps {

// "0.9.0".
std::string version();

// "0.9.0 (commit 0123456789ab, avx512)": with the commit that was built, "unknown" outside a
// repository and with a "+" for changes since, and the SIMD target that this CPU gets.
std::string full_version();

// One object: "program", "version", "commit", "simd" (the target that this CPU gets),
// "simd_targets" (all that it has) and "sameness" (render/sameness_version.h).
std::string version_json(const std::string& program);

}  // namespace swell::apps
