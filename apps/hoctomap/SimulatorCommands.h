// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hoctomap {

/// Options of `hoctomap simulate`.
struct SimulateOptions {
  std::string scene;
  std::string log;
  std::string truth;
  std::vector<std::string> overrides;
  int threads = 0;
  bool quiet = false;
};

/// Options of `hoctomap explore`.
struct ExploreOptions {
  std::string scene;
  std::string output;
  std::optional<std::string> config;
  std::vector<std::string> overrides;
  std::optional<std::uint64_t> seed;
  bool overwrite = false;
  int threads = 0;
  int verbose = 0;
  bool quiet = false;
};

// The commands that need the simulated sensor, and with it the libraries that trace rays and read meshes.
// They run in the program hoctomap-simulator, which `hoctomap` becomes when one of them is chosen
// (HandOver.cpp), so that no other command loads those. @return the exit code
int simulate(const SimulateOptions& options);
int explore(const ExploreOptions& options);

}  // namespace hoctomap
