// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/simulation/SimulatedRangeSensor.h"

#include "ForEachRow.h"

namespace hoctomap {

Rendering render(const SceneRaycaster& scene, const PinholeCamera& camera, const Pose& world_T_sensor,
                 int threads) {
  Rendering rendering;
  const auto pixels = static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  rendering.image = {camera, std::vector<float>(pixels, 0.0F)};
  rendering.solids.assign(pixels, kNoSolid);
  rendering.cos_incidence.assign(pixels, 0.0F);

  const Eigen::Isometry3d transform = toIsometry(world_T_sensor);
  const Eigen::Vector3d origin = transform.translation();
  forEachRow(camera.height, threads, [&](int v) {
    auto index = static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width);
    for (int u = 0; u < camera.width; ++u, ++index) {
      // A direction of depth 1: its multiple t is the depth along the optical axis.
      const Eigen::Vector3d direction = transform.linear() * camera.point(u, v, 1.0);
      const auto hit = scene.cast(origin, direction);
      if (!hit) continue;
      rendering.image.depth[index] = static_cast<float>(hit->t);
      rendering.solids[index] = static_cast<std::int32_t>(hit->solid.value);
      rendering.cos_incidence[index] = static_cast<float>(hit->cos_incidence);
    }
  });
  return rendering;
}

SimulatedRangeSensor::SimulatedRangeSensor(const RangeSensorModel& model, std::uint64_t seed, int threads)
    : model_(model), seed_(seed), threads_(threads) {
  check(model_);
}

SimulatedRangeSensor::Reading SimulatedRangeSensor::sense(const Scene& scene, const Pose& world_T_sensor,
                                                          std::uint64_t scan) {
  raycaster_.update(scene);
  Reading reading;
  reading.truth = render(raycaster_, model_.camera, world_T_sensor, threads_);
  reading.sensed = degrade(reading.truth, model_, seed_, scan, threads_);
  return reading;
}

}  // namespace hoctomap
