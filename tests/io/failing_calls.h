// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace hoctomap::test {

/// While it lives, one system call that changes files fails: open for writing, pwrite, fsync, ftruncate,
/// rename, close, link, unlink, mkdir. The linker puts the counting calls in place of the system's
/// (CMakeLists.txt).
class FailingCall {
 public:
  /// What becomes of the calls after the one that fails.
  enum class Then {
    goes_on,
    full,  ///< a pwrite writes a half first, and all calls after it that need room fail, as on a full disk
    gone,  ///< all of them fail
  };
  /// Call number `n`, from 0, fails with `error` (an errno).
  FailingCall(int n, int error, Then then = Then::goes_on);
  ~FailingCall();
  FailingCall(const FailingCall&) = delete;
  FailingCall& operator=(const FailingCall&) = delete;

  /// Whether it has failed yet: the calls were fewer otherwise.
  [[nodiscard]] bool reached() const;
};

}  // namespace hoctomap::test
