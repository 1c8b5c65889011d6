#include "apps/serve/request_parser.h"

#include <boost/asio/buffer.hpp>

namespace swell::serve {

namespace http = boost::beast::http;

Request RequestParser::head() const {
  const auto& message = get();
  const auto text = [](const auto& view) { return std::string(view.data(), view.size()); };
  Request request{text(message.method_string()), text(message.target()), {}, {}};
  for (const auto& field : message)
    request.fields.emplace_back(text(field.name_string()), text(field.value()));
  return request;
}

int status_of(const boost::system::error_code& error, bool head_is_done) {
  if (error == http::error::body_limit) return 413;
  if (error == http::error::header_limit || error == http::error::buffer_overflow)
    return head_is_done ? 413 : 431;
  return 400;
}

ParsedRequest parse_request(std::string_view bytes) {
  RequestParser parser;
  parser.eager(true);
  boost::system::error_code error;
  while (!parser.is_done()) {
    const std::size_t used = parser.put(boost::asio::buffer(bytes.data(), bytes.size()), error);
    bytes.remove_prefix(used);
    if (error == http::error::need_more && bytes.size() < kMostBytes) return {0, {}};
    if (error) return {status_of(error, parser.is_header_done()), {}};
    if (used == 0) break;
  }
  if (!parser.is_done()) return {0, {}};
  ParsedRequest parsed{200, parser.head()};
  parsed.request.body = std::move(parser.get().body());
  return parsed;
}

}  // namespace swell::serve
