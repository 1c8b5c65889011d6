// Requests from bytes, as fuzzers make them.
#include <gtest/gtest.h>

#include "apps/serve/http_request.h"
#include "apps/serve/routes.h"

namespace swell::serve {
namespace {

TEST(RequestBytes, BecomeARequest) {
  const ParsedRequest parsed = parse_request(
      "POST /input?a=b&token=1 HTTP/1.1\r\nHost: localhost\r\ncontent-length: 2\r\n\r\n[]rest");
  EXPECT_EQ(parsed.status, 200);
  EXPECT_EQ(parsed.request.method, "POST");
  EXPECT_EQ(parsed.request.path(), "/input");
  EXPECT_EQ(parsed.request.query_value("token"), "1");
  EXPECT_EQ(parsed.request.query_value("a"), "b");
  EXPECT_EQ(parsed.request.query_value("b"), "");
  EXPECT_EQ(parsed.request.values("HOST").at(0), "localhost");
  EXPECT_EQ(parsed.request.body, "[]");
}

TEST(RequestBytes, AreBounded) {
  EXPECT_EQ(parse_request("GET / HTTP/1.1\r\nA: b\r\n").status, 0);
  EXPECT_EQ(parse_request("GET / HTTP/1.1\r\nA: " + std::string(70000, 'b')).status, 431);
  EXPECT_EQ(parse_request("POST / HTTP/1.1\r\nContent-Length: 65537\r\n\r\n").status, 413);
  EXPECT_EQ(parse_request("POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n"
                          "7FFFFFFFFFFFFFFF\r\n")
                .status,
            413);
  EXPECT_EQ(parse_request("nonsense\r\n\r\n").status, 400);
  EXPECT_EQ(parse_request("").status, 0);
}

TEST(RequestBytes, TakeNoEventOfAMessageThatIsPartlyBad) {
  int events = 0;
  const Site site{{{"localhost"}, {}, "", 80}, [&](const SDL_Event&) { ++events; }, {}};
  const Request bad{"POST", "/input", {}, R"([{"type":"leave"},{"type":"dance"}])"};
  EXPECT_EQ(reply_to(bad, site).status, 400);
  EXPECT_EQ(events, 0);
}

}  // namespace
}  // namespace swell::serve
