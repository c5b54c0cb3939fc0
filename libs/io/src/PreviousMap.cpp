// SPDX-License-Identifier: BSD-3-Clause
#include "PreviousMap.h"

#include <functional>
#include <set>
#include <string>
#include <system_error>

#include "MapNames.h"

namespace hoctomap {
namespace {

const std::string kPrefix = std::string(kPreviousFolder) + "/";

bool isAside(const std::string& path) {
  return path.starts_with(kPrefix);
}

void forEachFile(Manifest& manifest, const std::function<void(FileRecord&)>& visit) {
  for (FileRecord* file : {&manifest.config, &manifest.events, &manifest.existence}) visit(*file);
  if (manifest.events_before_end) visit(*manifest.events_before_end);
  if (manifest.scan_table) visit(*manifest.scan_table);
  if (manifest.seams) visit(*manifest.seams);
  if (manifest.index) visit(*manifest.index);
  if (manifest.scene) visit(*manifest.scene);
  for (auto* list : {&manifest.nodes, &manifest.removed, &manifest.waiting}) {
    for (NodeRecord& node : *list) {
      visit(node.ot);
      visit(node.bt);
    }
  }
}

std::string nameAside(const FileRecord& file) {
  return kPrefix + std::filesystem::path(file.path).filename().string();
}

/// Links the file to its new name and changes the record. A file that is missing already stays missing.
void rename(const Disk& disk, const std::filesystem::path& directory, FileRecord& file, std::string path) {
  if (std::filesystem::exists(directory / file.path)) disk.link(directory / file.path, directory / path);
  file.path = std::move(path);
}

void commitNames(const Disk& disk, const std::filesystem::path& directory, const Manifest& manifest) {
  for (const char* folder : {kNodesFolder, kPreviousFolder}) disk.syncDirectory(directory / folder);
  disk.syncDirectory(directory);
  disk.replace(directory / kManifestName, toYaml(manifest));
  disk.syncDirectory(directory);
}

}  // namespace

void setAside(const Disk& disk, const std::filesystem::path& directory, const Manifest& manifest) {
  Manifest aside = manifest;
  aside.index.reset();  // it knows the files by their old names
  disk.makeDirectory(directory / kNodesFolder);
  disk.makeDirectory(directory / kPreviousFolder);
  forEachFile(aside, [&](FileRecord& file) {
    if (!isAside(file.path)) rename(disk, directory, file, nameAside(file));
  });
  commitNames(disk, directory, aside);
}

Manifest setEventsAside(const Disk& disk, const std::filesystem::path& directory, Manifest manifest) {
  if (isAside(manifest.events.path)) return manifest;
  disk.makeDirectory(directory / kPreviousFolder);
  rename(disk, directory, manifest.events, nameAside(manifest.events));
  manifest.events_before_end.value().path = manifest.events.path;
  commitNames(disk, directory, manifest);
  return manifest;
}

Manifest bringBack(const Disk& disk, const std::filesystem::path& directory, Manifest manifest) {
  bool changed = false;
  forEachFile(manifest, [&](FileRecord& file) {
    if (!isAside(file.path)) return;
    changed = true;
    const std::string name = file.path.substr(kPrefix.size());
    rename(disk, directory, file,
           isNodeFileName(name) || isSeamsFileName(name) || isIndexFileName(name)
               ? std::string(kNodesFolder) + "/" + name
               : name);
  });
  if (changed) commitNames(disk, directory, manifest);
  return manifest;
}

void removePrevious(const Disk& disk, const std::filesystem::path& directory, const Manifest& manifest) {
  std::set<std::string> named;
  for (const FileRecord& file : manifest.files()) named.insert(file.path);
  const std::set<std::string> fixed{kConfigName, kEventsName, kExistenceName, kScansName, kSceneName};
  for (const std::string& name : listDirectory(directory / kPreviousFolder)) {
    const bool ours = fixed.contains(name) || isNodeFileName(name) || isSeamsFileName(name) ||
                      isIndexFileName(name) || isOurTemporary(name);
    const bool is_named = named.contains(kPrefix + name);
    if (ours && !is_named) disk.remove(directory / kPreviousFolder / name);
  }
  std::error_code not_empty;  // somebody else's file in it: stays
  std::filesystem::remove(directory / kPreviousFolder, not_empty);
}

}  // namespace hoctomap
