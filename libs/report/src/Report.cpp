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

std::string comparisonReport(const std::filesystem::path& a, const std::filesystem::path& b,
                             const std::string& diff_json) {
  Page page(nameOf(a) + " and " + nameOf(b) + " - hoctomap");
  Json maps = Json::array();
  maps.push_back(addMap(page, a, std::nullopt, "a"));
  maps.push_back(addMap(page, b, std::nullopt, "b"));
  page.addJson("page", Json{{"kind", "compare"},
                            {"name", nameOf(a) + " and " + nameOf(b)},
                            {"maps", std::move(maps)},
                            {"diff", Json::parse(diff_json)}});
  return std::move(page).html();
}

}  // namespace hoctomap
