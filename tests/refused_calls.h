// For a child process: system calls that fail from now on, also in what it executes. The same for
// root and everyone else, on every file system. x86-64.
#pragma once

#include <errno.h>
#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

#include <cstddef>
#include <cstdint>
#include <iterator>

namespace swell {

// Call number `call` fails with `error` if `argument` (0 to 5) has one of the bits. False if the
// system does not let us.
inline bool refuse_call(long call, int argument, std::uint32_t bits, int error) {
  const auto argument_at = static_cast<std::uint32_t>(offsetof(seccomp_data, args) +
                                                      8 * static_cast<unsigned>(argument));
  sock_filter code[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 3),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, argument_at),
      BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, bits, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | static_cast<std::uint32_t>(error)),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  const sock_fprog program{std::size(code), code};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

// As on a file system without O_TMPFILE.
inline bool refuse_unnamed_files() {
  constexpr std::uint32_t kUnnamed = O_TMPFILE & ~O_DIRECTORY;
#ifdef SYS_open  // which 64-bit Arm does not have
  if (!refuse_call(SYS_open, 1, kUnnamed, EOPNOTSUPP)) return false;
#endif
  return refuse_call(SYS_openat, 2, kUnnamed, EOPNOTSUPP);
}

// As without /proc: unnamed files can be made but not named.
inline bool refuse_links() { return refuse_call(SYS_linkat, 4, ~0u, ENOENT); }

// As where a user or a container may have no more threads.
inline bool refuse_threads() {
  return refuse_call(SYS_clone3, 1, ~0u, ENOSYS) &&  // whose flags a filter cannot see
         refuse_call(SYS_clone, 0, CLONE_THREAD, EAGAIN);
}

}  // namespace swell
