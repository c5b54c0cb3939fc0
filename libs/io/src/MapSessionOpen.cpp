// SPDX-License-Identifier: BSD-3-Clause
// How a map session begins: which directories it accepts, and what it takes over from the map in them.
#include <algorithm>
#include <sstream>
#include <system_error>

#include "MapFiles.h"
#include "MapNames.h"
#include "MapSession.h"
#include "NumberText.h"
#include "PreviousMap.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/Sha256.h"

namespace hoctomap {
namespace {

std::filesystem::path madeDirectory(const std::filesystem::path& directory) {
  std::error_code error;
  if (std::filesystem::exists(directory, error) && !std::filesystem::is_directory(directory, error)) {
    throw ConfigError(directory.string() + ": is no directory; the output of a map must be one");
  }
  const bool made = std::filesystem::create_directories(directory, error);
  if (error) throw FileError(directory.string() + ": cannot make the directory: " + error.message());
  if (made) {  // its name has to outlive a crash of the machine, too
    const auto parent = std::filesystem::absolute(directory / ".").parent_path().parent_path();
    Disk({}).syncDirectory(parent);
  }
  return directory;
}

/// The first line in which two INI texts differ, with its section.
std::string firstDifference(const std::string& stored, const std::string& given) {
  std::istringstream old_lines(stored);
  std::istringstream new_lines(given);
  std::string old_line;
  std::string new_line;
  std::string section;
  while (true) {
    const bool has_old = static_cast<bool>(std::getline(old_lines, old_line));
    const bool has_new = static_cast<bool>(std::getline(new_lines, new_line));
    if (!has_old && !has_new) return "";
    if (!has_old) old_line = "nothing";
    if (!has_new) new_line = "nothing";
    if (old_line != new_line) {
      return section + " has `" + escapedText(old_line, 200) + "` in the map, `" +
             escapedText(new_line, 200) + "` now";
    }
    if (new_line.starts_with('[')) section = escapedText(new_line, 200);
  }
}

bool isOurs(const std::string& name) {
  for (const char* ours : {kLockName, kManifestName, kConfigName, kEventsName, kExistenceName, kScansName,
                           kTimingName, kLogName, kSceneName, kNodesFolder, kPreviousFolder}) {
    if (name == ours) return true;
  }
  return isOurTemporary(name) || snapshotScan(name).has_value();
}

}  // namespace

MapDirectory::Session::Session(std::filesystem::path directory, MapDirectoryOptions options)
    : directory_(madeDirectory(directory)),
      options_(std::move(options)),
      disk_(options_.before_step),
      lock_(directory_),
      node_files_(disk_, directory_),
      events_(kEventsName, "scan,time,event,node,label,existence,detail"),
      existence_(kExistenceName, "scan,node,present,absent,occluded,p_measurement,p_posterior"),
      scans_(kScansName, "scan,time,sensor,points,x,y,z,yaw,pitch,roll,fov_x,fov_y,skipped"),
      timing_(kTimingName, "scan,points,read_s,segment_s,associate_s,update_s,existence_s,write_s") {
  requireNoLinks();
  if (options_.mode == MapOpenMode::create) {
    requireEmpty();
  } else if (options_.mode == MapOpenMode::overwrite) {
    lookAtOldMap();
  } else if (options_.mode == MapOpenMode::edit || std::filesystem::exists(directory_ / kManifestName)) {
    resume();
  } else {
    requireNothingForeign();
  }
}

/// What we write stays in the directory, whoever made it: its files are replaced or opened without following
/// links, save these.
void MapDirectory::Session::requireNoLinks() const {
  for (const char* name : {kNodesFolder, kPreviousFolder, kLogName}) {
    if (!std::filesystem::is_symlink(std::filesystem::symlink_status(directory_ / name))) continue;
    throw MapError((directory_ / name).string() + ": is a symbolic link; a map has none");
  }
}

void MapDirectory::Session::requireEmpty() const {
  for (const std::string& name : listDirectory(directory_)) {
    if (name == kLockName) continue;
    throw ConfigError(directory_.string() + ": is not empty (" + escapedText(name, 100) +
                      "); use --continue to go on with the map in it, --overwrite to replace it, or another "
                      "directory");
  }
}

/// A run that was killed before its first commit leaves some of our files and no map: it can be continued.
void MapDirectory::Session::requireNothingForeign() const {
  for (const std::string& name : listDirectory(directory_)) {
    if (isOurs(name)) continue;
    throw ConfigError(directory_.string() + ": holds no map but other files (" + escapedText(name, 100) +
                      "): nothing to continue");
  }
}

void MapDirectory::Session::resume() {
  Manifest manifest = readManifest(directory_);
  const bool edits = options_.mode == MapOpenMode::edit;
  if (!edits) checkSameConfig(manifest);
  manifest = bringBack(disk_, directory_, std::move(manifest));
  if (edits) options_.config = readChecked(directory_, manifest.config, false);
  if (manifest.events_before_end && !edits) {
    events_.resumeAnew(directory_, *manifest.events_before_end);
  } else {
    events_.resume(directory_, manifest.events);
  }
  existence_.resume(directory_, manifest.existence);
  if (manifest.scan_table) scans_.resume(directory_, *manifest.scan_table);
  timing_.resume(directory_, [&](std::string_view scan) {
    const auto number = parseCount(scan);
    return !number || *number < manifest.scans;  // the header row, and scans that need not be repeated
  });
  for (const auto* nodes : {&manifest.nodes, &manifest.removed, &manifest.waiting}) {
    for (const NodeRecord& node : *nodes) node_files_.know(node);
  }
  removed_before_ = manifest.removed;
  for (const std::uint64_t scan : snapshotScans(directory_)) {
    if (scan >= manifest.scans) continue;
    const auto file = directory_ / snapshotName(scan);
    for (const FileRecord& kept : readManifestFile(file).files()) {
      kept_files_.insert(kept.path);
    }
  }
  committed_ = std::move(manifest);
  removeLeftovers();
}

void MapDirectory::Session::checkSameConfig(const Manifest& manifest) const {
  if (sha256Hex(options_.config) == manifest.config_sha256) return;
  const auto stored = directory_ / manifest.config.path;
  const std::string difference = std::filesystem::exists(stored)
                                     ? firstDifference(readWholeFile(stored), options_.config)
                                     : std::string();
  throw ConfigError(directory_.string() + ": the configuration is not that of the map being continued" +
                    (difference.empty() ? "" : ": " + difference) + "; use -c " + stored.string());
}

/// The map to be overwritten is to survive until the first commit, if it is one at all.
void MapDirectory::Session::lookAtOldMap() {
  overwriting_ = true;
  if (!std::filesystem::exists(directory_ / kManifestName)) return;
  try {
    old_ = readManifest(directory_);
  } catch (const MapError&) {
    return;
  } catch (const LimitError&) {
    return;
  }
}

/// What a killed session has left behind. A kept state of a commit that was not finished goes, too: the rows
/// of the tables that it needs are about to be overwritten.
void MapDirectory::Session::removeLeftovers() {
  for (const std::uint64_t scan : snapshotScans(directory_)) {
    if (scan < committed_->scans) continue;
    disk_.remove(directory_ / snapshotName(scan));
    disk_.syncDirectory(directory_);
  }
  removePrevious(disk_, directory_, *committed_);
  removeUnnamedFiles();
}

}  // namespace hoctomap
