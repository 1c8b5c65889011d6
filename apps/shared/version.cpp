#include "apps/shared/version.h"

#include <fmt/core.h>

#include "commit.h"
#include "math/simd_target.h"

namespace swell::apps {

std::string version() { return SWELL_VERSION; }

std::string full_version() {
  return fmt::format("{} (commit {}, {})", version(), SWELL_COMMIT,
                     simd_target_name(current_simd_target()));
}

}  // namespace swell::apps
