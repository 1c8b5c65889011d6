// Runs swell-render and swell-bench as a user does: exit code, standard output, standard error.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace swell::apps {

struct Outcome {
  int exit_code = -1;  // -signal if a signal ended the program
  std::string out, err;
};

struct Surroundings {
  long max_file_bytes = -1;          // RLIMIT_FSIZE; -1: none
  std::string standard_output = {};  // a path to use instead of the file that fills Outcome::out
  bool unnamed_files = true;         // false: as on a file system without O_TMPFILE
  int signal = 0;                    // sent to the program after so long; 0: none
  std::uint64_t signal_after_us = 0;
};

using Arguments = std::vector<std::string>;
Outcome run_render(const Arguments& arguments, const Surroundings& surroundings = {});
Outcome run_bench(const Arguments& arguments, const Surroundings& surroundings = {});

// A directory that is removed with everything in it.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::vector<std::string> names() const;  // of all files, sorted

 private:
  std::filesystem::path path_;
};

std::string read_text(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, const std::string& text);

// Small scenes that draw in milliseconds. The sea's camera moves, turns and sees the horizon.
std::string sea_scene_text();
std::string island_scene_text();

// True if `text` is one line 'error: ...' that holds all pieces.
bool is_one_error_line(const std::string& text, const std::vector<std::string>& pieces = {});

}  // namespace swell::apps
