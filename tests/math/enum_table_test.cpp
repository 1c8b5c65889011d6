// Tables beside enumerations: what compiles, and what does not.
#include "math/enum_table.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <string>

namespace swell {
namespace {

enum class Light : std::uint8_t { kSun, kMoon, k3rd };
enum Plain : int { kFirst, kSecond };

class Owner {
  enum class Hidden { kOne, kTwo };

 public:
  static constexpr std::size_t kHidden = kEnumerators<Hidden>;
};

TEST(EnumTable, KnowsHowManyEnumeratorsThereAre) {
  EXPECT_EQ(kEnumerators<Light>, 3u);
  EXPECT_EQ(kEnumerators<Plain>, 2u);
  EXPECT_EQ(Owner::kHidden, 2u);
  EXPECT_EQ(kEnumerators<bool>, 2u);
  EXPECT_EQ(all_enumerators<Light>(), (std::array{Light::kSun, Light::kMoon, Light::k3rd}));
}

TEST(EnumTable, HasEachRowWhereItsEnumeratorIs) {
  constexpr auto kWords =
      enum_words<Light>({{Light::k3rd, "third"}, {Light::kSun, "sun"}, {Light::kMoon, "moon"}});
  EXPECT_EQ(kWords[Light::kSun], "sun");
  EXPECT_EQ(kWords[Light::kMoon], "moon");
  EXPECT_EQ(kWords[Light::k3rd], "third");
  const std::span<const std::string_view> in_order = kWords;
  EXPECT_EQ(in_order[1], "moon");
}

// Whether a table of these rows compiles.
template <EnumRow<Light, int>... kRows>
concept Compiles = requires {
  typename std::bool_constant<(enum_table<Light, int>({kRows...}), true)>;
};

TEST(EnumTable, CompilesOnlyWithARowForEachEnumerator) {
  using Row = EnumRow<Light, int>;
  constexpr Row kSun{Light::kSun, 1}, kMoon{Light::kMoon, 2}, kThird{Light::k3rd, 3};
  constexpr Row kNone{static_cast<Light>(3), 4};
  EXPECT_TRUE((Compiles<kThird, kSun, kMoon>));
  EXPECT_FALSE((Compiles<kSun, kMoon>));
  EXPECT_FALSE((Compiles<kSun, kMoon, kMoon>));
  EXPECT_FALSE((Compiles<kSun, kMoon, kNone>));
  EXPECT_FALSE((Compiles<kSun, kMoon, kThird, kSun>));
}

TEST(EnumTable, ListsAreCheckedForTheirNamesAndOrder) {
  struct Named {
    Light of;
    int value;
  };
  EXPECT_TRUE(
      lists_all(std::array{Named{Light::kSun, 1}, Named{Light::kMoon, 1}, Named{Light::k3rd, 1}},
                &Named::of));
  EXPECT_FALSE(lists_all(std::array{Named{Light::kSun, 1}, Named{Light::kMoon, 1}}, &Named::of));
  EXPECT_FALSE(
      lists_all(std::array{Named{Light::kMoon, 1}, Named{Light::kSun, 1}, Named{Light::k3rd, 1}},
                &Named::of));
}

}  // namespace
}  // namespace swell
