// Runs swell-render and swell-bench as a user does: exit code, standard output, standard error.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scratch_folder.h"

namespace swell::apps {

using Arguments = std::vector<std::string>;

struct Outcome {
  int exit_code = -1;  // -signal if a signal ended the program
  std::string out, err;
  double cpu_ms = 0.0;  // what it computed
};

struct Surroundings {
  long max_file_bytes = -1;          // RLIMIT_FSIZE; -1: none
  std::string standard_output = {};  // a path to use instead of the file that fills Outcome::out
  long max_memory_bytes = -1;        // RLIMIT_AS; -1: none
  bool unnamed_files = true;         // false: as on a file system without O_TMPFILE
  bool threads = true;               // false: no thread can be started
  bool own_user = false;             // a user who may have this one process; root becomes another
  Arguments environment = {};        // NAME=VALUE, added to the test's own
  int signal = 0;                    // sent to the program after so long; 0: none
  std::uint64_t signal_after_us = 0;
};

// In a child just forked: it ends when its parent does, and the signal (0: none) ends it though
// whoever started the tests has it ignored, as nohup has SIGHUP.
void begin_child(int signal);

Outcome run_render(const Arguments& arguments, const Surroundings& surroundings = {});
Outcome run_bench(const Arguments& arguments, const Surroundings& surroundings = {});
Outcome run_program(const std::string& program, const Arguments& arguments,
                    const Surroundings& surroundings = {});
std::string render_program();  // its path

// False where the sanitizers need more memory, threads and time than a test of these can give.
constexpr bool can_limit_resources() {
#ifdef SWELL_SANITIZED
  return false;
#else
  return true;
#endif
}

std::string read_text(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, const std::string& text);

// Small scenes that draw in milliseconds. The sea's camera moves, turns and sees the horizon.
std::string sea_scene_text();
std::string island_scene_text();

// True if `text` is one line 'error: ...' that holds all pieces.
bool is_one_error_line(const std::string& text, const std::vector<std::string>& pieces = {});

}  // namespace swell::apps
