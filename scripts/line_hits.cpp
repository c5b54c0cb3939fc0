// SPDX-License-Identifier: BSD-3-Clause
// Which lines a program comes to, without building it for that: a library to be loaded before it
// (LD_PRELOAD). At each of the addresses in LINE_HITS/NAME.addresses (offsets, 8 bytes each, sorted; NAME is
// the program's file name) stands a breakpoint; the first time the program comes by, it is taken out, and a
// byte of LINE_HITS/NAME.hits is set, in shared memory: that outlives kills and _exit(), and needs no file to
// be opened later, which a confined process could not. x86-64, Linux.
#include <fcntl.h>
#include <link.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <ucontext.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

constexpr unsigned char kBreakpoint = 0xCC;

struct Hits {
  std::uintptr_t base = 0;
  std::size_t count = 0;
  const std::uint64_t* offsets = nullptr;
  unsigned char* hits = nullptr;
  unsigned char* original = nullptr;  // the bytes under the breakpoints
};
Hits g;  // a signal handler takes no context

void* mapped(const std::string& file, std::size_t& bytes, int protection) {
  const int fd =
      open(file.c_str(), (protection & PROT_WRITE) != 0 ? O_RDWR | O_CLOEXEC : O_RDONLY | O_CLOEXEC);
  struct stat info {};
  if (fd < 0 || fstat(fd, &info) != 0) return nullptr;
  bytes = static_cast<std::size_t>(info.st_size);
  void* memory = mmap(nullptr, bytes, protection, MAP_SHARED, fd, 0);
  close(fd);
  return memory == MAP_FAILED ? nullptr : memory;
}

void onBreakpoint(int, siginfo_t*, void* context) {
  auto& rip = static_cast<ucontext_t*>(context)->uc_mcontext.gregs[REG_RIP];
  const std::uintptr_t at = static_cast<std::uintptr_t>(rip) - 1;
  const std::uint64_t* end = g.offsets + g.count;
  const std::uint64_t* found = std::lower_bound(g.offsets, end, at - g.base);
  if (found == end || *found != at - g.base) return;  // none of ours
  const auto i = static_cast<std::size_t>(found - g.offsets);
  *reinterpret_cast<volatile unsigned char*>(at) = g.original[i];
  g.hits[i] = 1;
  rip = static_cast<greg_t>(at);
}

/// Makes the program's code writable. @return 1, to end the walk at the first object: the program itself
int openCode(dl_phdr_info* info, std::size_t, void*) {
  g.base = info->dlpi_addr;
  const std::uintptr_t page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const auto& segment = info->dlpi_phdr[i];
    if (segment.p_type != PT_LOAD || (segment.p_flags & PF_X) == 0) continue;
    const std::uintptr_t begin = (g.base + segment.p_vaddr) / page * page;
    const std::uintptr_t end = g.base + segment.p_vaddr + segment.p_memsz;
    mprotect(reinterpret_cast<void*>(begin), end - begin, PROT_READ | PROT_WRITE | PROT_EXEC);
  }
  return 1;
}

__attribute__((constructor)) void begin() {
  const char* folder = std::getenv("LINE_HITS");
  if (folder == nullptr) return;
  char path[4096] = {};
  if (readlink("/proc/self/exe", path, sizeof path - 1) < 0) return;
  const std::string program(path);
  const std::string name = std::string(folder) + "/" + program.substr(program.rfind('/') + 1);
  std::size_t bytes = 0;
  g.offsets = static_cast<const std::uint64_t*>(mapped(name + ".addresses", bytes, PROT_READ));
  if (g.offsets == nullptr) return;
  g.count = bytes / sizeof(std::uint64_t);
  g.hits = static_cast<unsigned char*>(mapped(name + ".hits", bytes, PROT_READ | PROT_WRITE));
  g.original = static_cast<unsigned char*>(
      mmap(nullptr, g.count, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
  if (g.hits == nullptr || bytes != g.count || g.original == MAP_FAILED) return;
  struct sigaction action {};
  action.sa_sigaction = onBreakpoint;
  action.sa_flags = SA_SIGINFO | SA_NODEFER;
  sigaction(SIGTRAP, &action, nullptr);
  dl_iterate_phdr(openCode, nullptr);
  for (std::size_t i = 0; i < g.count; ++i) {
    auto* at = reinterpret_cast<unsigned char*>(g.base + g.offsets[i]);
    g.original[i] = *at;
    if (g.hits[i] == 0) *at = kBreakpoint;
  }
}

}  // namespace
