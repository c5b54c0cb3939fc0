// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/simulation/MeshFile.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>

#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

constexpr std::size_t kMaxTriangles = 10'000'000;

void appendPart(TriangleMesh& mesh, const aiMesh& part, double scale, const std::string& file) {
  const auto offset = static_cast<std::uint32_t>(mesh.vertices.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& v = part.mVertices[i];
    const Eigen::Vector3d point = scale * Eigen::Vector3d(v.x, v.y, v.z);
    if (!point.allFinite()) throw InputError(file + ": a vertex is not finite");
    mesh.vertices.emplace_back(point.cast<float>());
  }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;  // points and lines have no surface
    mesh.triangles.push_back(
        {offset + face.mIndices[0], offset + face.mIndices[1], offset + face.mIndices[2]});
  }
  if (mesh.triangles.size() > kMaxTriangles) throw LimitError(file + ": more than 10^7 triangles");
}

}  // namespace

TriangleMesh loadMesh(const std::filesystem::path& path, double scale) {
  const std::string file = path.string();
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file, aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                                                     aiProcess_PreTransformVertices | aiProcess_SortByPType);
  if (scene == nullptr) throw InputError(file + ": cannot read the mesh: " + importer.GetErrorString());

  TriangleMesh mesh;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) appendPart(mesh, *scene->mMeshes[i], scale, file);
  if (mesh.triangles.empty()) throw InputError(file + ": the mesh has no triangles");
  return mesh;
}

}  // namespace hoctomap
