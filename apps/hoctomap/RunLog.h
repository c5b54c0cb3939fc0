// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/system/COutputLogger.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

namespace hoctomap {

/// The program's log: stderr, and `log.txt` once there is a directory for it.
class RunLog {
 public:
  RunLog(int verbose, bool quiet);

  /// From now on everything goes to this file, too, what was said before first.
  void writeTo(const std::filesystem::path& file);

  void debug(const std::string& text);
  void info(const std::string& text);
  /// Says each text once.
  void warn(const std::string& text);

  /// To be cleared from the terminal before a line is written: the progress bar.
  void setLineInProgress(bool in_progress) { line_in_progress_ = in_progress; }

 private:
  void write(std::string_view text, mrpt::system::VerbosityLevel level);

  mrpt::system::COutputLogger logger_{"hoctomap"};
  mrpt::system::VerbosityLevel shown_;
  std::ofstream file_;
  std::string before_file_;
  std::set<std::string> warned_;
  bool line_in_progress_ = false;
};

}  // namespace hoctomap
