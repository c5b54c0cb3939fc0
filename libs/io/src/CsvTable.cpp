// SPDX-License-Identifier: BSD-3-Clause
#include "CsvTable.h"

#include <utility>

#include "MapFiles.h"

namespace hoctomap {

CsvTable::CsvTable(std::string name, std::string_view header) : name_(std::move(name)) {
  add(std::string(header));
}

void CsvTable::resume(const std::filesystem::path& directory, const FileRecord& record) {
  accepted_hash_ = Sha256();
  accepted_hash_.add(readChecked(directory, {name_, record.bytes, record.sha256}, true));
  accepted_bytes_ = record.bytes;
  pending_.clear();
  fresh_ = false;
}

void CsvTable::resumeAnew(const std::filesystem::path& directory, const FileRecord& record) {
  pending_ = readChecked(directory, {name_, record.bytes, record.sha256}, true);
}

void CsvTable::resume(const std::filesystem::path& directory,
                      const std::function<bool(std::string_view)>& keep) {
  if (!std::filesystem::exists(directory / name_)) return;
  const std::string bytes = readWholeFile(directory / name_);
  pending_.clear();
  std::string_view rest = bytes;
  for (auto end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n')) {
    const std::string_view row = rest.substr(0, end);
    if (keep(row.substr(0, row.find(',')))) add(std::string(row));
    rest.remove_prefix(end + 1);
  }
}

FileRecord CsvTable::record() const {
  Sha256 hash = accepted_hash_.copy();
  hash.add(pending_);
  return {name_, accepted_bytes_ + pending_.size(), hash.hex()};
}

FileRecord CsvTable::write(const Disk& disk, const std::filesystem::path& directory) const {
  if (fresh_) {
    disk.replace(directory / name_, pending_);
    return record();
  }
  // Also without pending rows: what a failed commit has left there goes.
  const auto bytes = std::filesystem::file_size(directory / name_);
  if (bytes != accepted_bytes_ || !pending_.empty()) {
    disk.extend(directory / name_, accepted_bytes_, pending_);
  }
  return record();
}

void CsvTable::accept() {
  accepted_hash_.add(pending_);
  accepted_bytes_ += pending_.size();
  pending_.clear();
  fresh_ = false;
}

}  // namespace hoctomap
