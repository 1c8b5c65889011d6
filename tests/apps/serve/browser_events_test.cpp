// Events of browsers as SDL's.
#include "apps/serve/browser_events.h"

#include <gtest/gtest.h>

#include "apps/view/keys.h"

namespace swell::serve {
namespace {

TEST(BrowserEvents, AreThoseOfSdl) {
  const std::vector<SDL_Event> events = parse_events(
      R"([{"type":"key","code":"KeyW","down":true},
          {"type":"move","x":10.4,"y":20.6,"dx":3,"dy":-2},
          {"type":"button","button":2,"down":false,"x":1,"y":2},
          {"type":"wheel","y":-1},
          {"type":"text","text":"7"}])");
  ASSERT_EQ(events.size(), 6u);
  EXPECT_EQ(events[0].type, SDL_KEYDOWN);
  EXPECT_EQ(events[0].key.keysym.scancode, SDL_SCANCODE_W);
  EXPECT_EQ(events[1].type, SDL_MOUSEMOTION);
  EXPECT_EQ(events[1].motion.x, 10);
  EXPECT_EQ(events[1].motion.y, 21);
  EXPECT_EQ(events[1].motion.xrel, 3);
  EXPECT_EQ(events[2].type, SDL_MOUSEMOTION);  // to where the button was
  EXPECT_EQ(events[3].type, SDL_MOUSEBUTTONUP);
  EXPECT_EQ(events[3].button.button, SDL_BUTTON_RIGHT);
  EXPECT_EQ(events[4].wheel.y, -1);
  EXPECT_STREQ(events[5].text.text, "7");
}

TEST(BrowserEvents, DigitsAreKeysThatChooseSeaStates) {
  for (int code = 0; code <= 9; ++code) {
    const auto events = parse_events(R"([{"type":"key","code":"Digit)" + std::to_string(code) +
                                     R"(","down":true}])");
    ASSERT_EQ(events.size(), 1u) << code;
    EXPECT_EQ(view::sea_state_for(events[0].key.keysym.sym), code);
  }
}

TEST(BrowserEvents, NoKeyEndsTheViewerOrActsOnItsMachine) {
  for (const char* code : {"Escape", "F5", "F11", "F12", "KeyC", "ControlLeft", ""})
    EXPECT_TRUE(
        parse_events(R"([{"type":"key","down":true,"code":")" + std::string(code) + "\"}]").empty())
        << code;
}

TEST(BrowserEvents, NumbersAreKeptWithinBounds) {
  const auto events = parse_events(R"([{"type":"move","x":1e300,"y":-1e300,"dx":0,"dy":0}])");
  EXPECT_EQ(events.at(0).motion.x, 16384);
  EXPECT_EQ(events.at(0).motion.y, -16384);
}

TEST(BrowserEvents, BadOnesAreRefused) {
  std::string many = "[";
  for (int i = 0; i < 257; ++i) many += R"({"type":"leave"},)";
  many.back() = ']';
  for (const std::string& text :
       {std::string("{}"), std::string("nonsense"), std::string("[1]"), many,
        std::string(R"([{"type":"dance"}])"), std::string(R"([{"code":"KeyW"}])"),
        std::string(R"([{"type":"key","code":"KeyW","down":"yes"}])"),
        std::string(R"([{"type":"move","x":"1","y":0,"dx":0,"dy":0}])"),
        std::string(R"([{"type":"button","button":0,"down":1,"x":0,"y":0}])"),
        R"([{"type":"text","text":")" + std::string(32, 'a') + "\"}]"})
    EXPECT_THROW(parse_events(text), EventError) << text.substr(0, 60);
}

TEST(BrowserEvents, AreObjectsOfPlainValues) {
  const auto with = [](const std::string& value) {
    return parse_events(R"([{"type":"button","button":0,"down":true,"x":1,"y":2,"more":)" + value +
                        "}]");
  };
  EXPECT_EQ(with("1").size(), 2u);
  EXPECT_THROW(with("[]"), EventError);
  EXPECT_THROW(with("{}"), EventError);
  EXPECT_THROW(with(std::string(30000, '[') + std::string(30000, ']')), EventError);
}

}  // namespace
}  // namespace swell::serve
