#include "scene/file/spelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace swell::scene {

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    int diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const int substituted = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

std::string did_you_mean(std::string_view name) {
  return fmt::format(" (did you mean '{}'?)", name);
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> names) {
  constexpr std::size_t kLongest = 100;
  if (names.empty() || word.size() > kLongest) return {};
  const auto distance = [&](std::string_view name) { return edit_distance(word, name); };
  const std::string_view nearest = *std::ranges::min_element(names, {}, distance);
  const int most = std::max(1, static_cast<int>(std::min(word.size(), nearest.size()) / 3));
  const bool is_turned = distance(nearest) == 2 && std::ranges::is_permutation(word, nearest);
  return is_turned || distance(nearest) <= most ? did_you_mean(nearest) : "";
}

}  // namespace swell::scene
