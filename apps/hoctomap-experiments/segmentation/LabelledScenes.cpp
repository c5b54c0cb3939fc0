// SPDX-License-Identifier: BSD-3-Clause
#include "LabelledScenes.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/tabletop/LabelImage.h"
#include "measuring/Scans.h"
#include "measuring/Stopwatch.h"
#include "segmentation/SimulatedScenes.h"

namespace hoctomap {
namespace {

/// Category by name of the folder.
std::map<std::string, std::string> categoriesOf(const std::filesystem::path& root) {
  std::map<std::string, std::string> categories;
  std::ifstream in(root / "scenes.json");
  if (!in) return categories;
  try {
    for (const auto& entry : nlohmann::json::parse(in)) {
      char name[16];
      std::snprintf(name, sizeof name, "%06d", entry.at("index").get<int>());
      categories[name] = entry.at("category").get<std::string>();
    }
  } catch (const nlohmann::json::exception& e) {
    throw InputError((root / "scenes.json").string() + ": " + e.what());
  }
  return categories;
}

std::string row(const std::string& name, const std::vector<const SceneResult*>& results) {
  SegmentationScore sum;
  double ms = 0.0;
  for (const auto* r : results) {
    sum += r->score;
    ms += r->user_ms;
  }
  const auto n = static_cast<double>(results.size());
  char text[200];
  std::snprintf(text, sizeof text, "| %s | %zu | %.3f | %.3f | %.3f | %.3f | %.1f of %.1f | %.1f |\n",
                name.c_str(), results.size(), sum.precision / n, sum.recall / n, sum.f / n, sum.share75 / n,
                sum.found / n, sum.objects / n, ms / n);
  return text;
}

}  // namespace

std::vector<LabelledScene> labelledScenes(const std::filesystem::path& root) {
  std::error_code error;
  std::vector<LabelledScene> scenes;
  const auto categories = categoriesOf(root);
  for (const auto& entry : std::filesystem::directory_iterator(root, error)) {
    const auto& folder = entry.path();
    if (!std::filesystem::exists(folder / "scene.rawlog") || !std::filesystem::exists(folder / "label.png")) {
      continue;
    }
    const std::string name = folder.filename().string();
    const auto category = categories.find(name);
    scenes.push_back({name, category == categories.end() ? std::string() : category->second, folder});
  }
  if (scenes.empty()) throw InputError(root.string() + ": no folder with scene.rawlog and label.png");
  std::sort(scenes.begin(), scenes.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return scenes;
}

SceneResult segmentScene(const LabelledScene& scene, const Segmentation& segmentation,
                         const std::function<void(const GreyImage&)>& keep) {
  ScanChoice choice;
  choice.log = scene.folder / "scene.rawlog";
  choice.max_scans = 1;
  const auto scans = readScans(choice);
  const Measurement& z = scans.front();
  if (!z.image) throw InputError(choice.log.string() + ": no depth image");
  const GreyImage truth = readGreyPng(scene.folder / "label.png");
  if (truth.width != z.image->camera.width || truth.height != z.image->camera.height) {
    throw InputError((scene.folder / "label.png").string() + ": not of the size of the range image");
  }
  return segmentView(scene, {z, truth}, segmentation, keep);
}

SceneResult segmentView(const LabelledScene& scene, const SimulatedView& view,
                        const Segmentation& segmentation, const std::function<void(const GreyImage&)>& keep) {
  const Stopwatch watch;
  const auto segments = segmentation.segment(view.z);
  const double user_ms = 1e3 * watch.elapsed().user_s;
  const GreyImage found{view.truth.width, view.truth.height, labelImage(view.z, segments)};
  keep(found);
  return {scene, scoreSegmentation(found, joinedTruth(view.truth)), user_ms};
}

std::string categoryTable(const std::vector<SceneResult>& results) {
  std::string text =
      "| category | scenes | P | R | F | F >= 0.75 | objects | CPU [ms] "
      "|\n|---|---|---|---|---|---|---|---|\n";
  std::map<std::string, std::vector<const SceneResult*>> by_category;
  std::vector<const SceneResult*> all;
  for (const auto& r : results) {
    all.push_back(&r);
    if (!r.scene.category.empty()) by_category[r.scene.category].push_back(&r);
  }
  for (const auto& [category, of_category] : by_category) text += row(category, of_category);
  return text + row("all", all);
}

}  // namespace hoctomap
