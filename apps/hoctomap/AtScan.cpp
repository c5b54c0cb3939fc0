// SPDX-License-Identifier: BSD-3-Clause
#include "AtScan.h"

#include <iostream>

#include "hoctomap/io/EscapedText.h"

namespace hoctomap {

void addAtScan(CLI::App& command, AtScan& at_scan, const std::string& name, const std::string& what) {
  command.add_option(name, at_scan, what)->type_name("K");
}

void noteOlderState(const std::string& map, std::uint64_t scans, const AtScan& at_scan) {
  if (!at_scan || scans > *at_scan) return;
  const std::string state = scans == 0 ? "before the first scan" : "after scan " + std::to_string(scans - 1);
  std::cerr << "hoctomap: " << escapedText(map) << ": the newest state up to scan " << *at_scan << " is that "
            << state << std::endl;
}

Manifest readManifestAt(const std::string& map, const AtScan& at_scan) {
  Manifest manifest = readManifest(map, at_scan);
  noteOlderState(map, manifest.scans, at_scan);
  return manifest;
}

StoredMap readMapAt(const std::string& map, const AtScan& at_scan) {
  StoredMap stored = readMap(map, {.at_scan = at_scan});
  noteOlderState(map, stored.manifest.scans, at_scan);
  return stored;
}

}  // namespace hoctomap
