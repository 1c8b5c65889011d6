// The server, without a viewer behind it.
#include "apps/serve/picture_server.h"

#include <gtest/gtest.h>
#include <httplib.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace swell::serve {
namespace {

using Clock = std::chrono::steady_clock;

TEST(ServeAddress, IsAPortOrAnAddressAndAPort) {
  EXPECT_EQ(parse_address("8000").host, "127.0.0.1");
  EXPECT_EQ(parse_address("8000").port, 8000);
  EXPECT_EQ(parse_address("localhost:1").token, "");
  EXPECT_EQ(parse_address("[::1]:80").host, "::1");
  EXPECT_EQ(parse_address("0.0.0.0:80").token.size(), 32u);
  EXPECT_NE(parse_address("0.0.0.0:80").token, parse_address("0.0.0.0:80").token);
  for (const char* bad : {"", ":80", "x", "80x", "65536", "-1", "::1:80", "host:", "99999999999"})
    EXPECT_THROW(parse_address(bad), std::invalid_argument) << bad;
}

// A server whose pictures are of one grey.
class Served : public testing::Test {
 protected:
  explicit Served(const std::string& token = {})
      : server_({.port = 0, .token = token, .hosts = {}},
                {[this](const SDL_Event&) { ++events_; }, {}}),
        client_("127.0.0.1", server_.port()) {}

  void publish(std::uint8_t grey) {
    server_.stream().publish(
        64, 48, [&](std::vector<std::uint8_t>& rgba) { std::ranges::fill(rgba, grey); });
  }

  std::atomic<int> events_{0};
  PictureServer server_;
  httplib::Client client_;
};

TEST_F(Served, GivesThePage) {
  const auto page = client_.Get("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->status, 200);
  EXPECT_NE(page->body.find("<title>swell</title>"), std::string::npos);
  // Whole in itself: nothing is loaded from elsewhere.
  EXPECT_EQ(page->body.find("http://"), std::string::npos);
  EXPECT_EQ(page->body.find("https://"), std::string::npos);
}

TEST_F(Served, TakesEventsAndRefusesBadOnes) {
  EXPECT_EQ(client_.Post("/input", R"([{"type":"leave"}])", "text/plain")->status, 204);
  EXPECT_EQ(events_, 2);
  const auto bad = client_.Post("/input", "{", "text/plain");
  EXPECT_EQ(bad->status, 400);
  EXPECT_EQ(std::ranges::count(bad->body, '\n'), 1);
  EXPECT_EQ(
      client_.Post("/input", std::string(PictureServer::kMostBytes + 1, ' '), "text/plain")->status,
      413);
  EXPECT_EQ(client_.Get("/nowhere")->status, 404);
  EXPECT_EQ(events_, 2);
}

TEST_F(Served, RefusesPagesOfOtherSites) {
  EXPECT_EQ(client_.Get("/camera", {{"Origin", "http://elsewhere.example"}})->status, 403);
  const std::string own = "http://127.0.0.1:" + std::to_string(server_.port());
  EXPECT_EQ(client_.Get("/camera", {{"Origin", own}})->status, 200);
}

TEST_F(Served, TellsTheCamera) {
  server_.set_camera("[camera]\n");
  EXPECT_EQ(client_.Get("/camera")->body, "[camera]\n");
}

TEST_F(Served, WritesTheSceneForWhoAsksAndForNobodyElse) {
  int written = 0;
  const auto write = [&] { return "[sea]\n# " + std::to_string(++written) + "\n"; };
  server_.answer_scene(write);
  EXPECT_EQ(written, 0);
  std::string body;
  std::atomic<bool> is_answered = false;
  std::thread asking([&] {
    const httplib::Result result = client_.Get("/scene");
    if (result && result->status == 200) body = result->body;
    is_answered = true;
  });
  while (!is_answered) {  // frames
    server_.answer_scene(write);
    std::this_thread::yield();
  }
  asking.join();
  EXPECT_EQ(body, "[sea]\n# 1\n");
  EXPECT_EQ(written, 1);
}

class ServedWithToken : public Served {
 protected:
  ServedWithToken() : Served("0123") {}
};

TEST_F(ServedWithToken, RefusesWhoDoesNotKnowIt) {
  for (const char* path : {"/", "/?token=", "/?token=0124", "/?token=01234", "/stream", "/camera"})
    EXPECT_EQ(client_.Get(path)->status, 403) << path;
  EXPECT_EQ(client_.Post("/input", R"([{"type":"leave"}])", "text/plain")->status, 403);
  EXPECT_EQ(events_, 0);
  EXPECT_EQ(client_.Get("/?token=0123")->status, 200);
  EXPECT_EQ(server_.url(), "http://127.0.0.1:" + std::to_string(server_.port()) + "/?token=0123");
}

TEST_F(Served, ABusyPortIsOneLine) {
  try {
    const PictureServer second({.port = server_.port(), .token = {}, .hosts = {}}, {});
    FAIL() << "two servers on a port";
  } catch (const ServerError& error) {
    EXPECT_EQ(std::string(error.what()).find("cannot listen on 127.0.0.1:"), 0u);
  }
}

// Looks until it has seen so many pictures; more slowly, if asked to.
int look(int port, int most, std::chrono::milliseconds pause, std::atomic<bool>& stop) {
  httplib::Client client("127.0.0.1", port);
  int seen = 0, status = 0;
  client.Get(
      "/stream",
      [&](const httplib::Response& response) {
        status = response.status;
        return response.status == 200;
      },
      [&](const char* data, std::size_t size) {
        const std::string_view text(data, size);
        for (std::size_t at = text.find("--picture"); at != std::string_view::npos;
             at = text.find("--picture", at + 1))
          ++seen;
        std::this_thread::sleep_for(pause);
        return seen < most && !stop;
      });
  return status == 200 ? seen : -status;
}

TEST_F(Served, StreamsTheNewestAndLeavesNobodyBehind) {
  EXPECT_FALSE(server_.stream().is_watched());
  std::atomic<bool> stop = false;
  std::atomic<int> seen = 0;
  std::thread looking([&] { seen = look(server_.port(), 5, {}, stop); });
  const auto end = Clock::now() + std::chrono::seconds(20);
  for (std::uint8_t grey = 0; seen == 0 && Clock::now() < end; ++grey) {
    publish(grey);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  looking.join();
  EXPECT_EQ(seen, 5);
  while (server_.stream().is_watched() && Clock::now() < end) {
    publish(0);  // a connection that is gone is found when something is sent
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_FALSE(server_.stream().is_watched());
}

TEST_F(Served, SeatsAreLimited) {
  std::vector<std::shared_ptr<PictureStream::Seat>> seats;
  for (int i = 0; i < PictureServer::kMostSeats; ++i) seats.push_back(server_.stream().take_seat());
  EXPECT_TRUE(seats.back());
  EXPECT_FALSE(server_.stream().take_seat());
  std::atomic<bool> stop = false;
  EXPECT_EQ(look(server_.port(), 1, {}, stop), -503);
  EXPECT_EQ(client_.Get("/picture.jpg")->status, 503);
  seats.pop_back();
  EXPECT_TRUE(server_.stream().take_seat());
}

// Who reads slowly gets fewer pictures; who draws does not wait.
TEST_F(Served, SlowReadersStallNobody) {
  std::atomic<bool> stop = false;
  std::thread slow([&] { look(server_.port(), 1000, std::chrono::milliseconds(200), stop); });
  const auto end = Clock::now() + std::chrono::seconds(20);
  while (!server_.stream().is_watched() && Clock::now() < end) std::this_thread::yield();
  std::vector<std::uint8_t> noise(4 * 1280 * 720);
  for (std::size_t i = 0; i < noise.size(); ++i)
    noise[i] = static_cast<std::uint8_t>(i * 2654435761u >> 13);
  Clock::duration longest{0};
  for (int i = 0; i < 40; ++i) {
    const Clock::time_point begin = Clock::now();
    server_.stream().publish(1280, 720, [&](std::vector<std::uint8_t>& rgba) { rgba = noise; });
    longest = std::max(longest, Clock::now() - begin);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_LT(longest, std::chrono::seconds(2));
  stop = true;
  slow.join();
}

}  // namespace
}  // namespace swell::serve
