// Where targets whose subject reads files put them: in memory if there is such a place.
#pragma once

#include <filesystem>

#include "scratch_folder.h"

namespace swell::fuzz {

inline std::filesystem::path scratch_parent() {
  std::error_code error;
  const bool has_memory = std::filesystem::is_directory("/dev/shm", error);
  return has_memory ? "/dev/shm" : std::filesystem::temp_directory_path();
}

}  // namespace swell::fuzz
