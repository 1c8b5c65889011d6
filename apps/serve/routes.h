// What the server answers: a function of the request and of the viewer's state, free of sockets.
//   GET /             the page
//   GET /stream       JPEGs, one after the other
//   GET /picture.jpg  the newest
//   GET /camera       the camera as TOML
//   GET /scene        the whole scene
//   POST /input       events (browser_events.h)
// A refusal is a status and a line of text.
#pragma once

#include <SDL.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "apps/serve/access_rules.h"

namespace swell::serve {

inline constexpr const char* kText = "text/plain; charset=utf-8";

struct Reply {
  enum class What { kWhole, kStream, kPicture, kScene };  // others than kWhole come when they come
  What what = What::kWhole;
  int status = 200;
  std::string type = kText;
  std::string body = {};
  std::vector<std::pair<std::string, std::string>> fields = {};
};

Reply refusal(int status, const std::string& line);

// What every answer carries, but for those of its own: no other site shows it in a frame or loads
// it, nothing stores it.
std::vector<std::pair<std::string, std::string>> common_fields();

struct Site {
  AccessRules rules;
  std::function<void(const SDL_Event&)> take;  // each event of a browser
  std::function<std::string()> camera;         // as TOML
};

// To a whole request that judge() has let in; events are taken if all of them are good.
Reply reply_to(const Request& request, const Site& site);

}  // namespace swell::serve
