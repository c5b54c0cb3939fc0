// SPDX-License-Identifier: BSD-3-Clause
#include "InputIdentity.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/Sha256.h"

namespace hoctomap {

namespace {

constexpr char kBetween = '+';  // the logs
constexpr char kBeforeReading = ' ';

std::string hashOfFile(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) throw InputError(escapedText(file.string()) + ": cannot be read");
  return sha256Hex(bytes);
}

/// What a run may change when it goes on is left out: where it stops, what it does about damage, and limits.
std::string hashOfReading(const LogReadOptions& options) {
  LogReadOptions reading;
  reading.poses = options.poses;
  if (!options.poses.empty() && options.poses != "identity" && options.poses != "odometry")
    reading.poses = "sha256:" + hashOfFile(options.poses);
  reading.pose_label = options.pose_label;
  reading.up = options.up;
  reading.sensors = options.sensors;
  std::sort(reading.sensors.begin(), reading.sensors.end());
  reading.start = options.start;
  reading.every = options.every;
  Sha256 hash;
  for (const std::string& word : toArguments(reading)) hash.add(word + '\n');
  return hash.hex();
}

}  // namespace

InputIdentity::InputIdentity(const LogReadOptions& options, std::vector<std::string> log_sha256)
    : logs_(options.logs), log_sha256_(std::move(log_sha256)), reading_(hashOfReading(options)) {}

std::string InputIdentity::text() const {
  std::string text;
  for (const std::string& hash : log_sha256_) text += (text.empty() ? "" : std::string(1, kBetween)) + hash;
  return text + kBeforeReading + reading_;
}

std::optional<std::string> InputIdentity::contradiction(const std::string& earlier) const {
  const auto end = earlier.find(kBeforeReading);
  if (end == std::string::npos) return "the map was not built from logs";
  std::size_t count = 0;
  for (std::size_t at = 0; at < end; ++count) {
    const std::size_t next = std::min(earlier.find(kBetween, at), end);
    if (count == log_sha256_.size())
      return "it was built from more logs; name all of them, in the same order";
    if (earlier.compare(at, next - at, log_sha256_[count]) != 0) {
      return escapedText(logs_[count].string()) + " is not its log number " + std::to_string(count + 1) +
             ", or it or the files it names have changed; name the same logs in the same order, and further "
             "ones behind them";
    }
    at = next + 1;
  }
  if (earlier.compare(end + 1, std::string::npos, reading_) == 0) return std::nullopt;
  return "its logs were read in another way (--poses, --pose-label, --up, --sensor, --start, --every)";
}

}  // namespace hoctomap
