// What the server gives to clients that behave.
#include "apps/serve/picture_server.h"

#include <gtest/gtest.h>

#include <memory>

#include "served.h"

namespace swell::serve {
namespace {

TEST(ServeAddress, IsAPortOrAnAddressAndAPort) {
  EXPECT_EQ(parse_address("8000").host, "127.0.0.1");
  EXPECT_EQ(parse_address("8000").port, 8000);
  EXPECT_EQ(parse_address("[::1]:80").host, "::1");
  EXPECT_EQ(parse_address("0.0.0.0:80").token.size(), 32u);
  EXPECT_NE(parse_address("0.0.0.0:80").token, parse_address("0.0.0.0:80").token);
  for (const char* bad : {"", ":80", "x", "80x", "65536", "-1", "::1:80", "host:", "99999999999"})
    EXPECT_THROW(parse_address(bad), std::invalid_argument) << bad;
}

TEST(ServeAddress, HasATokenOnThisMachineToo) {
  for (const char* address : {"8000", "localhost:1", "127.0.0.1:1", "[::1]:1"})
    EXPECT_EQ(parse_address(address).token.size(), 32u) << address;
}

TEST(ServeAddress, OfAllInterfacesIsPrintedAsOnesThatWork) {
  for (const char* any : {"0.0.0.0", "::"}) {
    const std::vector<std::string> urls = urls_of({.host = any, .token = "0123"}, 80);
    EXPECT_EQ(urls.back(),
              std::string("http://") + (any[0] == ':' ? "[::1]" : "127.0.0.1") + ":80/?token=0123");
    for (const std::string& url : urls) {
      EXPECT_EQ(url.find("0.0.0.0"), std::string::npos) << url;
      EXPECT_EQ(url.find("[::]"), std::string::npos) << url;
      // The server lets in whom it sends there.
      const std::string host = url.substr(7, url.find("/?") - 7);
      EXPECT_EQ(judge({"GET", "/?token=0123", {{"Host", host}}, {}},
                      rules_of({.host = any, .token = "0123"}, 80))
                    .status,
                200)
          << url;
    }
  }
}

TEST_F(Served, GivesThePage) {
  const auto page = ask(port(), "GET /");
  EXPECT_EQ(page.status, 200);
  EXPECT_NE(page.body.find("<title>swell</title>"), std::string::npos);
  // Whole in itself: nothing is loaded from elsewhere.
  EXPECT_EQ(page.body.find("http://"), std::string::npos);
  EXPECT_EQ(page.body.find("https://"), std::string::npos);
}

TEST_F(ServedWithToken, GivesThePageACookieThatNoScriptAndNoOtherSiteGets) {
  const auto page = ask(port(), "GET /?token=0123");
  const std::string cookie = fmt::format("swell_token_{}=0123", port());
  EXPECT_NE(page.head.find("Set-Cookie: " + cookie + "; HttpOnly; SameSite=Strict\r\n"),
            std::string::npos)
      << page.head;
  // Not by itself: one of 2,000 nonces has these digits among its own.
  for (const char* token : {"=0123", "\"0123\""})
    EXPECT_EQ(page.body.find(token), std::string::npos);
  server_.set_camera("[camera]\n");
  EXPECT_EQ(ask(port(), "GET /camera", "Cookie: " + cookie + "\r\n").body, "[camera]\n");
}

TEST_F(Served, SaysInEveryAnswerThatItIsForNoOtherSite) {
  for (const char* line : {"GET /", "GET /camera", "GET /nowhere", "POST /camera"}) {
    const auto answer = ask(port(), line);
    for (const char* field :
         {"X-Content-Type-Options: nosniff", "Referrer-Policy: no-referrer",
          "Cross-Origin-Resource-Policy: same-origin", "Cache-Control: no-store",
          "Content-Security-Policy: default-src 'none';", "frame-ancestors 'none'"})
      EXPECT_NE(answer.head.find(field), std::string::npos) << line << ": " << field;
  }
  const auto a = ask(port(), "GET /"), b = ask(port(), "GET /");
  EXPECT_NE(a.body, b.body);  // a nonce is used once
}

TEST_F(Served, TakesEventsAndRefusesBadOnes) {
  EXPECT_EQ(ask(port(), "POST /input", {}, R"([{"type":"leave"}])").status, 204);
  EXPECT_EQ(events_, 2);
  const auto bad = ask(port(), "POST /input", {}, "{");
  EXPECT_EQ(bad.status, 400);
  EXPECT_EQ(std::ranges::count(bad.body, '\n'), 1);
  EXPECT_EQ(ask(port(), "GET /nowhere").status, 404);
  EXPECT_EQ(ask(port(), "GET /input").status, 405);
  EXPECT_EQ(ask(port(), "DELETE /").status, 405);
  EXPECT_EQ(events_, 2);
}

TEST_F(Served, RefusesAnEventWhoseRepeatIsNoTruthValue) {
  const auto bad =
      ask(port(), "POST /input", {}, R"([{"type":"key","code":"KeyW","down":true,"repeat":1}])");
  EXPECT_EQ(bad.status, 400);
  EXPECT_EQ(bad.body, "\"repeat\" of an event is of the wrong kind\n");
  EXPECT_EQ(bad.head.find("EXCEPTION"), std::string::npos);
}

TEST_F(Served, AnswersManyRequestsOnOneConnection) {
  server_.set_camera("[camera]\n");
  RawClient client(port());
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(client.send("GET /camera HTTP/1.1\r\n" + host_line() + "\r\n"));
    ASSERT_EQ(client.response().body, "[camera]\n") << i;
  }
  // Two at once are answered in their order.
  client.send("GET /camera HTTP/1.1\r\n" + host_line() + "\r\nGET /nowhere HTTP/1.1\r\n" +
              host_line() + "\r\n");
  EXPECT_EQ(client.response().status, 200);
  EXPECT_EQ(client.response().status, 404);
}

TEST_F(Served, WritesTheSceneForWhoAsksAndForNobodyElse) {
  int written = 0;
  const auto write = [&] { return "[sea]\n# " + std::to_string(++written) + "\n"; };
  server_.answer_scene(write);
  EXPECT_EQ(written, 0);
  std::string body;
  std::atomic<bool> is_answered = false;
  std::thread asking([&] {
    body = ask(port(), "GET /scene").body;
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

TEST_F(Served, GivesThePictureThatComesNext) {
  RawClient client(port());
  client.send("GET /picture.jpg HTTP/1.1\r\n" + host_line() + "\r\n");
  const auto end = Clock::now() + seconds(20);
  while (!server_.stream().is_watched() && Clock::now() < end) std::this_thread::yield();
  publish(100);
  const auto answer = client.response();
  EXPECT_EQ(answer.status, 200);
  EXPECT_TRUE(answer.body.starts_with("\xff\xd8"));
}

TEST_F(ServedWithToken, RefusesWhoDoesNotKnowIt) {
  for (const char* path : {"/", "/?token=", "/?token=0124", "/?token=01234", "/stream", "/camera"})
    EXPECT_EQ(ask(port(), std::string("GET ") + path).status, 403) << path;
  EXPECT_EQ(ask(port(), "POST /input", {}, R"([{"type":"leave"}])").status, 403);
  EXPECT_EQ(events_, 0);
  EXPECT_EQ(ask(port(), "GET /?token=0123").status, 200);
  EXPECT_EQ(ask(port(), "POST /input", kBearer, R"([{"type":"leave"}])").status, 204);
  EXPECT_EQ(server_.url(), "http://127.0.0.1:" + std::to_string(port()) + "/?token=0123");
}

TEST_F(Served, ABusyPortIsOneLine) {
  try {
    const PictureServer second({.port = port()}, {});
    FAIL() << "two servers on a port";
  } catch (const ServerError& error) {
    EXPECT_EQ(std::string(error.what()).find("cannot listen on 127.0.0.1:"), 0u);
  }
}

// ---- the stream ----

RawClient look_at(int port) {
  RawClient client(port);
  client.send(fmt::format("GET /stream HTTP/1.1\r\nHost: localhost:{}\r\n\r\n", port));
  return client;
}

int count_pictures(std::string_view text) {
  int count = 0;
  for (std::size_t at = text.find("--picture"); at != std::string_view::npos;
       at = text.find("--picture", at + 1))
    ++count;
  return count;
}

TEST_F(Served, StreamsTheNewestAndLeavesNobodyBehind) {
  EXPECT_FALSE(server_.stream().is_watched());
  const auto end = Clock::now() + seconds(20);
  {
    RawClient client = look_at(port());
    EXPECT_EQ(client.response().status, 200);
    std::string text = client.rest();
    for (std::uint8_t grey = 0; count_pictures(text) < 5 && Clock::now() < end; ++grey) {
      publish(grey);
      text += client.receive(milliseconds(5));
    }
    EXPECT_GE(count_pictures(text), 5);
  }
  while (server_.stream().is_watched() && Clock::now() < end)
    std::this_thread::sleep_for(milliseconds(5));
  EXPECT_FALSE(server_.stream().is_watched());
}

// So that a page can tell a still picture from a server that is gone.
TEST_F(Served, SendsSomethingEachSecondWhereNothingChanges) {
  RawClient client = look_at(port());
  ASSERT_EQ(client.response().status, 200);
  client.rest();
  EXPECT_NE(client.receive(milliseconds(2500)), "");  // before the first picture
  publish(100);
  std::string text;
  const auto end = Clock::now() + seconds(20);
  while (count_pictures(text) < 3 && Clock::now() < end) text += client.receive(seconds(2));
  EXPECT_EQ(count_pictures(text), 3);
}

TEST_F(Served, TellsWhetherThePanelIsOpen) {
  RawClient client = look_at(port());
  ASSERT_EQ(client.response().status, 200);
  for (const bool is_open : {false, true}) {
    server_.set_panel_open(is_open);
    publish(100);
    const std::string line = is_open ? "X-Swell-Panel: open" : "X-Swell-Panel: closed";
    std::string text;
    const auto end = Clock::now() + seconds(10);
    while (text.find(line) == std::string::npos && Clock::now() < end) text += client.receive();
    EXPECT_NE(text.find(line), std::string::npos) << line;
  }
}

TEST_F(Served, SeatsAreLimited) {
  std::vector<std::shared_ptr<PictureStream::Seat>> seats;
  for (int i = 0; i < PictureServer::kMostSeats; ++i) seats.push_back(server_.stream().take_seat());
  EXPECT_TRUE(seats.back());
  EXPECT_FALSE(server_.stream().take_seat());
  EXPECT_EQ(ask(port(), "GET /stream").status, 503);
  EXPECT_EQ(ask(port(), "GET /picture.jpg").status, 503);
  seats.pop_back();
  EXPECT_TRUE(server_.stream().take_seat());
}

// Who reads slowly gets fewer pictures; who draws does not wait.
TEST_F(Served, SlowReadersStallNobody) {
  std::atomic<bool> stop = false;
  std::thread slow([&] {
    RawClient client = look_at(port());
    while (!stop) {
      client.receive(milliseconds(100));
      std::this_thread::sleep_for(milliseconds(200));
    }
  });
  const auto end = Clock::now() + seconds(20);
  while (!server_.stream().is_watched() && Clock::now() < end) std::this_thread::yield();
  std::vector<std::uint8_t> noise(4 * 1280 * 720);
  for (std::size_t i = 0; i < noise.size(); ++i)
    noise[i] = static_cast<std::uint8_t>(i * 2654435761u >> 13);
  Clock::duration longest{0};
  for (int i = 0; i < 40; ++i) {
    const Clock::time_point begin = Clock::now();
    server_.stream().publish(1280, 720, [&](std::vector<std::uint8_t>& rgba) { rgba = noise; });
    longest = std::max(longest, Clock::now() - begin);
    std::this_thread::sleep_for(milliseconds(5));
  }
  EXPECT_LT(longest, seconds(2));
  stop = true;
  slow.join();
}

}  // namespace
}  // namespace swell::serve
