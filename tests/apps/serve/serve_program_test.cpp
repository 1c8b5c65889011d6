// swell-view --serve as a user starts and ends it.
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "apps/shared/program_runner.h"
#include "raw_client.h"

namespace swell::serve {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

class ServeProgram : public testing::Test {
 protected:
  ServeProgram() {
    apps::write_text(scene(), apps::sea_scene_text());
    setenv("LSAN_OPTIONS", "suppressions=" THIRD_PARTY_LEAKS ":print_suppressions=0", 1);
  }
  ~ServeProgram() override {
    if (pid_ > 0) kill(pid_, SIGKILL), waitpid(pid_, nullptr, 0);
  }

  std::string scene() const { return folder_.file("scene.toml"); }

  // In a folder of its own; `ignored` as a shell ignores a signal for what it starts.
  void start(std::vector<std::string> arguments, int ignored = 0) {
    std::array<int, 2> ends;
    ASSERT_EQ(pipe(ends.data()), 0);
    arguments.insert(arguments.begin(), {SWELL_VIEW, "--scene", scene(), "--size", "320x200"});
    std::vector<char*> words;
    for (std::string& word : arguments) words.push_back(word.data());
    words.push_back(nullptr);
    const std::string folder = folder_.path().string();
    pid_ = fork();
    if (pid_ == 0) {
      apps::begin_child(SIGHUP);
      dup2(ends[1], 1);
      if (chdir(folder.c_str()) != 0) _exit(99);
      if (ignored) std::signal(ignored, SIG_IGN);
      execv(SWELL_VIEW, words.data());
      _exit(99);
    }
    close(ends[1]);
    said_.clear();
    while (said_.find("at most") == std::string::npos) {
      std::array<char, 4096> bytes;
      const ssize_t count = read(ends[0], bytes.data(), bytes.size());
      if (count <= 0) break;
      said_.append(bytes.data(), static_cast<std::size_t>(count));
    }
    close(ends[0]);
    const std::size_t colon = said_.find(':', said_.find("//"));
    ASSERT_NE(colon, std::string::npos) << said_;
    port_ = std::atoi(said_.c_str() + colon + 1);
    const std::size_t token = said_.find("?token=");
    token_ = token == std::string::npos ? "" : said_.substr(token + 7, 32);
  }

  std::string bearer() const { return "Authorization: Bearer " + token_ + "\r\n"; }

  // Some who look, one that reads nothing, and some that never finish a request.
  std::vector<RawClient> connect_clients() const {
    std::vector<RawClient> clients;
    for (int i = 0; i < 3; ++i) {
      clients.emplace_back(port_, 4096);
      clients.back().send(
          fmt::format("GET /stream HTTP/1.1\r\nHost: localhost:{}\r\n{}\r\n", port_, bearer()));
      EXPECT_EQ(clients.back().response().status, 200);
    }
    for (int i = 0; i < 20; ++i) {
      clients.emplace_back(port_);
      clients.back().send("GET / HT");
    }
    return clients;
  }

  // -1 if it goes on; else its exit code, or 128 and the signal's number.
  int exit_code_within(milliseconds time) {
    const auto end = Clock::now() + time;
    int status = 0;
    while (waitpid(pid_, &status, WNOHANG) == 0) {
      if (Clock::now() > end) return -1;
      std::this_thread::sleep_for(milliseconds(5));
    }
    pid_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  const ScratchFolder folder_;
  pid_t pid_ = 0;
  std::string said_, token_;
  int port_ = 0;
};

TEST_F(ServeProgram, PrintsAUrlWithATokenAndTheFolderOfFiles) {
  start({"--serve", "0"});
  EXPECT_EQ(said_, fmt::format("http://127.0.0.1:{}/?token={}\n"
                               "files saved from the panel: {}/swell-view-files, at most 100\n",
                               port_, token_, folder_.path().string()));
  EXPECT_EQ(ask(port_, "GET /camera").status, 403);
  EXPECT_EQ(ask(port_, "GET /camera", bearer()).status, 200);
}

TEST_F(ServeProgram, NeedsNoTokenIfAskedToOnThisMachineAlone) {
  start({"--serve", "0", "--serve-open", "--serve-host", "sea.example"});
  EXPECT_EQ(token_, "");
  EXPECT_EQ(ask(port_, "GET /camera").status, 200);
  EXPECT_EQ(ask(port_, "GET /camera", "Host: sea.example\r\n").status, 200);
  EXPECT_EQ(ask(port_, "GET /camera", "Host: evil.example\r\n").status, 421);
}

TEST_F(ServeProgram, RefusesOptionsThatDoNotFit) {
  using Words = std::vector<std::string>;
  for (const Words& words :
       {Words{"--serve-open", "--serve", "0.0.0.0:0"}, Words{"--serve-open"},
        Words{"--serve-host", "sea.example"}, Words{"--serve", "0", "--serve-host", "http://x/"},
        Words{"--serve", "0", "--serve-files", ""}, Words{"--serve", "65536"}}) {
    Words arguments = {"--scene", scene()};
    arguments.insert(arguments.end(), words.begin(), words.end());
    const apps::Outcome outcome = apps::run_program(SWELL_VIEW, arguments);
    EXPECT_EQ(outcome.exit_code, 2) << words.front();
    EXPECT_TRUE(apps::is_one_error_line(outcome.err, {"--serve"})) << outcome.err;
  }
}

// A busy machine may be late once; it is not late always.
TEST_F(ServeProgram, EndsWithinASecondBySignalsThoughClientsAreConnected) {
  const bool is_checked = !apps::can_limit_resources();  // by a sanitizer, and slow
  for (const int signal : {SIGTERM, SIGHUP, SIGINT}) {
    bool in_time = false;
    for (int attempt = 0; attempt < 4 && !in_time; ++attempt) {
      start({"--serve", "0"});
      const std::vector<RawClient> clients = connect_clients();
      const auto begin = Clock::now();
      kill(pid_, signal);
      ASSERT_EQ(exit_code_within(seconds(30)), 0) << strsignal(signal);
      in_time = Clock::now() - begin < seconds(is_checked ? 10 : 1);
    }
    EXPECT_TRUE(in_time) << strsignal(signal);
  }
}

// nohup swell-view --serve ... goes on after its terminal.
TEST_F(ServeProgram, GoesOnAfterASignalThatWasIgnoredWhenItStarted) {
  for (const int signal : {SIGHUP, SIGINT}) {
    start({"--serve", "0"}, signal);
    kill(pid_, signal);
    EXPECT_EQ(exit_code_within(milliseconds(600)), -1) << strsignal(signal);
    kill(pid_, SIGTERM);
    EXPECT_EQ(exit_code_within(seconds(30)), 0) << strsignal(signal);
  }
}

}  // namespace
}  // namespace swell::serve
