// swell-bench's subcommands: each adds itself to the command line and says what to run.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <functional>

namespace swell::apps {

struct Subcommand {
  CLI::App* app;
  std::function<void()> run;  // after `app` has been parsed
};

Subcommand add_bench_frame(CLI::App& app);
Subcommand add_bench_lod(CLI::App& app);
Subcommand add_bench_query(CLI::App& app);
Subcommand add_bench_sea_state(CLI::App& app);
Subcommand add_bench_waves(CLI::App& app);

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
