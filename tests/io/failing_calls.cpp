// SPDX-License-Identifier: BSD-3-Clause
#include "failing_calls.h"

#include <fcntl.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <sys/types.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <utility>

namespace {

// The calls below take no context.
std::atomic<bool> g_armed{false};
std::atomic<int> g_left{0};
std::atomic<int> g_error{0};
std::atomic<hoctomap::test::FailingCall::Then> g_then{};
std::atomic<bool> g_full{false};
using How = hoctomap::test::FailingRead::How;
std::atomic<bool> g_reads_armed{false};
std::atomic<int> g_reads_left{0};
std::atomic<How> g_how{};
std::function<void()> g_before_lock;
std::atomic<bool> g_no_hash_functions{false};

/// Counts a call; whether it is the one to fail.
bool fails() {
  if (!g_armed) return false;
  const int left = g_left--;
  if (left > 0 || (left < 0 && g_then != hoctomap::test::FailingCall::Then::gone)) return false;
  errno = g_error;
  return true;
}

/// Counts a call of fstat or of read.
bool readFails(bool is_status) {
  return g_reads_armed && is_status == (g_how == How::no_status) && g_reads_left-- == 0;
}

}  // namespace

extern "C" {

int __real_open(const char* file, int flags, ...);
ssize_t __real_pwrite(int fd, const void* from, std::size_t bytes, off_t at);
int __real_fsync(int fd);
int __real_ftruncate(int fd, off_t size);
int __real_rename(const char* from, const char* to);
int __real_close(int fd);
int __real_link(const char* from, const char* to);
int __real_unlink(const char* file);
int __real_mkdir(const char* directory, mode_t mode);
ssize_t __real_read(int fd, void* to, std::size_t bytes);
int __real_fstat(int fd, struct stat* info);
int __real_flock(int fd, int operation);
int __real_EVP_DigestInit_ex(EVP_MD_CTX* context, const EVP_MD* type, ENGINE* engine);

int __wrap_open(const char* file, int flags, ...) {
  if ((flags & O_ACCMODE) != O_RDONLY && fails()) return -1;
  std::va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  return __real_open(file, flags, mode);
}
ssize_t __wrap_pwrite(int fd, const void* from, std::size_t bytes, off_t at) {
  if (g_armed && g_full) return errno = g_error, -1;
  if (!fails()) return __real_pwrite(fd, from, bytes, at);
  if (g_then == hoctomap::test::FailingCall::Then::nothing) return 0;
  if (g_then != hoctomap::test::FailingCall::Then::full) return -1;
  g_full = true;
  return __real_pwrite(fd, from, (bytes + 1) / 2, at);
}
int __wrap_fsync(int fd) {
  return fails() ? -1 : __real_fsync(fd);
}
int __wrap_ftruncate(int fd, off_t size) {
  return fails() ? -1 : __real_ftruncate(fd, size);
}
int __wrap_rename(const char* from, const char* to) {
  return fails() ? -1 : __real_rename(from, to);
}
int __wrap_close(int fd) {  // closes in any case, as Linux does
  const bool failed = fails();
  const int result = __real_close(fd);
  if (failed) errno = g_error;
  return failed ? -1 : result;
}
int __wrap_link(const char* from, const char* to) {
  return fails() ? -1 : __real_link(from, to);
}
int __wrap_unlink(const char* file) {
  return fails() ? -1 : __real_unlink(file);
}
int __wrap_mkdir(const char* directory, mode_t mode) {
  return fails() ? -1 : __real_mkdir(directory, mode);
}
ssize_t __wrap_read(int fd, void* to, std::size_t bytes) {
  if (!readFails(false)) return __real_read(fd, to, bytes);
  if (g_how == How::cut) return 0;
  return errno = g_how == How::interrupted ? EINTR : EIO, -1;
}
int __wrap_fstat(int fd, struct stat* info) {
  return readFails(true) ? (errno = EIO, -1) : __real_fstat(fd, info);
}
int __wrap_flock(int fd, int operation) {
  if (const auto action = std::exchange(g_before_lock, nullptr)) action();
  return __real_flock(fd, operation);
}
int __wrap_EVP_DigestInit_ex(EVP_MD_CTX* context, const EVP_MD* type, ENGINE* engine) {
  return g_no_hash_functions ? 0 : __real_EVP_DigestInit_ex(context, type, engine);
}

}  // extern "C"

namespace hoctomap::test {

FailingCall::FailingCall(int n, int error, Then then) {
  g_left = n;
  g_error = error;
  g_then = then;
  g_full = false;
  g_armed = true;
}

FailingCall::~FailingCall() {
  g_armed = false;
}

bool FailingCall::reached() const {
  return g_left < 0;
}

FailingRead::FailingRead(int n, How how) {
  g_reads_left = n;
  g_how = how;
  g_reads_armed = true;
}

FailingRead::~FailingRead() {
  g_reads_armed = false;
}

bool FailingRead::reached() const {
  return g_reads_left < 0;
}

BeforeLock::BeforeLock(std::function<void()> action) {
  g_before_lock = std::move(action);
}

BeforeLock::~BeforeLock() {
  g_before_lock = nullptr;
}

NoHashFunctions::NoHashFunctions() {
  g_no_hash_functions = true;
}

NoHashFunctions::~NoHashFunctions() {
  g_no_hash_functions = false;
}

}  // namespace hoctomap::test
