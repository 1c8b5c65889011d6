// A request of HTTP, as far as the server looks at it. Free of sockets, so that tests and fuzzers
// make requests of bytes alone.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace swell::serve {

struct Request {
  std::string method, target;  // as sent: "GET", "/?token=12"
  std::vector<std::pair<std::string, std::string>> fields;
  std::string body;

  std::string_view path() const;                             // the target up to its '?'
  std::string_view query_value(std::string_view key) const;  // as sent; empty if there is none
  std::vector<std::string_view> values(std::string_view field) const;  // of any letter case
};

inline constexpr std::size_t kMostBytes = 65536;  // of a request's head, and of its body

// The first request of these bytes, as a connection reads it.
struct ParsedRequest {
  int status = 200;  // 200: whole; else why it is refused; 0: more bytes are needed
  Request request;
};
ParsedRequest parse_request(std::string_view bytes);

bool equals_ignoring_case(std::string_view a, std::string_view b);

}  // namespace swell::serve
