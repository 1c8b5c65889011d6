#include "apps/shared/cpu_name.h"

#include <array>
#include <fstream>
#include <string_view>
#include <utility>

namespace swell::apps {
namespace {

// Arm's own cores, by their "CPU part".
constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kArmParts = {
    {{"0xd03", "Cortex-A53"},
     {"0xd05", "Cortex-A55"},
     {"0xd08", "Cortex-A72"},
     {"0xd0b", "Cortex-A76"},
     {"0xd0c", "Neoverse N1"},
     {"0xd40", "Neoverse V1"},
     {"0xd41", "Cortex-A78"},
     {"0xd42", "Cortex-A78AE"},
     {"0xd49", "Neoverse N2"},
     {"0xd4f", "Neoverse V2"}}};
constexpr std::string_view kArm = "0x41";  // as "CPU implementer"

// The value of a line "KEY : VALUE"; "" of other lines.
std::string value_of(const std::string& line, std::string_view key) {
  if (!line.starts_with(key)) return "";
  const std::size_t begin = line.find_first_not_of(" \t:", key.size());
  return begin == std::string::npos ? "" : line.substr(begin);
}

std::string arm_name(const std::string& implementer, const std::string& part) {
  if (implementer == kArm)
    for (const auto& [number, name] : kArmParts)
      if (part == number) return std::string(name);
  return "Arm part " + part;
}

}  // namespace

std::string cpu_name(std::istream& processors) {
  std::string implementer;
  for (std::string line; std::getline(processors, line);) {
    if (const std::string name = value_of(line, "model name"); !name.empty()) return name;
    if (const std::string maker = value_of(line, "CPU implementer"); !maker.empty())
      implementer = maker;
    if (const std::string part = value_of(line, "CPU part"); !part.empty())
      return arm_name(implementer, part);
  }
  return "unknown";
}

std::string cpu_name() {
  std::ifstream processors("/proc/cpuinfo");
  return cpu_name(processors);
}

}  // namespace swell::apps
