// Signals that end a program while it writes: by that signal, with whole files and no others.
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <thread>

#include "apps/shared/output_file.h"
#include "apps/shared/program_runner.h"
#include "math/random.h"
#include "refused_calls.h"
#include "texture/image/image_io.h"

namespace swell::apps {
namespace {

constexpr int kSignals[] = {SIGINT,  SIGTERM, SIGHUP,    SIGQUIT, SIGUSR1, SIGUSR2,
                            SIGALRM, SIGXCPU, SIGVTALRM, SIGPROF, SIGKILL};

struct Way {
  const char* name;
  bool unnamed_files;
};

class Signals : public testing::TestWithParam<Way> {
 protected:
  // Starts `work` in a child and sends it the signal after `delay_us`; how the child ended, as
  // Outcome::exit_code says it.
  int end_by(int signal, std::uint64_t delay_us, const std::function<void()>& work) {
    const pid_t child = fork();
    if (child == 0) {
      begin_child(signal);
      if (!GetParam().unnamed_files && !refuse_unnamed_files()) _exit(9);
      work();
      _exit(0);
    }
    usleep(static_cast<useconds_t>(delay_us));
    kill(child, signal);
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  // Only SIGKILL may leave a temporary file, and a later run removes it.
  void expect_no_other_file(int signal, const std::string& prefix) {
    if (signal == SIGKILL) texture::remove_abandoned_files(folder_.path());
    for (const std::string& name : folder_.names())
      EXPECT_TRUE(name.starts_with(prefix)) << name << " after signal " << signal;
  }

  ScratchFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Ways, Signals,
                         testing::Values(Way{"UnnamedFiles", true}, Way{"NoUnnamedFiles", false}),
                         [](const auto& test) { return std::string(test.param.name); });

// As fast as it can, old and new files in turn, on one thread of two: signals come on both.
void write_without_end(const std::string& old_file, const std::string& new_file) {
  std::thread idle([] {
    while (true) pause();
  });
  for (int n = 0;; ++n) {
    const std::vector<std::uint8_t> bytes(static_cast<std::size_t>(1000 * (1 + n % 50)),
                                          static_cast<std::uint8_t>(n));
    write_output(old_file, bytes);
    write_output(new_file + std::to_string(n), bytes);
  }
}

TEST_P(Signals, EndAWriterWithWholeFilesAndNoOthers) {
  int round = 0;
  for (const int signal : kSignals) {
    for (int n = 0; n < 12; ++n, ++round) {
      const std::uint64_t delay_us = random_bits(1, static_cast<std::uint64_t>(round)) % 20'000;
      const int ended = end_by(signal, delay_us, [&] {
        write_without_end(folder_.file("file_old"), folder_.file("file_new"));
      });
      EXPECT_EQ(ended, -signal);
      expect_no_other_file(signal, "file_");
    }
  }
  int whole = 0;
  for (const std::string& name : folder_.names()) {
    const std::string bytes = read_text(folder_.file(name));
    whole += bytes.size() % 1000 == 0 && !bytes.empty() &&
             bytes.find_first_not_of(bytes[0]) == std::string::npos;
  }
  EXPECT_EQ(whole, std::ssize(folder_.names()));
  EXPECT_GT(whole, 1);
}

TEST_P(Signals, ThatAreIgnoredOrHandledStaySo) {
  const int ended = end_by(0, 0, [&] {
    static volatile sig_atomic_t handled = 0;
    signal(SIGHUP, SIG_IGN);
    signal(SIGTERM, [](int) { handled = handled + 1; });
    signal(SIGINT, SIG_DFL);
    const std::vector<std::uint8_t> bytes(100'000, 'x');
    std::thread sender([] {
      for (int n = 0; n < 200; ++n) {
        kill(getpid(), n % 2 == 0 ? SIGHUP : SIGTERM);
        usleep(100);
      }
    });
    for (int n = 0; n < 10; ++n) write_output(folder_.file("file"), bytes);
    sender.join();
    struct sigaction after {};
    sigaction(SIGINT, nullptr, &after);
    _exit(after.sa_handler == SIG_DFL && handled > 0 ? 3 : 4);
  });
  EXPECT_EQ(ended, 3);
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"file"});
}

// Each program and each kind of file, ended at any time of its run.
TEST_P(Signals, EndTheProgramsWithWholeFilesAndNoOthers) {
  const ScratchFolder scenes;
  const std::string scene = scenes.file("sea.toml");
  write_text(scene, sea_scene_text());
  int round = 0;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGKILL}) {
    for (const char* kind : {"%04d.png", "%04d.exr", "labels", "json"}) {
      for (int n = 0; n < 3; ++n, ++round) {
        const Surroundings surroundings = {
            .unnamed_files = GetParam().unnamed_files,
            .signal = signal,
            .signal_after_us = random_bits(2, static_cast<std::uint64_t>(round)) % 100'000};
        const std::string file = folder_.file("file_"), size = "32x18";
        Arguments arguments = {"--scene", scene, "--size", size, "--frames", "0-9999"};
        if (kind == std::string("labels"))
          arguments.insert(arguments.end(),
                           {"--labels", "normal", "--labels-out", file + "l_%04d.exr"});
        else
          arguments.insert(arguments.end(), {"--out", file + kind});
        const Outcome outcome =
            kind == std::string("json")
                ? run_bench({"frame", "--scene", scene, "--size", size, "--frames", "2", "--json",
                             file + "report.json", "--trace", file + "trace.json"},
                            surroundings)
                : run_render(arguments, surroundings);
        if (outcome.exit_code != 0) {
          EXPECT_EQ(outcome.exit_code, -signal);
        }
        EXPECT_EQ(outcome.err, "");
        expect_no_other_file(signal, "file_");
      }
    }
  }
  for (const std::string& name : folder_.names()) {
    const std::string bytes = read_text(folder_.file(name));
    if (name.ends_with(".json")) {
      EXPECT_TRUE(bytes.ends_with("}\n")) << name;
    } else {
      EXPECT_NO_THROW(texture::read_image(folder_.file(name))) << name;
    }
  }
}

}  // namespace
}  // namespace swell::apps
