#include "apps/shared/version.h"

#include <fmt/core.h>

#include "apps/shared/json.h"
#include "commit.h"
#include "math/simd_target.h"
#include "render/sameness_version.h"

namespace swell::apps {

std::string version() { return SWELL_VERSION; }

std::string full_version() {
  return fmt::format("{} (commit {}, {})", version(), SWELL_COMMIT,
                     simd_target_name(current_simd_target()));
}

std::string version_json(const std::string& program) {
  Json json = {{"program", program},
               {"version", version()},
               {"commit", SWELL_COMMIT},
               {"simd", simd_target_name(current_simd_target())},
               {"sameness", render::kSamenessVersion}};
  for (const SimdTarget target : simd_targets())
    if (simd_target_available(target)) json["simd_targets"].push_back(simd_target_name(target));
  return json.dump(1);
}

}  // namespace swell::apps
