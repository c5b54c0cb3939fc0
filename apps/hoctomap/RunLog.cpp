// SPDX-License-Identifier: BSD-3-Clause
#include "RunLog.h"

#include <iostream>

#include "Terminal.h"
#include "hoctomap/io/EscapedText.h"

namespace hoctomap {

using mrpt::system::VerbosityLevel;

RunLog::RunLog(int verbose, bool quiet)
    : shown_(quiet         ? mrpt::system::LVL_WARN
             : verbose > 0 ? mrpt::system::LVL_DEBUG
                           : mrpt::system::LVL_INFO) {
  logger_.logging_enable_console_output = false;  // MRPT's console is stdout, which is for results
  logger_.setMinLoggingLevel(mrpt::system::LVL_DEBUG);
  logger_.logRegisterCallback([this](std::string_view text, const VerbosityLevel level, std::string_view,
                                     const mrpt::Clock::time_point) { write(text, level); });
}

void RunLog::writeTo(const std::filesystem::path& file) {
  file_.open(file, std::ios::trunc);
  file_ << before_file_ << std::flush;
  before_file_.clear();
}

void RunLog::debug(const std::string& text) {
  logger_.logStr(mrpt::system::LVL_DEBUG, text);
}
void RunLog::info(const std::string& text) {
  logger_.logStr(mrpt::system::LVL_INFO, text);
}
void RunLog::warn(const std::string& text) {
  if (warned_.insert(text).second) logger_.logStr(mrpt::system::LVL_WARN, "warning: " + text);
}

void RunLog::write(std::string_view text, VerbosityLevel level) {
  const std::string line = escapedText(text) + "\n";
  if (file_.is_open()) {
    file_ << line << std::flush;
  } else {
    before_file_ += line;
  }
  if (level < shown_) return;
  if (line_in_progress_) std::cerr << "\r\033[K";
  std::cerr << (level == mrpt::system::LVL_WARN ? coloured(line, Colour::yellow) : line) << std::flush;
}

}  // namespace hoctomap
