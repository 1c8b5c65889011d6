#include "apps/shared/program.h"

#include <fmt/core.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include "math/simd_target.h"
#include "scene/scene.h"
#include "texture/image/image_io.h"

namespace swell::apps {
namespace {

int report(int exit_code, const std::string& message) {
  std::fputs(fmt::format("error: {}\n", one_line(message)).c_str(), stderr);
  return exit_code;
}

int run_and_report(FunctionRef<void()> work) {
  try {
    work();
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      return report(kExitFailure, "cannot write to standard output");
    return kExitDone;
  } catch (const OptionError& e) {
    return report(kExitBadInput, e.what());
  } catch (const scene::SceneError& e) {
    return report(kExitBadInput, e.what());
  } catch (const texture::FileError& e) {
    return report(kExitBadInput, e.what());
  } catch (const std::invalid_argument& e) {  // values of a scene that only the sea can judge
    return report(kExitBadInput, e.what());
  } catch (const std::bad_alloc&) {
    return report(kExitFailure, "out of memory");
  } catch (const std::exception& e) {
    return report(kExitFailure, e.what());
  }
}

// For what no catch can see: oneTBB ends the program where it gets no thread or no memory for one.
[[noreturn]] void report_and_exit() {
  const char* what = "unknown fault";
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    what = "out of memory";
  } catch (const std::exception& e) {
    report(kExitFailure, e.what());
    _exit(kExitFailure);
  } catch (...) {
  }
  std::fprintf(stderr, "error: %s\n", what);
  _exit(kExitFailure);
}

}  // namespace

int run_program(FunctionRef<void()> work) {
  if (!cpu_is_supported())
    return report(kExitFailure,
                  fmt::format("this CPU cannot run swell: it needs {}", cpu_requirement()));
  std::set_terminate(report_and_exit);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  return run_and_report(work);
}

std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace swell::apps
