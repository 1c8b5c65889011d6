#include "apps/shared/program_runner.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <sstream>

#include "refused_calls.h"

namespace swell::apps {
namespace {

void replace_stream(int stream, const std::string& path, int flags) {
  const int file = open(path.c_str(), flags, 0600);
  if (file < 0 || dup2(file, stream) < 0) _exit(126);
  close(file);
}

// In the child: never returns.
[[noreturn]] void become(const std::string& program, const Arguments& arguments,
                         const Surroundings& surroundings, const std::string& out,
                         const std::string& err) {
  begin_child(surroundings.signal);
  replace_stream(STDIN_FILENO, "/dev/null", O_RDONLY);
  replace_stream(STDOUT_FILENO, out, O_WRONLY | O_CREAT | O_TRUNC);
  replace_stream(STDERR_FILENO, err, O_WRONLY | O_CREAT | O_TRUNC);
  if (surroundings.max_file_bytes >= 0) {
    const auto bytes = static_cast<rlim_t>(surroundings.max_file_bytes);
    const rlimit limit{bytes, bytes};
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(126);
  }
  if (surroundings.max_memory_bytes >= 0) {
    const auto bytes = static_cast<rlim_t>(surroundings.max_memory_bytes);
    const rlimit limit{bytes, bytes};
    if (setrlimit(RLIMIT_AS, &limit) != 0) _exit(126);
  }
  if (surroundings.own_user) {
    constexpr unsigned kNobodyElse = 54321;
    if (geteuid() == 0 && (setgid(kNobodyElse) != 0 || setuid(kNobodyElse) != 0)) _exit(126);
    const rlimit limit{1, 1};
    if (setrlimit(RLIMIT_NPROC, &limit) != 0) _exit(126);
  }
  if (!surroundings.threads && !refuse_threads()) _exit(126);
  for (const std::string& variable : surroundings.environment)
    putenv(const_cast<char*>(variable.c_str()));
  if (!surroundings.unnamed_files && !refuse_unnamed_files()) _exit(126);
  std::vector<char*> argv = {const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  _exit(127);
}

}  // namespace

void begin_child(int signal) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (signal != 0 && signal != SIGKILL) std::signal(signal, SIG_DFL);
}

Outcome run_program(const std::string& program, const Arguments& arguments,
                    const Surroundings& surroundings) {
  const ScratchFolder folder;
  const std::string out =
      surroundings.standard_output.empty() ? folder.file("out") : surroundings.standard_output;
  const std::string err = folder.file("err");
  const pid_t child = fork();
  if (child == 0) become(program, arguments, surroundings, out, err);
  if (child > 0 && surroundings.signal != 0) {
    usleep(static_cast<useconds_t>(surroundings.signal_after_us));
    kill(child, surroundings.signal);
  }
  int status = 0;
  rusage usage{};
  if (child < 0 || wait4(child, &status, 0, &usage) != child) {
    ADD_FAILURE() << "cannot run " << program;
    return {};
  }
  Outcome outcome;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  if (surroundings.standard_output.empty()) outcome.out = read_text(out);
  outcome.err = read_text(err);
  for (const timeval& time : {usage.ru_utime, usage.ru_stime})
    outcome.cpu_ms +=
        static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_usec) / 1e3;
  return outcome;
}

Outcome run_render(const Arguments& arguments, const Surroundings& surroundings) {
  return run_program(SWELL_RENDER, arguments, surroundings);
}

std::string render_program() { return SWELL_RENDER; }

Outcome run_bench(const Arguments& arguments, const Surroundings& surroundings) {
  return run_program(SWELL_BENCH, arguments, surroundings);
}

std::string read_text(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::string sea_scene_text() {
  return R"(
[camera]
eye_m = [3.0, -20.0, 12.0]
heading_deg = 20.0
pitch_deg = -8.0
velocity_mps = [2.0, 5.0, 0.0]
turn_deg_s = 3.0
[sea]
resolution = 32
size_m = [1000.0, 1000.0]
[wind]
speed_mps = 11.0
from_deg = 200.0
[sky]
model = "gradient"
[detail]
water_triangles = 1500
)";
}

std::string island_scene_text() {
  return sea_scene_text() + R"(terrain_triangles = 1500
[terrain]
island_radius_m = 60.0
island_height_m = 25.0
centre_m = [40.0, 150.0]
)";
}

bool is_one_error_line(const std::string& text, const std::vector<std::string>& pieces) {
  if (!text.starts_with("error: ") || std::ranges::count(text, '\n') != 1 || text.back() != '\n')
    return false;
  return std::ranges::all_of(
      pieces, [&](const std::string& p) { return text.find(p) != std::string::npos; });
}

}  // namespace swell::apps
