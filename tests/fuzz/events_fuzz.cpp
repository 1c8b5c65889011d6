// Events of a browser: the body of POST /input.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "apps/serve/browser_events.h"
#include "fuzz/expect.h"

namespace swell::fuzz {
namespace {

constexpr std::size_t kMostForOne = 2;  // events of SDL that one of a browser is

void read_events(const std::string& body) {
  try {
    expect(serve::parse_events(body).size() <= kMostForOne * serve::kMostEvents,
           "a message holds no more events than it may");
  } catch (const serve::EventError& error) {
    expect(std::string_view(error.what()).find('\n') == std::string_view::npos,
           "what events are refused with is one line");
  }
}

}  // namespace
}  // namespace swell::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  swell::fuzz::read_events({reinterpret_cast<const char*>(data), size});
  return 0;
}
