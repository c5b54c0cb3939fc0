// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "hoctomap/geometry/Measurement.h"
#include "hoctomap/hierarchy/MapHierarchy.h"
#include "hoctomap/io/Manifest.h"
#include "hoctomap/mapping/SeamVotes.h"
#include "hoctomap/mapping/UpdateReport.h"

namespace hoctomap {

enum class MapOpenMode {
  create,     ///< the directory must be missing or empty
  resume,     ///< go on with the map in it (`--continue`); a missing or empty directory starts a new one
  edit,       ///< change the map in it by hand (`hoctomap edit`): its own configuration holds, and what the
              ///< end of the log has let in is in it for good
  overwrite,  ///< start a new map; the old one stays whole until the first commit (`--overwrite`)
};

struct MapDirectoryOptions {
  MapOpenMode mode = MapOpenMode::create;
  std::string config{};   ///< text of `config.ini`; not needed to edit
  std::string generator;  ///< program and version
  /// Called before every step that changes the disk, with a word for it and the file: tests let it throw.
  std::function<void(std::string_view step, const std::filesystem::path& file)> before_step;
};

/// What a commit writes down. In mode `edit` each commit is one edit (Manifest::edits).
struct MapState {
  const MapHierarchy& hierarchy;
  std::span<const RemovedNode> removed;  ///< by this session: `HierarchyMapper::removed()`
  std::uint64_t scans = 0;               ///< scans of the log taken in, skipped ones included
  std::string input{};                   ///< see Manifest::input
  bool keep = false;                     ///< keep this state for good, as `hierarchy-NNNNNN.yaml` (last scan)
  double last_stamp = 0.0;               ///< of the last scan, s since 1970
  const SeamVotes* seams = nullptr;      ///< `HierarchyMapper::seams()`
  std::optional<StillSensor> sensor{};   ///< `HierarchyMapper::sensor()`
  std::optional<MotionsTaken> motions{};
  std::uint64_t mapped_scans = 0;   ///< see Manifest
  std::uint64_t skipped_scans = 0;  ///< see Manifest
};

/// One row of `scans.csv`: where a scan was taken from, or why it is not in the map.
struct ScanRow {
  std::uint64_t scan = 0;
  double stamp = 0.0;  ///< s since 1970
  std::string sensor{};
  std::size_t points = 0;
  std::optional<Pose> world_T_sensor{};  ///< x forward, y left, z up; none if the scan was skipped
  std::optional<double> fov_x{};         ///< radians, of a depth camera
  std::optional<double> fov_y{};
  std::string skipped{};  ///< why; empty if it was mapped
};

/// The row of a scan that is mapped.
[[nodiscard]] ScanRow scanRow(const Measurement& z);

/// One row of `timing.csv`: the scan's wall seconds.
struct TimingRow {
  std::uint64_t scan = 0;
  std::size_t points = 0;
  double read_s = 0.0;
  StageSeconds stages;
  double write_s = 0.0;
};

/// A writing session over a map directory (docs/map-format.md).
///
/// Usage: construct; per scan `append(report)`, `append(timing)`; from time to time and at the end
/// `commit(state)`; at the end `writeScene(maker)`.
///
/// Guarantees:
///  1. at every moment the directory holds one whole map, the previous or the new one, whatever write fails
///     and whenever the process is killed: the commit point is the rename of `hierarchy.yaml`;
///  2. rows appended belong to the map from the next commit on;
///  3. one writer at a time (a lock file with the holder's pid, let go when the object or the process ends);
///  4. files that are not ours are never touched; what a killed session left behind is removed;
///  5. same calls, same bytes in all files but `timing.csv`.
class MapDirectory {
 public:
  /// @throws ConfigError if the directory is not fit for the mode, or `config` differs from that of the map
  ///         being continued; FileError if another process writes to it, or it cannot be made or locked;
  ///         MapError if the map to be continued is damaged.
  MapDirectory(std::filesystem::path directory, MapDirectoryOptions options);
  ~MapDirectory();
  MapDirectory(const MapDirectory&) = delete;
  MapDirectory& operator=(const MapDirectory&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return directory_; }
  /// Where the program's log goes.
  [[nodiscard]] std::filesystem::path logFile() const { return directory_ / "log.txt"; }

  /// The last committed state; nothing before the first commit of a new map. Right after construction in mode
  /// `resume` this is the map to go on with: read it with `readMap`, begin at scan `scans`.
  [[nodiscard]] const std::optional<Manifest>& committed() const;

  /// Rows of `events.csv` and `existence.csv`.
  void append(const UpdateReport& report);
  /// Rows of `events.csv` that stem from the end of the log: a run that goes on with a longer one drops them.
  void appendEnd(const UpdateReport& report);
  void append(const ScanRow& row);
  void append(const TimingRow& row);

  /// Makes `state` the map of the directory.
  /// @throws FileError if something cannot be written; the previous map is then still whole and the session
  ///         can go on.
  void commit(const MapState& state);

  /// Makes `hierarchy.3Dscene` from the last commit. `maker(directory, file)` reads the map in `directory`
  /// and writes `file`. A later commit without this drops the scene, which would be out of date.
  /// @throws what `maker` throws; the map is whole all the same.
  using SceneMaker =
      std::function<void(const std::filesystem::path& directory, const std::filesystem::path& file)>;
  void writeScene(const SceneMaker& maker);

 private:
  class Session;
  std::filesystem::path directory_;
  std::unique_ptr<Session> session_;
};

}  // namespace hoctomap
