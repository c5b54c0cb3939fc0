// SPDX-License-Identifier: BSD-3-Clause
#include "Confinement.h"

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hoctomap {

namespace {

void forbidChangingFiles() {
  const long version = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) return;
  landlock_ruleset_attr rules{};  // what is named here is forbidden everywhere, because no rule allows it
  rules.handled_access_fs =
      LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR |
      LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR | LANDLOCK_ACCESS_FS_MAKE_DIR |
      LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO |
      LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;
  if (version >= 2) rules.handled_access_fs |= LANDLOCK_ACCESS_FS_REFER;
  constexpr std::uint64_t kTruncate = std::uint64_t{1} << 14;  // of Linux 6.2, which the header does not know
  if (version >= 3) rules.handled_access_fs |= kTruncate;
  const auto fd = static_cast<int>(::syscall(SYS_landlock_create_ruleset, &rules, sizeof rules, 0));
  if (fd < 0) return;
  ::syscall(SYS_landlock_restrict_self, fd, 0);
  ::close(fd);
}

#if defined(__x86_64__)
constexpr std::uint32_t kMachine = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kMachine = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t kMachine = 0;  // no filter
#endif

/// Calls of which a reader of files needs none: programs, processes, sockets, what Landlock does not cover of
/// files, and ways around a filter.
constexpr std::uint32_t kForbidden[] = {
    SYS_execve,
    SYS_execveat,
    SYS_socket,
    SYS_socketpair,
    SYS_connect,
    SYS_bind,
    SYS_ptrace,
    SYS_process_vm_readv,
    SYS_process_vm_writev,
    SYS_pidfd_open,
    SYS_kill,
    SYS_pidfd_send_signal,
    SYS_io_uring_setup,
    SYS_bpf,
    SYS_userfaultfd,
    SYS_keyctl,
    SYS_add_key,
    SYS_perf_event_open,
    SYS_fchmod,
    SYS_fchmodat,
    SYS_fchown,
    SYS_fchownat,
    SYS_setxattr,
    SYS_fsetxattr,
    SYS_utimensat,
    SYS_mount,
    SYS_umount2,
    SYS_unshare,
    SYS_setns,
    SYS_open_by_handle_at,
    SYS_truncate,
    SYS_unlinkat,
    SYS_renameat2,
    SYS_linkat,
    SYS_symlinkat,
    SYS_mkdirat,
    SYS_mknodat,
#if defined(__x86_64__)
    SYS_fork,
    SYS_vfork,
    SYS_chmod,
    SYS_chown,
    SYS_lchown,
    SYS_unlink,
    SYS_rename,
    SYS_link,
    SYS_symlink,
    SYS_mkdir,
    SYS_rmdir,
    SYS_creat,
    SYS_mknod,
    SYS_utime,
    SYS_utimes,
#endif
};

constexpr sock_filter load(std::size_t offset) {
  return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset));
}
constexpr sock_filter jump(std::uint16_t test, std::uint32_t value, std::uint8_t if_true,
                           std::uint8_t if_false) {
  return BPF_JUMP(static_cast<std::uint16_t>(BPF_JMP | test | BPF_K), value, if_true, if_false);
}
constexpr sock_filter answer(std::uint32_t what) {
  return BPF_STMT(BPF_RET | BPF_K, what);
}

void forbidTheRest() {
  if (kMachine == 0) return;
  constexpr auto kRefuse = static_cast<std::uint32_t>(SECCOMP_RET_ERRNO) | EPERM;
  constexpr auto kUnknown = static_cast<std::uint32_t>(SECCOMP_RET_ERRNO) | ENOSYS;
  std::vector<sock_filter> filter{load(offsetof(seccomp_data, arch)), jump(BPF_JEQ, kMachine, 1, 0),
                                  answer(kRefuse),  // calls of another machine have other numbers
                                  load(offsetof(seccomp_data, nr))};
#if defined(__x86_64__)
  constexpr std::uint32_t kX32 = 0x40000000;  // as have those of the x32 ABI
  filter.insert(filter.end(), {jump(BPF_JGE, kX32, 0, 1), answer(kRefuse)});
#endif
  for (const std::uint32_t call : kForbidden)
    filter.insert(filter.end(), {jump(BPF_JEQ, call, 0, 1), answer(kRefuse)});
  filter.insert(filter.end(), {jump(BPF_JEQ, SYS_clone3, 0, 1), answer(kUnknown)});  // then glibc takes clone
  filter.insert(filter.end(),
                {// a new thread is one thing, a new process another
                 jump(BPF_JEQ, SYS_clone, 0, 3), load(offsetof(seccomp_data, args)),
                 jump(BPF_JSET, CLONE_THREAD, 1, 0), answer(kRefuse), answer(SECCOMP_RET_ALLOW)});
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
}

}  // namespace

void confine() {
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return;
  forbidChangingFiles();
  forbidTheRest();
}

}  // namespace hoctomap
