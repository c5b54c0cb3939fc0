// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/report/Report.h"

#include "MapPart.h"

namespace hoctomap {

namespace {

using Json = nlohmann::ordered_json;

std::string nameOf(const std::filesystem::path& directory) {
  const auto normal = std::filesystem::absolute(directory).lexically_normal();
  return (normal.has_filename() ? normal : normal.parent_path()).filename().string();
}

}  // namespace

std::string mapReport(const std::filesystem::path& directory, std::optional<std::uint64_t> at_scan) {
  Page page(nameOf(directory) + " - hoctomap");
  Json map = addMap(page, directory, at_scan, "a");
  page.addJson("page",
               Json{{"kind", "map"}, {"name", nameOf(directory)}, {"maps", Json::array({std::move(map)})}});
  return std::move(page).html();
}

std::string comparisonReport(const ReportedMap& a, const ReportedMap& b, const std::string& diff_json) {
  const std::string name = nameOf(a.directory) + " and " + nameOf(b.directory);
  Page page(name + " - hoctomap");
  Json maps = Json::array();
  maps.push_back(addMap(page, a.directory, a.at_scan, "a"));
  maps.push_back(addMap(page, b.directory, b.at_scan, "b"));
  page.addJson(
      "page",
      Json{{"kind", "compare"}, {"name", name}, {"maps", std::move(maps)}, {"diff", Json::parse(diff_json)}});
  return std::move(page).html();
}

}  // namespace hoctomap
