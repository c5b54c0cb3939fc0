// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/MapTables.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>

#include "Disk.h"
#include "MapFiles.h"
#include "MapNames.h"
#include "NumberText.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/mapping/UpdateReport.h"

namespace hoctomap {
namespace {

using Row = std::vector<std::string>;

/// Takes a row off the text (RFC 4180): quoted fields may hold commas, quotes and line ends.
Row takeRow(std::string_view& text) {
  Row fields(1);
  bool quoted = false;
  std::size_t i = 0;
  for (; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      const bool doubled = c == '"' && i + 1 < text.size() && text[i + 1] == '"';
      if (doubled) ++i;
      if (c != '"' || doubled) {
        fields.back() += c;
      } else {
        quoted = false;
      }
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      fields.emplace_back();
    } else if (c == '\n') {
      ++i;
      break;
    } else {
      fields.back() += c;
    }
  }
  text.remove_prefix(i);
  return fields;
}

/// The columns of one table, found by name: later versions may add some.
class Table {
 public:
  Table(const std::filesystem::path& directory, const FileRecord& record)
      : Table(directory / record.path, readChecked(directory, record, true)) {}
  Table(const std::filesystem::path& file, std::string text) : file_(file.string()), text_(std::move(text)) {
    rest_ = text_;
    names_ = takeRow(rest_);
  }

  bool next() {
    if (rest_.empty()) return false;
    ++row_;
    fields_ = takeRow(rest_);
    if (fields_.size() != names_.size()) refuse("has another number of fields than the first row");
    return true;
  }

  [[nodiscard]] const std::string& text(const std::string& name) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) refuse("has no column `" + name + "`");
    return fields_[static_cast<std::size_t>(found - names_.begin())];
  }
  [[nodiscard]] std::uint64_t count(const std::string& name) const {
    const auto value = parseCount(text(name));
    if (!value) refuse("`" + name + "` is no whole number: " + escapedText(text(name), 60));
    return *value;
  }
  [[nodiscard]] double number(const std::string& name) const {
    const auto value = parseNumber(text(name));
    if (!value) refuse("`" + name + "` is no number: " + escapedText(text(name), 60));
    return *value;
  }
  [[nodiscard]] std::optional<double> numberIfAny(const std::string& name) const {
    return text(name).empty() ? std::nullopt : std::optional(number(name));
  }
  [[nodiscard]] NodeId node() const {
    const std::uint64_t id = count("node");
    if (id > std::numeric_limits<std::uint32_t>::max()) refuse("`node` is no id of a node");
    return NodeId{static_cast<std::uint32_t>(id)};
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw MapError(file_ + (row_ == 0 ? "" : ": row " + std::to_string(row_ + 1)) + ": " + what);
  }

  std::string file_;
  std::string text_;
  std::string_view rest_;
  Row names_;
  Row fields_;
  std::size_t row_ = 0;
};

}  // namespace

std::vector<EventRow> readEvents(const std::filesystem::path& directory, const Manifest& manifest) {
  Table table(directory, manifest.events);
  std::vector<EventRow> rows;
  while (table.next()) {
    rows.push_back({table.count("scan"), table.number("time"), table.text("event"), table.node(),
                    Label{table.text("label")}, table.number("existence"), table.text("detail")});
  }
  for (const NodeId id : manifest.let_in_at_end) {
    const NodeRecord& node = *manifest.find(id);
    rows.push_back({manifest.scans - 1, manifest.last_stamp, toString(NodeEventKind::created), id, node.label,
                    node.existence,
                    createdDetail(node.confirmation.points, node.first_scan, node.parent.value_or(kRootId))});
  }
  return rows;
}

std::vector<ExistenceRow> readExistence(const std::filesystem::path& directory, const Manifest& manifest) {
  Table table(directory, manifest.existence);
  std::vector<ExistenceRow> rows;
  while (table.next()) {
    rows.push_back({table.count("scan"), table.node(), table.count("present"), table.count("absent"),
                    table.count("occluded"), table.number("p_measurement"), table.number("p_posterior")});
  }
  return rows;
}

std::vector<ScanTableRow> readScans(const std::filesystem::path& directory, const Manifest& manifest) {
  std::vector<ScanTableRow> rows;
  if (!manifest.scan_table) return rows;
  Table table(directory, *manifest.scan_table);
  constexpr double kRadians = std::numbers::pi / 180.0;
  while (table.next()) {
    ScanTableRow row{table.count("scan"),        table.number("time"), table.text("sensor"),
                     table.count("points"),      std::nullopt,         table.numberIfAny("fov_x"),
                     table.numberIfAny("fov_y"), table.text("skipped")};
    if (table.numberIfAny("x")) {
      row.world_T_sensor =
          Pose(table.number("x"), table.number("y"), table.number("z"), kRadians * table.number("yaw"),
               kRadians * table.number("pitch"), kRadians * table.number("roll"));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<TimingTableRow> readTiming(const std::filesystem::path& directory, const Manifest& manifest) {
  std::vector<TimingTableRow> rows;
  const auto file = directory / kTimingName;
  if (!std::filesystem::exists(file)) return rows;
  Table table(file, readWholeFile(file));
  while (table.next()) {
    const TimingTableRow row{table.count("scan"),         table.count("points"),
                             table.number("read_s"),      table.number("segment_s"),
                             table.number("associate_s"), table.number("update_s"),
                             table.number("existence_s"), table.number("write_s")};
    if (row.scan < manifest.scans) rows.push_back(row);
  }
  return rows;
}

}  // namespace hoctomap
