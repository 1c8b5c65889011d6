#include "apps/serve/http_request.h"

#include <algorithm>

namespace swell::serve {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

bool equals_ignoring_case(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, {}, lower, lower);
}

std::string_view Request::path() const {
  return std::string_view(target).substr(0, target.find('?'));
}

std::string_view Request::query_value(std::string_view key) const {
  std::string_view rest = target;
  rest.remove_prefix(std::min(path().size() + 1, rest.size()));
  while (!rest.empty()) {
    const std::string_view pair = rest.substr(0, rest.find('&'));
    rest.remove_prefix(std::min(pair.size() + 1, rest.size()));
    if (pair.size() > key.size() && pair.starts_with(key) && pair[key.size()] == '=')
      return pair.substr(key.size() + 1);
  }
  return {};
}

std::vector<std::string_view> Request::values(std::string_view field) const {
  std::vector<std::string_view> found;
  for (const auto& [name, value] : fields)
    if (equals_ignoring_case(name, field)) found.push_back(value);
  return found;
}

}  // namespace swell::serve
