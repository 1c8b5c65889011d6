// A server without a viewer behind it, whose pictures are of one grey.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include "apps/serve/picture_server.h"
#include "raw_client.h"

namespace swell::serve {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

class Served : public testing::Test {
 protected:
  explicit Served(const std::string& token = {})
      : server_({.port = 0, .token = token}, {[this](const SDL_Event&) { ++events_; }, {}}) {}

  int port() const { return server_.port(); }
  void publish(std::uint8_t grey) {
    server_.stream().publish(
        64, 48, [&](std::vector<std::uint8_t>& rgba) { std::ranges::fill(rgba, grey); });
  }
  std::string host_line() const { return fmt::format("Host: 127.0.0.1:{}\r\n", port()); }

  std::atomic<int> events_{0};
  PictureServer server_;
};

inline constexpr const char* kBearer = "Authorization: Bearer 0123\r\n";

class ServedWithToken : public Served {
 protected:
  ServedWithToken() : Served("0123") {}
};

}  // namespace swell::serve
