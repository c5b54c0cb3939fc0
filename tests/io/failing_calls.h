// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

namespace hoctomap::test {

/// While it lives, one system call that changes files fails: open for writing, pwrite, fsync, ftruncate,
/// rename, close, link, unlink, mkdir. The linker puts the counting calls in place of the system's
/// (CMakeLists.txt).
class FailingCall {
 public:
  /// What becomes of the calls after the one that fails.
  enum class Then {
    goes_on,
    full,     ///< a pwrite writes a half first, and all calls after it that need room fail, as on a full disk
    gone,     ///< all of them fail
    nothing,  ///< as `goes_on`; a pwrite does not fail, but writes nothing
  };
  /// Call number `n`, from 0, fails with `error` (an errno).
  FailingCall(int n, int error, Then then = Then::goes_on);
  ~FailingCall();
  FailingCall(const FailingCall&) = delete;
  FailingCall& operator=(const FailingCall&) = delete;

  /// Whether it has failed yet: the calls were fewer otherwise.
  [[nodiscard]] bool reached() const;
};

/// While it lives, one call of fstat or read goes wrong.
class FailingRead {
 public:
  enum class How {
    no_status,    ///< fstat fails
    no_bytes,     ///< read fails
    interrupted,  ///< read fails, but would not if it were called again
    cut,          ///< read finds the end of the file: it has become shorter since its size was asked for
  };
  /// Call number `n`, from 0, of the one that `how` is about.
  FailingRead(int n, How how);
  ~FailingRead();
  FailingRead(const FailingRead&) = delete;
  FailingRead& operator=(const FailingRead&) = delete;

  [[nodiscard]] bool reached() const;
};

/// While it lives, `action` is done before the first lock that is taken (flock).
class BeforeLock {
 public:
  explicit BeforeLock(std::function<void()> action);
  ~BeforeLock();
  BeforeLock(const BeforeLock&) = delete;
  BeforeLock& operator=(const BeforeLock&) = delete;
};

/// While it lives, OpenSSL knows no hash functions.
class NoHashFunctions {
 public:
  NoHashFunctions();
  ~NoHashFunctions();
  NoHashFunctions(const NoHashFunctions&) = delete;
  NoHashFunctions& operator=(const NoHashFunctions&) = delete;
};

}  // namespace hoctomap::test
