// A client of plain sockets, which may be as rude as it likes.
#pragma once

#include <arpa/inet.h>
#include <fmt/core.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>

namespace swell::serve {

class RawClient {
 public:
  // `receive_bytes`: of the receive buffer; 0: the system's choice.
  explicit RawClient(int port, int receive_bytes = 0) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    if (receive_bytes > 0)
      setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_bytes, sizeof receive_bytes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    is_connected_ = ::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  }
  ~RawClient() { ::close(socket_); }
  RawClient(RawClient&& other) noexcept
      : socket_(std::exchange(other.socket_, -1)), is_connected_(other.is_connected_) {}
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

  bool is_connected() const { return is_connected_; }

  // All of it; false if the server has closed, or took nothing for `patience`.
  bool send(std::string_view bytes, std::chrono::milliseconds patience = std::chrono::seconds(5)) {
    while (!bytes.empty()) {
      pollfd poll{socket_, POLLOUT, 0};
      if (::poll(&poll, 1, static_cast<int>(patience.count())) <= 0) return false;
      const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      if (sent <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
  }

  // What comes next; empty at the end, or if nothing came for `patience`.
  std::string receive(std::chrono::milliseconds patience = std::chrono::seconds(10)) {
    pollfd poll{socket_, POLLIN, 0};
    if (::poll(&poll, 1, static_cast<int>(patience.count())) <= 0) return {};
    std::string bytes(65536, '\0');
    const ssize_t count = ::recv(socket_, bytes.data(), bytes.size(), 0);
    bytes.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return bytes;
  }

  // Whether the server ends the connection within this time; reads what comes before.
  bool is_ended_within(std::chrono::milliseconds time) {
    const auto end = std::chrono::steady_clock::now() + time;
    for (;;) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
          end - std::chrono::steady_clock::now());
      pollfd poll{socket_, POLLIN, 0};
      if (left.count() <= 0 || ::poll(&poll, 1, static_cast<int>(left.count())) <= 0) return false;
      std::string bytes(65536, '\0');
      if (::recv(socket_, bytes.data(), bytes.size(), 0) <= 0) return true;
    }
  }

  struct Response {
    int status = 0;  // 0: none
    std::string head, body;
  };
  // Up to its end by Content-Length, or to the end of its head without one.
  Response response(std::chrono::milliseconds patience = std::chrono::seconds(10)) {
    while (text_.find("\r\n\r\n") == std::string::npos) {
      const std::string more = receive(patience);
      if (more.empty()) break;
      text_ += more;
    }
    Response got;
    const std::size_t end = text_.find("\r\n\r\n");
    if (end == std::string::npos || !text_.starts_with("HTTP/1.1 ")) return got;
    got.head = text_.substr(0, end + 2);
    got.status = std::atoi(text_.c_str() + 9);
    const std::size_t field = got.head.find("Content-Length: ");
    const std::size_t length =
        field == std::string::npos ? 0 : std::strtoul(got.head.c_str() + field + 16, nullptr, 10);
    while (text_.size() < end + 4 + length) {
      const std::string more = receive(patience);
      if (more.empty()) break;
      text_ += more;
    }
    got.body = text_.substr(end + 4, length);
    text_.erase(0, std::min(end + 4 + length, text_.size()));
    return got;
  }

  std::string rest() { return std::exchange(text_, {}); }  // received after the last response

 private:
  int socket_;
  bool is_connected_ = false;
  std::string text_;
};

// One request on a connection of its own. `fields` are whole lines.
inline RawClient::Response ask(int port, std::string_view line, std::string_view fields = {},
                               std::string_view body = {}) {
  RawClient client(port);
  std::string text = fmt::format("{} HTTP/1.1\r\n{}", line, fields);
  if (fields.find("Host:") == std::string_view::npos)
    text += fmt::format("Host: 127.0.0.1:{}\r\n", port);
  if (!body.empty()) text += fmt::format("Content-Length: {}\r\n", body.size());
  client.send(text + "\r\n" + std::string(body));
  return client.response();
}

}  // namespace swell::serve
