// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace hoctomap {

/// Seconds that this process has spent, all its threads together.
struct Elapsed {
  double user_s = 0.0;  ///< of the processor, outside the kernel: what the ratios are made of
  double cpu_s = 0.0;   ///< of the processor, with the kernel's share (page faults)
  double wall_s = 0.0;

  Elapsed& operator+=(const Elapsed& other);
  friend Elapsed operator-(const Elapsed& a, const Elapsed& b) {
    return {a.user_s - b.user_s, a.cpu_s - b.cpu_s, a.wall_s - b.wall_s};
  }
};

/// Measures from its construction on.
class Stopwatch {
 public:
  Stopwatch() : start_(now()) {}
  [[nodiscard]] Elapsed elapsed() const { return now() - start_; }

 private:
  [[nodiscard]] static Elapsed now();
  Elapsed start_;
};

}  // namespace hoctomap
