// Arrays that many places of are read at random: in pages of 2 MB, where the system has some, they
// need few entries of the processor's page table cache.
#pragma once

#include <cstddef>
#include <vector>

namespace swell {

// Advises the system to hold these bytes in huge pages. Pages are aligned, so that the advice
// reaches to the next multiples of 2 MB on both sides: several arrays of less then share one page.
// It changes no content, and costs at most what is left of the first and the last page. Does
// nothing for less than 256 KB, where the system has no such pages, and where they are switched
// off. Pages that were written to before stay small until the system joins them.
void advise_huge_pages(const void* begin, std::size_t bytes);

// Reserves room for `count` elements, in huge pages if they are many. Call it before the array is
// filled. Throws as std::vector::reserve() does.
template <class T>
void reserve_large(std::vector<T>& array, std::size_t count) {
  if (count <= array.capacity()) return;
  array.reserve(count);
  advise_huge_pages(array.data(), array.capacity() * sizeof(T));
}

// Resizes the array to `count` elements, with room as reserve_large() makes it.
template <class T>
void resize_large(std::vector<T>& array, std::size_t count) {
  reserve_large(array, count);
  array.resize(count);
}

// Makes such an array of `count` elements, each T().
template <class T>
std::vector<T> make_large(std::size_t count) {
  std::vector<T> array;
  resize_large(array, count);
  return array;
}

}  // namespace swell
