#include "apps/serve/browser_events.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

namespace swell::serve {
namespace {

using Json = nlohmann::json;

struct Key {
  std::string_view code;
  SDL_Scancode place;
  SDL_Keycode key;
};

// Escape, which ends the viewer, and keys that act on the machine it runs on are not among them.
constexpr std::array kKeys = {
    Key{"KeyA", SDL_SCANCODE_A, SDLK_a},
    Key{"KeyD", SDL_SCANCODE_D, SDLK_d},
    Key{"KeyE", SDL_SCANCODE_E, SDLK_e},
    Key{"KeyH", SDL_SCANCODE_H, SDLK_h},
    Key{"KeyP", SDL_SCANCODE_P, SDLK_p},
    Key{"KeyQ", SDL_SCANCODE_Q, SDLK_q},
    Key{"KeyR", SDL_SCANCODE_R, SDLK_r},
    Key{"KeyS", SDL_SCANCODE_S, SDLK_s},
    Key{"KeyW", SDL_SCANCODE_W, SDLK_w},
    Key{"Digit0", SDL_SCANCODE_0, SDLK_0},
    Key{"Digit1", SDL_SCANCODE_1, SDLK_1},
    Key{"Digit2", SDL_SCANCODE_2, SDLK_2},
    Key{"Digit3", SDL_SCANCODE_3, SDLK_3},
    Key{"Digit4", SDL_SCANCODE_4, SDLK_4},
    Key{"Digit5", SDL_SCANCODE_5, SDLK_5},
    Key{"Digit6", SDL_SCANCODE_6, SDLK_6},
    Key{"Digit7", SDL_SCANCODE_7, SDLK_7},
    Key{"Digit8", SDL_SCANCODE_8, SDLK_8},
    Key{"Digit9", SDL_SCANCODE_9, SDLK_9},
    Key{"Space", SDL_SCANCODE_SPACE, SDLK_SPACE},
    Key{"ShiftLeft", SDL_SCANCODE_LSHIFT, SDLK_LSHIFT},
    Key{"ShiftRight", SDL_SCANCODE_RSHIFT, SDLK_RSHIFT},
    Key{"Period", SDL_SCANCODE_PERIOD, SDLK_PERIOD},
    Key{"F1", SDL_SCANCODE_F1, SDLK_F1},
    Key{"F2", SDL_SCANCODE_F2, SDLK_F2},
    Key{"F3", SDL_SCANCODE_F3, SDLK_F3},
    Key{"F4", SDL_SCANCODE_F4, SDLK_F4},
    Key{"ArrowLeft", SDL_SCANCODE_LEFT, SDLK_LEFT},
    Key{"ArrowRight", SDL_SCANCODE_RIGHT, SDLK_RIGHT},
    Key{"Backspace", SDL_SCANCODE_BACKSPACE, SDLK_BACKSPACE},
    Key{"Delete", SDL_SCANCODE_DELETE, SDLK_DELETE},
    Key{"Enter", SDL_SCANCODE_RETURN, SDLK_RETURN},
    Key{"Tab", SDL_SCANCODE_TAB, SDLK_TAB},
};

template <class T>
T value_of(const Json& event, const char* key) {
  const auto found = event.find(key);
  if (found == event.end()) throw EventError(fmt::format("no \"{}\" in an event", key));
  try {
    // The library would cast -1 and 1e300 too.
    if constexpr (std::is_same_v<T, std::size_t>)
      if (!found->is_number_unsigned())
        throw EventError(fmt::format("\"{}\" of an event is no whole number from 0 on", key));
    return found->get<T>();
  } catch (const Json::exception&) {
    throw EventError(fmt::format("\"{}\" of an event is of the wrong kind", key));
  }
}

int pixels_of(const Json& event, const char* key) {
  constexpr double kMost_px = 16384.0;
  const auto value = value_of<double>(event, key);
  if (!std::isfinite(value)) throw EventError(fmt::format("\"{}\" of an event is no number", key));
  return static_cast<int>(std::lround(std::clamp(value, -kMost_px, kMost_px)));
}

void add_key(const Json& json, std::vector<SDL_Event>& events) {
  const auto code = value_of<std::string>(json, "code");
  const auto known = std::ranges::find(kKeys, code, &Key::code);
  if (known == kKeys.end()) return;
  SDL_Event event{};
  const bool is_down = value_of<bool>(json, "down");
  event.key.type = is_down ? SDL_KEYDOWN : SDL_KEYUP;
  event.key.state = is_down ? SDL_PRESSED : SDL_RELEASED;
  event.key.repeat = json.contains("repeat") && value_of<bool>(json, "repeat");
  event.key.keysym.scancode = known->place;
  event.key.keysym.sym = known->key;
  events.push_back(event);
}

void add_text(const Json& json, std::vector<SDL_Event>& events) {
  const auto text = value_of<std::string>(json, "text");
  SDL_Event event{};
  event.type = SDL_TEXTINPUT;
  if (text.size() >= sizeof event.text.text) throw EventError("\"text\" of an event is too long");
  std::ranges::copy(text, event.text.text);
  events.push_back(event);
}

SDL_Event motion_to(const Json& json) {
  SDL_Event event{};
  event.type = SDL_MOUSEMOTION;
  event.motion.x = pixels_of(json, "x");
  event.motion.y = pixels_of(json, "y");
  return event;
}

void add_move(const Json& json, std::vector<SDL_Event>& events) {
  SDL_Event event = motion_to(json);
  event.motion.xrel = pixels_of(json, "dx");
  event.motion.yrel = pixels_of(json, "dy");
  events.push_back(event);
}

void add_button(const Json& json, std::vector<SDL_Event>& events) {
  constexpr std::array<Uint8, 3> kButtons = {SDL_BUTTON_LEFT, SDL_BUTTON_MIDDLE, SDL_BUTTON_RIGHT};
  const auto button = value_of<std::size_t>(json, "button");
  if (button >= kButtons.size()) return;
  // Where it is pressed counts, even if no motion was sent.
  const SDL_Event move = motion_to(json);
  events.push_back(move);
  SDL_Event event{};
  const bool is_down = value_of<bool>(json, "down");
  event.button.type = is_down ? SDL_MOUSEBUTTONDOWN : SDL_MOUSEBUTTONUP;
  event.button.state = is_down ? SDL_PRESSED : SDL_RELEASED;
  event.button.button = kButtons[button];
  event.button.clicks = 1;
  event.button.x = move.motion.x;
  event.button.y = move.motion.y;
  events.push_back(event);
}

void add_wheel(const Json& json, std::vector<SDL_Event>& events) {
  SDL_Event event{};
  event.type = SDL_MOUSEWHEEL;
  event.wheel.y = std::clamp(pixels_of(json, "y"), -10, 10);
  event.wheel.preciseY = static_cast<float>(event.wheel.y);
  events.push_back(event);
}

void add_window_event(SDL_WindowEventID what, std::vector<SDL_Event>& events) {
  SDL_Event event{};
  event.type = SDL_WINDOWEVENT;
  event.window.event = static_cast<Uint8>(what);
  events.push_back(event);
}

void add_event(const Json& json, std::vector<SDL_Event>& events) {
  if (!json.is_object()) throw EventError("an event is no object");
  const auto type = value_of<std::string>(json, "type");
  if (type == "key") return add_key(json, events);
  if (type == "text") return add_text(json, events);
  if (type == "move") return add_move(json, events);
  if (type == "button") return add_button(json, events);
  if (type == "wheel") return add_wheel(json, events);
  if (type != "leave") throw EventError("\"type\" of an event is unknown");
  add_window_event(SDL_WINDOWEVENT_LEAVE, events);
  add_window_event(SDL_WINDOWEVENT_FOCUS_LOST, events);
}

// Events are objects of plain values in an array. What lies deeper is refused while it is read:
// each level costs memory, and stack wherever values are copied.
bool is_shallow(int depth, Json::parse_event_t event, Json& /*parsed*/) {
  constexpr int kMostDepth = 2;
  const bool is_opened =
      event == Json::parse_event_t::array_start || event == Json::parse_event_t::object_start;
  if (is_opened && depth >= kMostDepth) throw EventError("an event holds more than plain values");
  return true;
}

}  // namespace

std::vector<SDL_Event> parse_events(const std::string& json) {
  const Json all = Json::parse(json, is_shallow, false);
  if (!all.is_array()) throw EventError("no JSON array of events");
  if (all.size() > kMostEvents)
    throw EventError(fmt::format("{} events, allowed {} at once", all.size(), kMostEvents));
  std::vector<SDL_Event> events;
  for (const Json& one : all) add_event(one, events);
  return events;
}

}  // namespace swell::serve
