// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <system_error>

#include "FileText.h"
#include "Page.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/report/Report.h"

namespace hoctomap {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxBytes = 64'000'000;  ///< of all tables and pictures

std::vector<std::filesystem::path> filesOf(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  if (error) throw FileError(folder.string() + ": cannot be read: " + error.message());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::string experimentsReport(const std::vector<std::filesystem::path>& folders) {
  Page page("Experiments - hoctomap");
  Json chapters = Json::array();
  std::size_t bytes = 0;
  for (const auto& folder : folders) {
    Json tables = Json::object();
    Json pictures = Json::array();
    for (const auto& file : filesOf(folder)) {
      const std::string extension = file.extension().string();
      if (extension != ".csv" && extension != ".png") continue;
      const std::string text = fileText(file);
      bytes += text.size();
      if (bytes > kMaxBytes) throw LimitError("the tables and pictures of the experiments exceed 64 MB");
      if (extension == ".csv") {
        tables[file.filename().string()] = text;
      } else {
        const std::string block =
            "picture" + std::to_string(chapters.size()) + "-" + std::to_string(pictures.size());
        page.add(block, std::string_view(text));
        pictures.push_back({{"name", file.filename().string()}, {"block", block}});
      }
    }
    if (tables.empty()) throw InputError(folder.string() + ": holds no table (.csv) of an experiment");
    chapters.push_back({{"folder", folder.string()}, {"tables", tables}, {"pictures", pictures}});
  }
  page.addJson("page", Json{{"kind", "experiments"}, {"name", "Experiments"}, {"chapters", chapters}});
  return std::move(page).html();
}

}  // namespace hoctomap
