// Counts this program's calls of operator new, and their bytes; 0 under the sanitizers, which have
// operators of their own.
#pragma once

#include <cstdint>

namespace swell {
std::uint64_t allocation_count();
std::uint64_t allocated_bytes();
}  // namespace swell
