// A viewer's pictures over HTTP, and events back.
#pragma once

#include <SDL.h>

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "apps/serve/access_rules.h"
#include "apps/serve/picture_stream.h"

namespace httplib {
class Server;
struct Request;
struct Response;
}  // namespace httplib

namespace swell::serve {

// No server can be started; what() is one line.
class ServerError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Where to listen. Beyond the machine itself requests need the token, a secret of the URL.
struct Address {
  std::string host = "127.0.0.1";  // a name or an address, of IPv6 without brackets
  int port = 0;                    // 0: any that is free
  std::string token;               // empty: none needed
  std::vector<std::string> hosts;  // names of proxies that pass requests on
};

// "[ADDRESS:]PORT", an IPv6 address in brackets; with a new token where one is needed. Throws
// std::invalid_argument.
Address parse_address(const std::string& text);

// GET /: the page; /stream: JPEGs, one after the other; /picture.jpg: the newest; /camera: the
// camera as TOML; /scene: the whole scene. POST /input: events (browser_events.h). Bad requests get
// a status and a line of text: 400 bad events, 403 a wrong token or a page of another site, 413 too
// much, 503 too many who look. Threads of its own.
class PictureServer {
 public:
  static constexpr int kMostSeats = 4;              // who look at once
  static constexpr std::size_t kMostBytes = 65536;  // of a request

  // `take` gets each event, `on_change` is called when somebody comes or goes: from any thread.
  struct Hooks {
    std::function<void(const SDL_Event&)> take;
    std::function<void()> on_change;
  };

  // Listens. Throws ServerError.
  PictureServer(const Address& address, Hooks hooks);
  ~PictureServer();
  PictureServer(const PictureServer&) = delete;
  PictureServer& operator=(const PictureServer&) = delete;

  int port() const { return port_; }
  std::string url() const;  // for a browser
  PictureStream& stream() { return stream_; }
  void set_camera(std::string toml);
  // Calls write() if somebody has asked for the scene and waits for it: after each frame.
  void answer_scene(const std::function<std::string()>& write);

 private:
  Verdict judge_request(const httplib::Request& request) const;
  void add_pages();
  void answer_stream(httplib::Response& response);
  void send_scene(httplib::Response& response);

  const Address address_;
  const Hooks hooks_;
  PictureStream stream_;
  mutable std::mutex mutex_;
  std::string camera_;
  bool scene_wanted_ = false;  // since the last was written
  std::uint64_t scenes_ = 0;   // so many have been written
  std::string scene_;          // the last
  std::condition_variable scene_came_;
  std::unique_ptr<httplib::Server> http_;
  int port_ = 0;
  std::thread thread_;
};

}  // namespace swell::serve
