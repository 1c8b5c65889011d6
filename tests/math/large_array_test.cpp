#include "math/large_array.h"

#include <gtest/gtest.h>

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
