#include "math/large_array.h"

#include <cstdint>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace swell {

void advise_huge_pages([[maybe_unused]] const void* begin, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  constexpr std::size_t kLeastBytes = std::size_t{256} << 10;
  constexpr std::uintptr_t kPage = std::uintptr_t{2} << 20;
  if (bytes < kLeastBytes) return;
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = address / kPage * kPage;
  const std::uintptr_t end = (address + bytes + kPage - 1) / kPage * kPage;
  // Where nothing is mapped beside the array it fails, after it has done the rest; the same where
  // there are no such pages.
  static_cast<void>(madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE));
#endif
}

}  // namespace swell
