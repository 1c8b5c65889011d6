// swell-bench's modes: each adds itself to the program's command line and says what to run.
#pragma once

#include <chrono>
#include <functional>

#include "apps/shared/command_line.h"

namespace swell::apps {

struct BenchMode {
  CommandLine line;
  std::function<void()> run;  // after the command line has been parsed
};

BenchMode add_bench_frame(CommandLine& program);
BenchMode add_bench_lidar(CommandLine& program);
BenchMode add_bench_lod(CommandLine& program);
BenchMode add_bench_optics(CommandLine& program);
BenchMode add_bench_papers(CommandLine& program);  // apps/papers
BenchMode add_bench_peer(CommandLine& program);
BenchMode add_bench_query(CommandLine& program);
BenchMode add_bench_scaling(CommandLine& program);
BenchMode add_bench_sea_state(CommandLine& program);
BenchMode add_bench_shading(CommandLine& program);
BenchMode add_bench_terrain(CommandLine& program);
BenchMode add_bench_waves(CommandLine& program);

class Stopwatch {
 public:
  double elapsed_ms() const {
    return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace swell::apps
