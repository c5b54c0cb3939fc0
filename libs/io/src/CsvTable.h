// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "Disk.h"
#include "hoctomap/io/Manifest.h"
#include "hoctomap/io/Sha256.h"

namespace hoctomap {

/// A CSV file that grows with the commits of a map. The manifest vouches for its first bytes only, so rows
/// that a killed session wrote beyond them are no part of any map; they are overwritten.
class CsvTable {
 public:
  /// A new table; replaces the file at its first commit.
  CsvTable(std::string name, std::string_view header);

  /// Goes on with the part of the file that `record` vouches for. What follows it is no part of the map.
  /// @throws MapError if that part is damaged.
  void resume(const std::filesystem::path& directory, const FileRecord& record);

  /// The same if rows that follow are part of the map: the file is left as it is, and replaced at the first
  /// commit.
  void resumeAnew(const std::filesystem::path& directory, const FileRecord& record);

  /// Goes on with those rows of the file for which `keep(first field)`; for files no manifest vouches for.
  void resume(const std::filesystem::path& directory, const std::function<bool(std::string_view)>& keep);

  /// Whether the next commit replaces the file: what a map needs of it has to be elsewhere by then.
  [[nodiscard]] bool replaces() const { return fresh_; }

  /// Adds a row, given without its line end.
  void add(const std::string& row) { pending_ += row + '\n'; }

  /// The table as it is now, pending rows included.
  [[nodiscard]] FileRecord record() const;

  /// Writes the pending rows. May be repeated until `accept()`.
  [[nodiscard]] FileRecord write(const Disk& disk, const std::filesystem::path& directory) const;
  /// What `write` wrote belongs to the map now.
  void accept();

 private:
  std::string name_;
  std::string pending_;
  std::uint64_t accepted_bytes_ = 0;
  bool fresh_ = true;  ///< the file on disk is not ours yet
  Sha256 accepted_hash_;
};

}  // namespace hoctomap
