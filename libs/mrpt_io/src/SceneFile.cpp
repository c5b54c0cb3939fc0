// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/mrpt_io/SceneFile.h"

#include <mrpt/serialization/CArchive.h>

#include "GzFileOutput.h"
#include "SceneBuilder.h"

namespace hoctomap {

void writeSceneFile(const MapHierarchy& hierarchy, const std::filesystem::path& file) {
  mrpt::opengl::COpenGLScene scene;
  scene.insert(sceneOf(hierarchy, {}));
  scene.getViewport()->setCustomBackgroundColor({1.0F, 1.0F, 1.0F});
  scene.getViewport()->lightParameters().ambient = {0.6F, 0.6F, 0.6F, 1.0F};
  scene.getViewport()->lightParameters().diffuse = {0.5F, 0.5F, 0.5F, 1.0F};
  // Checked, unlike COpenGLScene::saveToFile. A run waits for its scene.
  GzFileOutput out(file, Z_BEST_SPEED);
  auto archive = mrpt::serialization::archiveFrom(out);
  archive << scene;
  out.commit();
}

}  // namespace hoctomap
