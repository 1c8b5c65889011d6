// Values as bytes that the same program reads again.
#include "math/archive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <string>

namespace swell {
namespace {

struct Point {
  float x = 0.0f;
  int n = 0;
  static constexpr bool kPlainBytes = true;
  bool operator==(const Point&) const = default;
};

struct Part {
  double size_m = 0.0;
  std::vector<Point> points = {};
  std::array<std::vector<std::uint8_t>, 2> rows = {};
  std::optional<glm::vec3> colour = {};

  auto fields() { return std::tie(size_m, points, rows, colour); }
  bool operator==(const Part&) const = default;
};

Part some_part() {
  return {std::numeric_limits<double>::denorm_min(),
          {{-0.0f, 1}, {2.5f, -3}},
          {std::vector<std::uint8_t>{1, 2, 3}, {}},
          glm::vec3(1, 2, 3)};
}

std::string written(Part part) {
  std::ostringstream to;
  ArchiveWriter writer(to);
  writer.add(part);
  writer.bytes().finish();
  return to.str();
}

Part read(const std::string& bytes) {
  std::istringstream from(bytes);
  ArchiveReader reader(from, bytes.size());
  Part part;
  reader.add(part);
  reader.bytes().finish();
  return part;
}

TEST(Archive, GivesBackWhatWasWritten) {
  EXPECT_EQ(read(written(some_part())), some_part());
  EXPECT_TRUE(std::signbit(read(written(some_part())).points[0].x));
  EXPECT_EQ(read(written({})), Part());
  const std::string bytes = written(some_part());
  EXPECT_EQ(bytes.size(), 8 + (8 + 2 * 8) + (8 + 3 + 8) + (1 + 12) + 16u);
}

TEST(Archive, TellsOfEachByteThatChanged) {
  const std::string bytes = written(some_part());
  for (std::size_t k = 0; k < bytes.size(); ++k)
    for (const int change : {1, 128, 255}) {
      std::string changed = bytes;
      changed[k] = static_cast<char>(changed[k] ^ change);
      EXPECT_THROW(read(changed), ArchiveError) << k;
    }
}

// A count of elements that are not there makes no room for them.
TEST(Archive, TellsWhereItEndsTooSoonOrTooLate) {
  const std::string bytes = written(some_part());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(read(bytes.substr(0, size)), ArchiveError) << size;
  EXPECT_THROW(read(bytes + '\0'), ArchiveError);
  std::string many = bytes;
  many.replace(8, 8, 8, '\x7f');
  EXPECT_THROW(read(many), ArchiveError);
}

}  // namespace
}  // namespace swell
