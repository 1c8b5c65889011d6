// What rude and hostile clients cost: a socket, some kilobytes, seconds.
#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <optional>

#include "served.h"

namespace swell::serve {
namespace {

// Returns the resident memory of this process.
double memory_mb() {
  std::ifstream statm("/proc/self/statm");
  long whole = 0, resident = 0;
  statm >> whole >> resident;
  return static_cast<double>(resident * sysconf(_SC_PAGESIZE)) / 1e6;
}

constexpr double kMostGrowth_mb = 32.0;  // as much as sanitizers may need

// Sends `piece` again and again, up to so many bytes, until the server has had enough.
std::size_t send_many(RawClient& client, const std::string& piece, std::size_t most) {
  std::size_t sent = 0;
  while (sent < most && client.send(piece)) sent += piece.size();
  return sent;
}

TEST_F(ServedWithToken, ManyHeadersAreRefusedAfter64Kilobytes) {
  const double before_mb = memory_mb();
  RawClient client(port());
  client.send("GET / HTTP/1.1\r\n" + host_line());
  std::string lines;
  for (int i = 0; i < 1000; ++i) lines += fmt::format("X-{}: {}\r\n", i, std::string(90, 'a'));
  EXPECT_TRUE(client.send(lines));
  EXPECT_EQ(client.response().status, 431);
  EXPECT_LT(send_many(client, lines, 800'000'000), 800'000'000u);
  EXPECT_LT(memory_mb() - before_mb, kMostGrowth_mb);
}

TEST_F(ServedWithToken, OneEndlessLineIsRefusedAfter64Kilobytes) {
  for (const char* begin : {"GET /", "GET / HTTP/1.1\r\nX: "}) {
    RawClient client(port());
    client.send(begin + std::string(70000, 'a'));
    EXPECT_EQ(client.response().status, 431) << begin;
  }
}

TEST_F(Served, LongBodiesAreRefusedBeforeAnyOfThemIsKept) {
  RawClient client(port());
  client.send("POST /input HTTP/1.1\r\n" + host_line() + "Content-Length: 65537\r\n\r\n");
  EXPECT_EQ(client.response().status, 413);
  EXPECT_EQ(ask(port(), "POST /input", "Content-Length: 99999999999999999999\r\n").status, 400);
  EXPECT_EQ(ask(port(), "POST /input", {}, "[" + std::string(65534, ' ') + "]").status, 204);
}

TEST_F(Served, ChunkedBodiesAreBoundedAlike) {
  const std::string head =
      "POST /input HTTP/1.1\r\n" + host_line() + "Transfer-Encoding: chunked\r\n\r\n";
  const double before_mb = memory_mb();
  {
    RawClient client(port());
    client.send(head + "2\r\n[]\r\n0\r\n\r\n");
    EXPECT_EQ(client.response().status, 204);
  }
  {
    RawClient client(port());
    client.send(head);
    const std::string chunk = "1000\r\n" + std::string(0x1000, ' ') + "\r\n";
    for (int i = 0; i < 17; ++i) client.send(chunk);
    EXPECT_EQ(client.response().status, 413);
    EXPECT_LT(send_many(client, chunk, 400'000'000), 400'000'000u);
  }
  for (const char* size : {"7FFFFFFFFFFFFFFF", "FFFFFFFFFFFFFFFF", "10001"}) {
    RawClient client(port());
    client.send(head + size + "\r\n");
    EXPECT_EQ(client.response().status, 413) << size;
  }
  {
    RawClient client(port());
    client.send(head + "1;" + std::string(140000, 'x'));
    EXPECT_EQ(client.response().status, 413);
  }
  EXPECT_LT(memory_mb() - before_mb, kMostGrowth_mb);
  EXPECT_EQ(events_, 0);
}

TEST_F(Served, ABodyOfNoLengthIsEmpty) {
  RawClient client(port());
  client.send("POST /input HTTP/1.1\r\n" + host_line() + "\r\n");
  EXPECT_EQ(client.response().status, 400);  // no JSON
}

TEST_F(Served, BodiesOfWhoMayNotComeInAreNotRead) {
  RawClient client(port());
  client.send("POST /input HTTP/1.1\r\nHost: evil.example\r\nContent-Length: 60000\r\n\r\n");
  EXPECT_EQ(client.response().status, 421);
}

TEST_F(Served, RangesAreNotHeeded) {
  server_.set_camera("[camera]\n");
  std::string ranges = "Range: bytes=0-";
  for (int i = 0; i < 2000; ++i) ranges += ",0-";
  const auto answer = ask(port(), "GET /camera", ranges + "\r\n");
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.body, "[camera]\n");
}

TEST_F(Served, NonsenseIsRefusedOrDropped) {
  for (const char* text :
       {"\r\n\r\n", "GET\r\n\r\n", "GET / HTTP/9.9\r\n\r\n", "\x16\x03\x01\x02\r\n",
        "GET / HTTP/1.1\r\nHost : a\r\n\r\n", "GET / HTTP/1.1\r\n\r\n",
        "POST / HTTP/1.1\r\nContent-Length: -1\r\n\r\n"}) {
    RawClient client(port());
    client.send(text);
    EXPECT_EQ(client.response().status, 400) << text;
  }
}

TEST_F(Served, PagesOfOtherSitesGetNothingAndAreToldWhy) {
  server_.set_camera("[camera]\n");
  const std::string evil = "Host: evil.example:8123\r\nOrigin: http://evil.example:8123\r\n";
  for (const char* line : {"GET /", "GET /camera", "GET /scene", "GET /picture.jpg", "GET /stream"})
    EXPECT_EQ(ask(port(), line, evil).status, 421) << line;
  const auto rebound = ask(port(), "POST /input", evil, R"([{"type":"leave"}])");
  EXPECT_EQ(rebound.status, 421);
  EXPECT_NE(rebound.body.find("--serve-host"), std::string::npos);
  const auto foreign = ask(port(), "GET /camera", "Origin: http://elsewhere.example\r\n");
  EXPECT_EQ(foreign.status, 403);
  EXPECT_NE(foreign.body.find("another site"), std::string::npos) << foreign.body;
  const std::string own = fmt::format("Origin: http://127.0.0.1:{}\r\n", port());
  EXPECT_EQ(ask(port(), "GET /camera", own).status, 200);
  EXPECT_EQ(events_, 0);
}

// <img src="http://127.0.0.1:8000/stream"> on a page elsewhere: without an Origin, and without the
// cookie, which is SameSite=Strict.
TEST_F(ServedWithToken, ImagesOnPagesOfOtherSitesTakeNoSeat) {
  std::vector<RawClient> images;
  for (int i = 0; i < 8; ++i) {
    images.emplace_back(port());
    images.back().send("GET /stream HTTP/1.1\r\n" + host_line() +
                       "Sec-Fetch-Site: cross-site\r\nSec-Fetch-Dest: image\r\n\r\n");
    EXPECT_EQ(images.back().response().status, 403);
  }
  EXPECT_FALSE(server_.stream().is_watched());
  RawClient owner(port());
  owner.send("GET /stream HTTP/1.1\r\n" + host_line() + kBearer + "\r\n");
  EXPECT_EQ(owner.response().status, 200);
}

// More than there may be connections; each sends a byte now and then.
TEST_F(ServedWithToken, SlowClientsDoNotShutTheOwnerOut) {
  server_.set_camera("[camera]\n");
  std::vector<RawClient> slow;
  for (int i = 0; i < PictureServer::kMostConnections + 50; ++i) {
    slow.emplace_back(port());
    slow.back().send("G");
  }
  for (int i = 0; i < 5; ++i) {
    for (RawClient& client : slow) client.send("E");
    const auto begin = Clock::now();
    EXPECT_EQ(ask(port(), "GET /camera", kBearer).body, "[camera]\n");
    EXPECT_LT(Clock::now() - begin, seconds(2));
  }
}

TEST_F(ServedWithToken, AHeadThatIsNotWholeAfterFiveSecondsEndsItsConnection) {
  RawClient client(port());
  const auto begin = Clock::now();
  client.send("GET / HTTP/1.1\r\n");
  bool is_ended = false;
  for (int i = 0; i < 30 && !is_ended; ++i) {
    client.send("X");
    is_ended = client.is_ended_within(milliseconds(500));
  }
  EXPECT_TRUE(is_ended);
  EXPECT_GT(Clock::now() - begin, seconds(4));
  EXPECT_LT(Clock::now() - begin, seconds(9));
}

TEST_F(Served, ClientsThatReadNothingLoseTheirSeatAfterFiveSeconds) {
  RawClient client(port(), 4096);
  client.send("GET /stream HTTP/1.1\r\n" + host_line() + "\r\n");
  const auto end = Clock::now() + seconds(20);
  while (!server_.stream().is_watched() && Clock::now() < end) std::this_thread::yield();
  std::vector<std::uint8_t> noise(4 * 1280 * 720);
  for (std::size_t i = 0; i < noise.size(); ++i)
    noise[i] = static_cast<std::uint8_t>(i * 2654435761u >> 13);
  const auto begin = Clock::now();
  while (server_.stream().is_watched() && Clock::now() < end) {
    server_.stream().publish(1280, 720, [&](std::vector<std::uint8_t>& rgba) { rgba = noise; });
    std::this_thread::sleep_for(milliseconds(50));
  }
  EXPECT_FALSE(server_.stream().is_watched());
  EXPECT_LT(Clock::now() - begin, seconds(9));
}

TEST(ServedEnd, ComesWithinTwoSecondsWhateverClientsDo) {
  std::optional<PictureServer> server;
  server.emplace(Address{}, PictureServer::Hooks{});
  const int port = server->port();
  const std::string host = fmt::format("Host: localhost:{}\r\n", port);
  std::vector<RawClient> clients;
  for (const std::string& text :
       {std::string(), std::string("GET / HT"), "GET /stream HTTP/1.1\r\n" + host + "\r\n",
        "GET /scene HTTP/1.1\r\n" + host + "\r\n", "GET /picture.jpg HTTP/1.1\r\n" + host + "\r\n",
        "GET /camera HTTP/1.1\r\n" + host + "\r\n",
        "POST /input HTTP/1.1\r\n" + host + "Content-Length: 9\r\n\r\n", std::string("x\r\n\r\n")})
    for (int i = 0; i < 12; ++i) {
      clients.emplace_back(port, 4096);
      clients.back().send(text);
    }
  EXPECT_EQ(ask(port, "GET /camera").status, 200);  // all others have been taken
  const auto begin = Clock::now();
  server.reset();
  EXPECT_LT(Clock::now() - begin, seconds(2));
  EXPECT_FALSE(RawClient(port).is_connected());
}

}  // namespace
}  // namespace swell::serve
