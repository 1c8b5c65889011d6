#include "allocation_count.h"

#include <atomic>
#include <cstdlib>
#include <new>

#ifdef SWELL_SANITIZED
namespace swell {
std::uint64_t allocation_count() { return 0; }
std::uint64_t allocated_bytes() { return 0; }
}  // namespace swell
#else
namespace {

std::atomic<std::uint64_t> count = 0, bytes = 0;

void* counted(std::size_t size, std::size_t alignment) {
  ++count;
  bytes += size;
  const std::size_t whole = (size + alignment - 1) / alignment * alignment;
  if (void* p = std::aligned_alloc(alignment, whole == 0 ? alignment : whole)) return p;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return counted(size, 16); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
// As the library's own does, but it must be this program's for delete to match.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return counted(size, 16);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

namespace swell {
std::uint64_t allocation_count() { return count; }
std::uint64_t allocated_bytes() { return bytes; }
}  // namespace swell
#endif
