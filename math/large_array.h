// Arrays that many places of are read at random: in pages of 2 MB, where the system has some, they
// need few entries of the processor's page table cache.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <type_traits>
#include <vector>

namespace swell {

// Advises the system to hold these bytes in huge pages. Pages are aligned, so that the advice
// reaches to the next multiples of 2 MB on both sides: several arrays of less then share one page.
// It changes no content, and costs at most what is left of the first and the last page. Does
// nothing for less than 256 KB, where the system has no such pages, and where they are switched
// off. Pages that were written to before stay small until the system joins them.
void advise_huge_pages(const void* begin, std::size_t bytes);

// Memory of zeros that the system clears page by page where it is first written to: pages that
// nothing is written to take none, and whoever fills an array clears its part.
template <class T>
class ZeroPages {
 public:
  using value_type = T;
  static_assert(std::is_trivially_destructible_v<T> && alignof(T) <= alignof(std::max_align_t));

  ZeroPages() = default;
  template <class U>
  explicit(false) ZeroPages(const ZeroPages<U>&) {}

  T* allocate(std::size_t count) {
    if (void* const begin = std::calloc(count, sizeof(T))) return static_cast<T*>(begin);
    throw std::bad_alloc();
  }
  void deallocate(T* begin, std::size_t) { std::free(begin); }
  void construct(T*) {}

  bool operator==(const ZeroPages&) const = default;
};

// For arrays that are filled after they were given their size: what resize() adds holds zeros or
// what the array held there before.
template <class T>
using LargeArray = std::vector<T, ZeroPages<T>>;

// Reserves room for `count` elements, in huge pages if they are many. Call it before the array is
// filled. Throws as std::vector::reserve() does.
template <class T, class Memory>
void reserve_large(std::vector<T, Memory>& array, std::size_t count) {
  if (count <= array.capacity()) return;
  array.reserve(count);
  advise_huge_pages(array.data(), array.capacity() * sizeof(T));
}

// Resizes the array to `count` elements, with room as reserve_large() makes it.
template <class T, class Memory>
void resize_large(std::vector<T, Memory>& array, std::size_t count) {
  reserve_large(array, count);
  array.resize(count);
}

// Makes such an array of `count` zeros.
template <class T>
LargeArray<T> make_large(std::size_t count) {
  LargeArray<T> array;
  resize_large(array, count);
  return array;
}

}  // namespace swell
