// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "Score.h"
#include "SimulatedScenes.h"
#include "hoctomap/geometry/Measurement.h"
#include "hoctomap/mapping/Segmentation.h"

namespace hoctomap {

/// A folder with `scene.rawlog` and `label.png`.
struct LabelledScene {
  std::string name;      ///< of the folder
  std::string category;  ///< of `scenes.json` beside the folders; empty without one
  std::filesystem::path folder;
};

/// The labelled scenes below a folder, by name. @throws InputError if there is none, or `scenes.json` is
/// broken.
[[nodiscard]] std::vector<LabelledScene> labelledScenes(const std::filesystem::path& root);

/// How well a scene was segmented, and what that cost.
struct SceneResult {
  LabelledScene scene;
  SegmentationScore score;
  double user_ms = 0.0;  ///< time of the processor for planes and objects together
};

/// Segments the first scan of a scene; `keep` gets the label image.
[[nodiscard]] SceneResult segmentScene(const LabelledScene& scene, const Segmentation& segmentation,
                                       const std::function<void(const GreyImage&)>& keep);

/// The same for one view and its truth.
[[nodiscard]] SceneResult segmentView(const LabelledScene& scene, const SimulatedView& view,
                                      const Segmentation& segmentation,
                                      const std::function<void(const GreyImage&)>& keep);

/// Means by category and of all, as a table of Markdown.
[[nodiscard]] std::string categoryTable(const std::vector<SceneResult>& results);

/// Reads a grey PNG of 8 bits. @throws InputError
[[nodiscard]] GreyImage readGreyPng(const std::filesystem::path& file);

}  // namespace hoctomap
