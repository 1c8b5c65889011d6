// What a browser says of its keyboard and mouse, as events of SDL.
#pragma once

#include <SDL.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace swell::serve {

// What is wrong with events that were sent; one line.
class EventError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline constexpr std::size_t kMostEvents = 256;  // in a message

// A message is a JSON array of objects. Places are pixels of the picture, x to the right, y down,
// within 16384 of 0; buttons as browsers number them (0 left, 1 middle, 2 right).
//   {"type": "key", "code": "KeyW", "down": true, "repeat": false}   code: of KeyboardEvent
//   {"type": "text", "text": "7"}                                    up to 31 bytes
//   {"type": "move", "x": 10, "y": 20, "dx": 1, "dy": 0}
//   {"type": "button", "button": 0, "down": true, "x": 10, "y": 20}
//   {"type": "wheel", "y": -1}                                       1: away from the user
//   {"type": "leave"}                                 the pointer or the focus is elsewhere
// Keys that the viewer does not know, or that would end it, are left out. Throws EventError.
std::vector<SDL_Event> parse_events(const std::string& json);

}  // namespace swell::serve
