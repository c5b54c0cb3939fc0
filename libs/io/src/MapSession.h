// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "CsvTable.h"
#include "DirectoryLock.h"
#include "Disk.h"
#include "NodeFiles.h"
#include "hoctomap/io/MapDirectory.h"

namespace hoctomap {

/// What stands behind a MapDirectory.
class MapDirectory::Session {
 public:
  Session(std::filesystem::path directory, MapDirectoryOptions options);

  void addRows(const UpdateReport& report);
  void addEnd(const UpdateReport& report);
  void addRow(const ScanRow& row);
  void addRow(const TimingRow& row);
  void commit(const MapState& state);
  void writeScene(const SceneMaker& maker);

  [[nodiscard]] const std::optional<Manifest>& committed() const { return committed_; }

 private:
  // Opening.
  void requireNoLinks() const;
  void requireEmpty() const;
  void requireNothingForeign() const;
  void resume();
  void checkSameConfig(const Manifest& manifest) const;
  void lookAtOldMap();
  void removeLeftovers();

  // Committing.
  void makeWay();
  [[nodiscard]] std::optional<FileRecord> writeSeams(const MapState& state, std::uint64_t edits);
  [[nodiscard]] FileRecord writeIndex(const MapState& state, const Manifest& manifest,
                                      const std::string& nodes_text);
  [[nodiscard]] std::uint64_t editsBefore() const { return committed_ ? committed_->edits : 0; }
  void writeNodes(const MapState& state);
  [[nodiscard]] Manifest describe(const MapState& state);
  void commitManifest(const Manifest& manifest, const std::string& nodes_text, bool keep);
  void removeUnnamedFiles();

  std::filesystem::path directory_;
  MapDirectoryOptions options_;
  Disk disk_;
  DirectoryLock lock_;
  NodeFiles node_files_;
  CsvTable events_;
  CsvTable existence_;
  CsvTable scans_;
  CsvTable timing_;
  std::optional<Manifest> committed_;
  bool overwriting_ = false;     ///< until the first commit
  std::optional<Manifest> old_;  ///< the map that is overwritten, if it is one
  bool config_written_ = false;
  std::optional<FileRecord> events_before_end_;
  std::vector<NodeRecord> removed_before_;  ///< by earlier sessions
  std::set<std::string> kept_files_;        ///< that kept manifests name
};

}  // namespace hoctomap
