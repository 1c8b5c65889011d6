// One connection of a browser: an asynchronous state machine that reads a request, answers it, and
// reads the next. All of it runs on the server's one thread. Each step has a deadline, and what is
// kept of a request is bounded, so a broken or hostile client costs a socket and 64 KB at most.
#pragma once

#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <memory>
#include <optional>

#include "apps/serve/picture_stream.h"
#include "apps/serve/request_parser.h"
#include "apps/serve/routes.h"

namespace swell::serve {

// What connections share.
struct Lobby {
  Site site;
  PictureStream* pictures = nullptr;
  std::function<void()> want_scene;  // scene_came() of all is called when there is one
  std::function<bool()> is_panel_open;
};

class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(boost::asio::ip::tcp::socket socket, const Lobby& lobby);

  void start();
  void close();
  bool is_closed() const { return is_closed_; }
  bool is_trusted() const { return is_trusted_; }  // has had the token

  // To those that wait for it.
  void picture_came();
  void scene_came(const std::string& toml);

 private:
  using Error = boost::system::error_code;
  enum class Wait { kNothing, kPicture, kScene, kStream };

  void read_next();
  void read_head();
  void read_body();
  void answer(const Request& request);
  void answer_later(Wait wait);
  void send(const Reply& reply, bool ends);
  void linger();

  void start_stream();
  void watch_for_end();
  void stream_newest();
  void stream_bytes(std::string bytes);
  void stream_piece();
  void await_heartbeat();

  boost::beast::tcp_stream stream_;
  const Lobby& lobby_;
  boost::beast::flat_buffer buffer_;
  std::optional<RequestParser> parser_;
  boost::beast::http::response<boost::beast::http::string_body> response_;
  boost::asio::steady_timer timer_;
  std::array<char, 4096> ignored_{};  // what nobody asked for
  std::size_t lingered_bytes_ = 0;
  bool is_closed_ = false, is_trusted_ = false;

  Wait wait_ = Wait::kNothing;
  std::shared_ptr<PictureStream::Seat> seat_;  // while it looks
  std::uint64_t shown_ = 0;                    // number of the last picture sent
  std::string sending_;                        // a part of the stream
  std::size_t sent_ = 0;
  bool is_sending_ = false;
};

}  // namespace swell::serve
