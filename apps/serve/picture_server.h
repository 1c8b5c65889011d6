// A viewer's pictures over HTTP, and events back.
#pragma once

#include <SDL.h>

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/serve/address.h"
#include "apps/serve/picture_stream.h"

namespace swell::serve {

// No server can be started; what() is one line.
class ServerError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Answers what routes.h lists, to those that access_rules.h lets in. One thread of its own serves
// all connections, each of them in bounded memory and time (connection.h). It is Boost.Beast's:
// that bounds heads, bodies and times by settings, header files are all of it, and WebSocket and a
// proxy's path prefix have their place there.
class PictureServer {
 public:
  static constexpr int kMostSeats = 4;  // who look at once
  // When one more comes, the oldest that has not shown the token goes; if all have, the new one.
  static constexpr int kMostConnections = 256;

  // `take` gets each event, `on_change` is called when somebody comes or goes: from any thread.
  struct Hooks {
    std::function<void(const SDL_Event&)> take;
    std::function<void()> on_change;
  };

  // Listens. Throws ServerError.
  PictureServer(const Address& address, Hooks hooks);
  ~PictureServer();  // closes all connections, whatever they do
  PictureServer(const PictureServer&) = delete;
  PictureServer& operator=(const PictureServer&) = delete;

  int port() const;
  std::vector<std::string> urls() const;              // for a browser
  std::string url() const { return urls().front(); }  // the first
  PictureStream& stream();
  void set_camera(std::string toml);
  void set_panel_open(bool is_open);  // as the next picture shows it
  // Calls write() if somebody has asked for the scene and waits for it: after each frame.
  void answer_scene(const std::function<std::string()>& write);

 private:
  struct Machinery;
  std::unique_ptr<Machinery> machinery_;
};

}  // namespace swell::serve
