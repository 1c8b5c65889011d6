// Boost.Beast's parser with this server's limits, which are settings of its own.
#pragma once

#include <boost/beast/http.hpp>

#include "apps/serve/http_request.h"

namespace swell::serve {

class RequestParser : public boost::beast::http::request_parser<boost::beast::http::string_body> {
 public:
  RequestParser() {
    header_limit(static_cast<std::uint32_t>(kMostBytes));
    body_limit(kMostBytes);
  }
  Request head() const;  // without the body
};

// What a fault of the parser, or of the buffer it reads from, is answered with.
int status_of(const boost::system::error_code& error, bool head_is_done);

}  // namespace swell::serve
