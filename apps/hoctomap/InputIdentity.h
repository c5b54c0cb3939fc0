// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hoctomap/io/LogReadOptions.h"

namespace hoctomap {

/// What a map remembers its input by (`Manifest::input`): the contents of the logs, and how they are read.
class InputIdentity {
 public:
  /// @param log_sha256  of each log  @throws InputError if a pose file cannot be read.
  InputIdentity(const LogReadOptions& options, std::vector<std::string> log_sha256);

  [[nodiscard]] std::string text() const;

  /// Why a map whose input was `earlier` cannot be gone on with from this one; nothing if it can: it has the
  /// same logs, read in the same way, and perhaps further ones behind them.
  [[nodiscard]] std::optional<std::string> contradiction(const std::string& earlier) const;

 private:
  std::vector<std::filesystem::path> logs_;
  std::vector<std::string> log_sha256_;
  std::string reading_;  ///< hash of all options that say what comes out of the logs
};

}  // namespace hoctomap
