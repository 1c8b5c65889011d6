#include "mesh_import/process_limits.h"

#include <sys/resource.h>

#include "scene/run_importer.h"

namespace swell::mesh_import {
namespace {

constexpr rlim_t kAddressSpace = rlim_t{6} << 30;

void limit(__rlimit_resource what, rlim_t most) {
  rlimit now{};
  if (getrlimit(what, &now) == 0 && now.rlim_max != RLIM_INFINITY && now.rlim_max < most)
    most = now.rlim_max;
  const rlimit lower{most, most};
  setrlimit(what, &lower);
}

}  // namespace

void limit_process() {
  limit(RLIMIT_CPU, scene::kMostImport_s);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which take terabytes
  limit(RLIMIT_AS, kAddressSpace);
#endif
}

}  // namespace swell::mesh_import
