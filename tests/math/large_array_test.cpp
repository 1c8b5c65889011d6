#include "math/large_array.h"

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>

namespace swell {
namespace {

// Whether the system says of the mapping that holds this address that it was advised to use huge
// pages there.
bool is_advised(const void* address) {
  const auto wanted = reinterpret_cast<std::uintptr_t>(address);
  std::ifstream maps("/proc/self/smaps");
  bool here = false;
  for (std::string line; std::getline(maps, line);) {
    std::uintptr_t begin = 0, end = 0;
    char dash = 0;
    std::istringstream words(line);
    if (words >> std::hex >> begin >> dash >> end && dash == '-')
      here = begin <= wanted && wanted < end;
    else if (here && line.starts_with("VmFlags:"))
      return line.find(" hg") != std::string::npos;
  }
  return false;
}

TEST(LargeArray, AsksForHugePages) {
  if (!std::ifstream("/sys/kernel/mm/transparent_hugepage/enabled"))
    GTEST_SKIP() << "The system has none.";
  std::vector<int> large;
  resize_large(large, std::size_t{1} << 20);
  EXPECT_TRUE(is_advised(large.data()));
  EXPECT_TRUE(is_advised(&large.back()));
}

TEST(LargeArray, HoldsWhatAVectorHolds) {
  std::vector<int> array = {1, 2, 3};
  resize_large(array, std::size_t{1} << 20);
  EXPECT_EQ(array.size(), std::size_t{1} << 20);
  EXPECT_EQ(array[2], 3);
  EXPECT_EQ(array.back(), 0);
  const int* const before = array.data();
  resize_large(array, 2);
  resize_large(array, std::size_t{1} << 20);
  EXPECT_EQ(array.data(), before);
  EXPECT_EQ(array[1], 2);
  EXPECT_EQ(array[2], 0);
}

TEST(LargeArray, OfZeroPagesTakesMemoryWhereItIsWrittenTo) {
  const auto is_there = [](float* address) {
    char* const byte = reinterpret_cast<char*>(address);
    unsigned char flags = 0;
    EXPECT_EQ(mincore(byte - reinterpret_cast<std::uintptr_t>(byte) % 4096, 1, &flags), 0);
    return (flags & 1) != 0;
  };
  LargeArray<float> array;
  array.resize(std::size_t{1} << 26);  // 256 MB
  EXPECT_FALSE(is_there(&array[array.size() / 2]));
  array[array.size() / 4] = 1.0f;
  EXPECT_TRUE(is_there(&array[array.size() / 4]));
  EXPECT_EQ(array[array.size() / 2], 0.0f);
  EXPECT_EQ(array.back(), 0.0f);
}

TEST(LargeArray, OfZeroPagesHoldsWhatItHeldBefore) {
  LargeArray<int> array = {1, 2, 3};
  resize_large(array, std::size_t{1} << 20);
  EXPECT_EQ(array[2], 3);
  EXPECT_EQ(array.back(), 0);
  array.back() = 7;
  resize_large(array, 2);
  resize_large(array, std::size_t{1} << 20);
  EXPECT_EQ(array[1], 2);
  EXPECT_EQ(array.back(), 7);
}

TEST(LargeArray, TakesFewAndNone) {
  advise_huge_pages(nullptr, 0);
  std::vector<int> few;
  resize_large(few, 0);
  EXPECT_TRUE(few.empty());
  resize_large(few, 5);
  EXPECT_EQ(few, std::vector<int>(5));
}

}  // namespace
}  // namespace swell
