#include "apps/shared/output_file.h"

#include <fmt/core.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <string_view>

#include "texture/image/image_io.h"
#include "texture/image/signal_lock.h"

namespace swell::apps {
namespace {

namespace fs = std::filesystem;

// Those that end a program from outside. Its own faults (SIGSEGV, SIGABRT) leave a temporary file
// to the next run.
constexpr std::array kEndingSignals = {SIGHUP,  SIGINT,  SIGQUIT,   SIGTERM, SIGUSR1,
                                       SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF, SIGXCPU};

constinit texture::SignalLock handlers_lock;

// Handler: cleans up, then ends the program by the same signal. Keeps the lock: nobody installs
// another handler before that, and other signals wait.
void abandon_and_die(int signal) {
  handlers_lock.take();
  texture::abandon_writes();
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  sigaction(signal, &action, nullptr);
  sigset_t only;
  sigemptyset(&only);
  sigaddset(&only, signal);
  pthread_sigmask(SIG_UNBLOCK, &only, nullptr);
  raise(signal);
}

// Handles the signals that would end the program, while it lives.
class AbandonOnSignals {
 public:
  AbandonOnSignals() {
    const texture::SignalLockGuard guard(handlers_lock);
    struct sigaction ours {};
    ours.sa_handler = abandon_and_die;
    sigfillset(&ours.sa_mask);
    for (std::size_t i = 0; i < before_.size(); ++i) {
      sigaction(kEndingSignals[i], nullptr, &before_[i]);
      if (before_[i].sa_handler == SIG_DFL) sigaction(kEndingSignals[i], &ours, nullptr);
    }
  }
  ~AbandonOnSignals() {
    const texture::SignalLockGuard guard(handlers_lock);
    for (std::size_t i = 0; i < before_.size(); ++i)
      if (before_[i].sa_handler == SIG_DFL) sigaction(kEndingSignals[i], &before_[i], nullptr);
  }
  AbandonOnSignals(const AbandonOnSignals&) = delete;
  AbandonOnSignals& operator=(const AbandonOnSignals&) = delete;

 private:
  std::array<struct sigaction, kEndingSignals.size()> before_{};
};

}  // namespace

void refuse_output(const fs::path& path, std::string_view what) {
  throw texture::FileError(fmt::format("{}: {}", path.string(), what));
}

void check_output_place(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code error;
  if (!fs::is_directory(folder, error))
    refuse_output(path, "got a folder that is not there, allowed one that is");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    refuse_output(path, "got a folder that cannot be written to, allowed one that can");
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::none) refuse_output(path, error.message());
  if (fs::is_directory(status)) refuse_output(path, "got a directory, allowed a file's name");
  texture::remove_abandoned_files(folder);
}

void write_output(const fs::path& path, std::span<const std::uint8_t> bytes) {
  const AbandonOnSignals while_writing;
  texture::write_file(path, bytes);
}

void write_output(const texture::OutputFolder& folder, const std::string& name,
                  std::span<const std::uint8_t> bytes) {
  const AbandonOnSignals while_writing;
  folder.write(name, bytes);
}

}  // namespace swell::apps
