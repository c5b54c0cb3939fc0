// SPDX-License-Identifier: BSD-3-Clause
#include "MapNames.h"

#include <algorithm>
#include <system_error>

#include "NumberText.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

constexpr std::size_t kDigits = 6;  // larger numbers take more
constexpr std::string_view kSnapshotBegin = "hierarchy-";
constexpr std::string_view kSnapshotEnd = ".yaml";
constexpr std::string_view kIndexBegin = "index-";
constexpr std::string_view kIndexEnd = ".bin";
constexpr std::size_t kIndexDigits = 12;

bool isPaddedNumber(std::string_view text) {
  return text.size() >= kDigits && (text.size() == kDigits || text.front() != '0') && parseCount(text);
}

/// What stands between a beginning and an end that do not overlap.
std::optional<std::string_view> between(std::string_view begin, std::string_view text, std::string_view end) {
  if (!text.starts_with(begin)) return std::nullopt;
  text.remove_prefix(begin.size());
  if (!text.ends_with(end)) return std::nullopt;
  text.remove_suffix(end.size());
  return text;
}

std::string editSuffix(std::uint64_t edit) {
  return edit == 0 ? std::string() : "-" + std::to_string(edit);
}

/// `VVVVVV` or `VVVVVV-E`.
bool isVersion(std::string_view text) {
  const auto dash = text.find('-');
  if (dash == std::string_view::npos) return isPaddedNumber(text);
  const std::string_view edit = text.substr(dash + 1);
  return isPaddedNumber(text.substr(0, dash)) && !edit.starts_with('0') && parseCount(edit);
}

}  // namespace

std::string nodeFileStem(NodeId id, std::uint64_t version, std::uint64_t edition) {
  return padded(id.value, kDigits) + "-" + padded(version, kDigits) + editSuffix(edition);
}

bool isNodeFileName(const std::string& name) {
  const std::string_view text = name;
  const auto dash = text.find('-');
  if (dash == std::string_view::npos || !(text.ends_with(".ot") || text.ends_with(".bt"))) return false;
  return isPaddedNumber(text.substr(0, dash)) && isVersion(text.substr(dash + 1, text.size() - dash - 4));
}

std::string seamsFileName(std::uint64_t scans, std::uint64_t edits) {
  return "seams-" + padded(scans, kDigits) + editSuffix(edits) + ".csv";
}

bool isSeamsFileName(const std::string& name) {
  const auto version = between("seams-", name, ".csv");
  return version && isVersion(*version);
}

std::string indexFileName(const std::string& sha256) {
  return std::string(kIndexBegin) + sha256.substr(0, kIndexDigits) + std::string(kIndexEnd);
}

bool isIndexFileName(const std::string& name) {
  const auto digits = between(kIndexBegin, name, kIndexEnd);
  return digits && digits->size() == kIndexDigits &&
         digits->find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

std::string snapshotName(std::uint64_t scan) {
  return std::string(kSnapshotBegin) + padded(scan, kDigits) + std::string(kSnapshotEnd);
}

std::optional<std::uint64_t> snapshotScan(const std::string& name) {
  const auto number = between(kSnapshotBegin, name, kSnapshotEnd);
  return number && isPaddedNumber(*number) ? parseCount(*number) : std::nullopt;
}

std::vector<std::uint64_t> snapshotScans(const std::filesystem::path& directory) {
  std::vector<std::uint64_t> scans;
  for (const std::string& name : listDirectory(directory)) {
    if (const auto scan = snapshotScan(name)) scans.push_back(*scan);
  }
  std::sort(scans.begin(), scans.end());
  return scans;
}

std::vector<std::string> listDirectory(const std::filesystem::path& directory) {
  std::vector<std::string> names;
  try {
    if (!std::filesystem::exists(directory)) return names;
    for (const auto& entry : std::filesystem::directory_iterator(directory)) {
      names.push_back(entry.path().filename().string());
    }
  } catch (const std::filesystem::filesystem_error& error) {
    throw FileError(directory.string() + ": cannot list the directory: " + error.code().message());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace hoctomap
