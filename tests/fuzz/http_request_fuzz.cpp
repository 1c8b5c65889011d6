// A request to the viewer's server: head, query, body, access rules, events.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "apps/serve/routes.h"
#include "fuzz/expect.h"

namespace swell::fuzz {
namespace {

constexpr std::string_view kToken = "0123";

// With a token that the corpus knows, and without one.
void answer(const serve::Request& request, std::string_view token) {
  int events = 0;
  const serve::Site site{
      {{"localhost", "127.0.0.1", "::1"}, {"sea.example"}, std::string(token), 8123},
      [&](const SDL_Event&) { ++events; },
      [] { return std::string("[camera]\n"); }};
  const serve::Verdict verdict = serve::judge(request, site.rules);
  expect(verdict.line.find('\n') == std::string::npos, "a refusal is one line");
  expect((verdict.status == 200) == verdict.line.empty(), "a refusal has a reason");
  if (verdict.status != 200) return;
  const serve::Reply reply = serve::reply_to(request, site);
  expect(reply.status < 500, "no request makes the server fail");
  expect(reply.status == 204 || events == 0, "events of a refused message are not taken");
}

void read_request(std::string_view bytes) {
  const serve::ParsedRequest parsed = serve::parse_request(bytes);
  if (parsed.status != 200) return;
  expect(parsed.request.body.size() <= serve::kMostBytes, "a body is bounded");
  std::size_t head = parsed.request.target.size();
  for (const auto& [name, value] : parsed.request.fields) head += name.size() + value.size();
  expect(head <= serve::kMostBytes, "a head is bounded");
  answer(parsed.request, kToken);
  answer(parsed.request, {});
}

}  // namespace
}  // namespace swell::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  swell::fuzz::read_request({reinterpret_cast<const char*>(data), size});
  return 0;
}
