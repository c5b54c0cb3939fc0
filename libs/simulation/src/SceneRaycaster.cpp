// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/simulation/SceneRaycaster.h"

#include <embree3/rtcore.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

struct Release {
  void operator()(RTCDevice d) const { rtcReleaseDevice(d); }
  void operator()(RTCScene s) const { rtcReleaseScene(s); }
  void operator()(RTCGeometry g) const { rtcReleaseGeometry(g); }
};
using Device = std::unique_ptr<RTCDeviceTy, Release>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, Release>;
using EmbreeGeometry = std::unique_ptr<RTCGeometryTy, Release>;

void check(RTCDevice device, const char* what) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE)
    throw LimitError(std::string("ray casting: ") + what + " failed (Embree error " + std::to_string(error) +
                     ")");
}

// On one thread: the order of triangles in the tree, and with it which of two equally near ones is hit, must
// not depend on the number of threads. (rtcJoinCommitScene would go over to Embree's own arena, with all
// threads.)
void commit(RTCScene scene) {
  tbb::task_arena(1).execute([scene] { rtcCommitScene(scene); });
}

Device makeDevice() {
  // The oldest instruction set of the architecture: the same triangle is hit on every machine.
  Device device(rtcNewDevice("isa=sse2"));
  if (!device) throw LimitError("ray casting: Embree does not start");
  return device;
}

EmbreeScene makeScene(RTCDevice device) {
  EmbreeScene scene(rtcNewScene(device));
  check(device, "a new scene");
  // Without it, rays slip through the common edge of two triangles.
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  return scene;
}

EmbreeScene buildSurface(RTCDevice device, const TriangleMesh& mesh) {
  EmbreeScene scene = makeScene(device);
  const EmbreeGeometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* coordinate = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
  auto* corner = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), mesh.triangles.size()));
  check(device, "memory for a surface");
  for (const auto& vertex : mesh.vertices) coordinate = std::copy_n(vertex.data(), 3, coordinate);
  for (const auto& triangle : mesh.triangles) corner = std::copy_n(triangle.data(), 3, corner);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene.get(), geometry.get());
  commit(scene.get());
  check(device, "building a surface");
  return scene;
}

/// A present solid: what Embree calls an instance.
struct Instance {
  SolidId solid;
  std::shared_ptr<const TriangleMesh> surface;
  Eigen::Isometry3d solid_T_world;
};

/// Exact meeting of the ray with the plane of the triangle that Embree found.
SceneHit exactHit(const Instance& instance, unsigned triangle, const Eigen::Vector3d& world_origin,
                  const Eigen::Vector3d& world_direction, double embree_t) {
  const auto& corner = instance.surface->triangles[triangle];
  const auto vertex = [&](int i) {
    return instance.surface->vertices[corner[static_cast<std::size_t>(i)]].cast<double>().eval();
  };
  const Eigen::Vector3d origin = instance.solid_T_world * world_origin;
  const Eigen::Vector3d direction = instance.solid_T_world.linear() * world_direction;
  const Eigen::Vector3d normal = (vertex(1) - vertex(0)).cross(vertex(2) - vertex(0));
  const double approach = normal.dot(direction);
  const double scale = normal.norm() * direction.norm();
  // In a triangle seen edge-on the division means nothing.
  if (std::abs(approach) < 1e-9 * scale || scale == 0.0) return {embree_t, instance.solid, 0.0};
  return {normal.dot(vertex(0) - origin) / approach, instance.solid,
          std::min(1.0, std::abs(approach) / scale)};
}

}  // namespace

struct SceneRaycaster::Impl {
  struct BuiltSurface {
    std::shared_ptr<const TriangleMesh> mesh;  // kept: its address is the key
    EmbreeScene scene;
  };

  Device device = makeDevice();
  EmbreeScene top = makeScene(device.get());
  std::map<const TriangleMesh*, BuiltSurface> built;
  std::vector<Instance> instances;  // by Embree's instance id

  RTCScene surface(const std::shared_ptr<const TriangleMesh>& mesh) {
    const auto known = built.find(mesh.get());
    if (known != built.end()) return known->second.scene.get();
    EmbreeScene scene = buildSurface(device.get(), *mesh);
    return built.emplace(mesh.get(), BuiltSurface{mesh, std::move(scene)}).first->second.scene.get();
  }

  void addInstance(const Scene& scene, SolidId id) {
    const auto& mesh = scene.solid(id).surface;
    const Eigen::Isometry3d world_T_solid = toIsometry(scene.world_T_solid(id));
    const EmbreeGeometry geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(geometry.get(), surface(mesh));
    const Eigen::Matrix<float, 3, 4> transform = world_T_solid.matrix().topRows<3>().cast<float>();
    rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform.data());
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(top.get(), geometry.get(), static_cast<unsigned>(instances.size()));
    instances.push_back({id, mesh, world_T_solid.inverse()});
  }
};

SceneRaycaster::SceneRaycaster() : impl_(std::make_unique<Impl>()) {
  update(Scene{});
}
SceneRaycaster::SceneRaycaster(const Scene& scene) : impl_(std::make_unique<Impl>()) {
  update(scene);
}
SceneRaycaster::SceneRaycaster(SceneRaycaster&&) noexcept = default;
SceneRaycaster& SceneRaycaster::operator=(SceneRaycaster&&) noexcept = default;
SceneRaycaster::~SceneRaycaster() = default;

void SceneRaycaster::update(const Scene& scene) {
  impl_->top = makeScene(impl_->device.get());
  impl_->instances.clear();
  for (const SolidId id : scene.ids())
    if (scene.present(id)) impl_->addInstance(scene, id);
  commit(impl_->top.get());
  check(impl_->device.get(), "building the scene");
}

std::optional<SceneHit> SceneRaycaster::cast(const Eigen::Vector3d& world_origin,
                                             const Eigen::Vector3d& world_direction, double max_t) const {
  const Eigen::Vector3f o = world_origin.cast<float>();
  const Eigen::Vector3f d = world_direction.cast<float>();
  RTCRayHit query{};
  query.ray.org_x = o.x();
  query.ray.org_y = o.y();
  query.ray.org_z = o.z();
  query.ray.dir_x = d.x();
  query.ray.dir_y = d.y();
  query.ray.dir_z = d.z();
  query.ray.tnear = 0.0F;
  query.ray.tfar = static_cast<float>(max_t);
  query.ray.mask = ~0U;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;

  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(impl_->top.get(), &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return exactHit(impl_->instances[query.hit.instID[0]], query.hit.primID, world_origin, world_direction,
                  static_cast<double>(query.ray.tfar));
}

}  // namespace hoctomap
