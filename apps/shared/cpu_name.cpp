#include "apps/shared/cpu_name.h"

#include <cpuid.h>

#include <array>
#include <cstring>

namespace swell::apps {

std::string cpu_name() {
  // The brand string: three leaves of 16 bytes, padded with zeros or spaces.
  constexpr unsigned kFirstLeaf = 0x80000002, kLeaves = 3;
  std::array<unsigned, 4 * kLeaves> words{};
  for (unsigned leaf = 0; leaf < kLeaves; ++leaf) {
    unsigned* const w = &words[4 * leaf];
    if (__get_cpuid(kFirstLeaf + leaf, &w[0], &w[1], &w[2], &w[3]) == 0) return "unknown";
  }
  std::array<char, sizeof(words) + 1> text{};
  std::memcpy(text.data(), words.data(), sizeof(words));

  // Printable characters, single spaces.
  std::string name;
  for (const char* c = text.data(); *c != '\0'; ++c) {
    if (*c > ' ' && *c <= '~') name += *c;
    if (*c == ' ' && !name.empty() && name.back() != ' ') name += ' ';
  }
  if (!name.empty() && name.back() == ' ') name.pop_back();
  return name.empty() ? "unknown" : name;
}

}  // namespace swell::apps
