#include "apps/shared/cpu_name.h"

#include <fstream>

namespace swell::apps {

std::string cpu_name() {
  std::ifstream processors("/proc/cpuinfo");
  for (std::string line; std::getline(processors, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t begin = line.find_first_not_of(" \t:", std::string("model name").size());
    if (begin != std::string::npos) return line.substr(begin);
  }
  return "unknown";
}

}  // namespace swell::apps
