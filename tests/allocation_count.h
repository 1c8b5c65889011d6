// Counts this program's calls of operator new.
#pragma once

#include <cstdint>

namespace swell {
std::uint64_t allocation_count();
}
