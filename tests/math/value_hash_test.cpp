// Hashes by which things are found again.
#include "math/value_hash.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace swell {
namespace {

// XXH3's own vector for no bytes, 128 bits.
TEST(ValueHash, IsXxh3) {
  const ValueHash none{0x99aa06d3014798d8, 0x6001c324468d497f};
  EXPECT_EQ(ValueBytes().hash(), none);
}

TEST(ValueHash, TellsWhereAValueEnds) {
  std::set<ValueHash> hashes;
  const auto is_new = [&](const ValueBytes& bytes) { return hashes.insert(bytes.hash()).second; };
  EXPECT_TRUE(is_new(ValueBytes().add("ab").add("c")));
  EXPECT_TRUE(is_new(ValueBytes().add("a").add("bc")));
  EXPECT_TRUE(is_new(ValueBytes().add(std::vector{1, 2}).add(std::vector{3})));
  EXPECT_TRUE(is_new(ValueBytes().add(std::vector{1}).add(std::vector{2, 3})));
  EXPECT_TRUE(is_new(ValueBytes().add(std::optional(false))));
  EXPECT_TRUE(is_new(ValueBytes().add(std::optional<bool>())));
}

TEST(ValueHash, IsOfBits) {
  EXPECT_EQ(ValueBytes().add(glm::dvec2(1.0, 2.0)).hash(), ValueBytes().add(1.0).add(2.0).hash());
  EXPECT_NE(ValueBytes().add(0.0).hash(), ValueBytes().add(-0.0).hash());
  EXPECT_NE(ValueBytes().add(1.0f).hash(), ValueBytes().add(1.0).hash());
  EXPECT_NE(ValueBytes().add(0.1).hash(), ValueBytes().add(std::nextafter(0.1, 1.0)).hash());
}

}  // namespace
}  // namespace swell
