// One binary, one picture, whatever the process finds around it: memory, addresses, CPUs, load.
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/personality.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>

#include "apps/render/picture_runs.h"
#include "apps/shared/program_runner.h"

namespace swell::apps {
namespace {

class SameBitsWith : public testing::Test {
 protected:
  SameBitsWith() {
    write_text(scene_, sea_scene_text());
    expected_ = pictures();
  }

  PictureRun pictures() { return run_pictures(scene_, folder_, {"--frames", "0-3", "--fps", "2"}); }

  ScratchFolder folder_;
  std::string scene_ = folder_.file("scene.toml");
  PictureRun expected_;
};

TEST_F(SameBitsWith, FreshProcesses) {
  for (int repeat = 0; repeat < 5; ++repeat)
    expect_same_pictures(pictures(), expected_, "process_" + std::to_string(repeat));
}

// glibc fills memory it hands out with the complement of this byte, and freed memory with the byte.
TEST_F(SameBitsWith, AnyBytesInFreshMemory) {
  write_text(scene_, island_scene_text());
  expected_ = pictures();
  for (const std::string byte : {"0x55", "0xAA", "0xFF"}) {
    setenv("MALLOC_PERTURB_", std::to_string(std::stoi(byte, nullptr, 16)).c_str(), 1);
    expect_same_pictures(pictures(), expected_, "fill_" + byte);
    unsetenv("MALLOC_PERTURB_");
  }
}

TEST_F(SameBitsWith, FixedAddresses) {
  const int before = personality(0xffffffff);
  if (before < 0 || personality(static_cast<unsigned>(before) | ADDR_NO_RANDOMIZE) < 0)
    GTEST_SKIP() << "this system does not let a process fix its addresses";
  expect_same_pictures(pictures(), expected_, "addresses");
  personality(static_cast<unsigned>(before));
}

TEST_F(SameBitsWith, OneCpu) {
  cpu_set_t before, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof(before), &before), 0);
  CPU_ZERO(&one);
  for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++cpu)
    if (CPU_ISSET(cpu, &before)) CPU_SET(cpu, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof(one), &one), 0);
  expect_same_pictures(pictures(), expected_, "one_cpu");
  EXPECT_EQ(sched_setaffinity(0, sizeof(before), &before), 0);
}

// Processes that take the CPUs' time until they go out of scope or this program ends.
class BusyProcesses {
 public:
  BusyProcesses() {
    for (pid_t& child : children_) {
      child = fork();
      if (child != 0) continue;
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      for (volatile unsigned turn = 0;;) turn = turn + 1;
    }
  }
  ~BusyProcesses() {
    for (const pid_t child : children_) {
      if (child <= 0) continue;
      kill(child, SIGKILL);
      waitpid(child, nullptr, 0);
    }
  }
  BusyProcesses(const BusyProcesses&) = delete;
  BusyProcesses& operator=(const BusyProcesses&) = delete;
  bool running() const {
    for (const pid_t child : children_)
      if (child <= 0 || waitpid(child, nullptr, WNOHANG) != 0) return false;
    return true;
  }

 private:
  std::array<pid_t, 4> children_{};
};

TEST_F(SameBitsWith, BusyProcessesBesideIt) {
  const BusyProcesses busy;
  expect_same_pictures(pictures(), expected_, "busy");
  EXPECT_TRUE(busy.running());
}

}  // namespace
}  // namespace swell::apps
