// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/GlbExport.h"

#include <bit>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "GreedyMesh.h"
#include "LabelColour.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

namespace {

using Json = nlohmann::ordered_json;

// Numbers of the glTF 2.0 specification.
constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr std::uint32_t kMagic = 0x46546C67;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

static_assert(std::endian::native == std::endian::little, "glTF is little endian");
static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));

class Gltf {
 public:
  explicit Gltf(const MapHierarchy& hierarchy) : hierarchy_(hierarchy) {
    document_["asset"] = {{"version", "2.0"}, {"generator", "hoctomap"}};
    document_["scene"] = 0;
    document_["scenes"] = Json::array({{{"nodes", Json::array({0})}}});
    const double half = std::sqrt(0.5);
    document_["nodes"] = Json::array(
        {{{"name", "hoctomap"}, {"rotation", {-half, 0.0, 0.0, half}}, {"children", Json::array({1})}}});
    const auto order = hierarchy.preorder();
    for (std::size_t i = 0; i < order.size(); ++i) numbers_[order[i]] = i + 1;
    for (const NodeId id : order) {
      Json node = nodeOf(id);  // which adds to the document: before the place for it is looked up
      document_["nodes"].push_back(std::move(node));
    }
    if (!buffer_.empty()) document_["buffers"] = Json::array({{{"byteLength", buffer_.size()}}});
  }

  [[nodiscard]] std::string bytes() const {
    std::string json = document_.dump(-1, ' ', false, Json::error_handler_t::replace);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::size_t total = 12 + 8 + json.size() + (buffer_.empty() ? 0 : 8 + buffer_.size());
    if (total > std::numeric_limits<std::uint32_t>::max())
      throw LimitError("a .glb file holds at most 4 GiB");
    std::string out;
    for (const std::uint32_t word : {kMagic, 2U, static_cast<std::uint32_t>(total)}) append(out, word);
    append(out, static_cast<std::uint32_t>(json.size()));
    append(out, kJsonChunk);
    out += json;
    if (buffer_.empty()) return out;
    append(out, static_cast<std::uint32_t>(buffer_.size()));
    append(out, kBinaryChunk);
    return out + buffer_;
  }

 private:
  static void append(std::string& to, std::uint32_t value) {
    to.append(reinterpret_cast<const char*>(&value), sizeof value);
  }

  Json nodeOf(NodeId id) {
    const MapNode& node = hierarchy_.node(id);
    const Pose& pose = node.parent_T_node();
    const Eigen::Quaterniond q = Eigen::Quaterniond(toIsometry(pose).linear()).normalized();
    Json json{{"name", node.label().name + " " + std::to_string(id.value)},
              {"translation", {pose.x(), pose.y(), pose.z()}},
              {"rotation", {q.x(), q.y(), q.z(), q.w()}},
              {"extras",
               {{"id", id.value},
                {"label", node.label().name},
                {"resolution", node.map().resolution()},
                {"existence", node.existence()}}}};
    for (const NodeId child : node.children()) json["children"].push_back(numbers_.at(child));
    if (const SurfaceMesh mesh = greedyMesh(node.map()); !mesh.vertices.empty())
      json["mesh"] = addMesh(json["name"], mesh, materialOf(node.label()));
    return json;
  }

  std::size_t addMesh(const Json& name, const SurfaceMesh& mesh, std::size_t material) {
    Eigen::AlignedBox3f box;
    for (const auto& vertex : mesh.vertices) box.extend(vertex);
    Json positions =
        accessor(mesh.vertices.data(), mesh.vertices.size(), sizeof(Eigen::Vector3f), kArrayBuffer);
    positions["componentType"] = kFloat;
    positions["type"] = "VEC3";
    positions["min"] = {box.min().x(), box.min().y(), box.min().z()};
    positions["max"] = {box.max().x(), box.max().y(), box.max().z()};
    Json indices =
        accessor(mesh.triangles.data(), mesh.triangles.size(), sizeof(std::uint32_t), kElementArrayBuffer);
    indices["componentType"] = kUnsignedInt;
    indices["type"] = "SCALAR";
    document_["accessors"].push_back(positions);
    document_["accessors"].push_back(indices);
    const std::size_t last = document_["accessors"].size() - 1;
    const Json primitive{{"attributes", {{"POSITION", last - 1}}}, {"indices", last}, {"material", material}};
    document_["meshes"].push_back({{"name", name}, {"primitives", Json::array({primitive})}});
    return document_["meshes"].size() - 1;
  }

  /// Puts an array into the buffer. All its elements are multiples of 4 bytes, as glTF wants.
  Json accessor(const void* from, std::size_t count, std::size_t bytes_each, int target) {
    document_["bufferViews"].push_back({{"buffer", 0},
                                        {"byteOffset", buffer_.size()},
                                        {"byteLength", count * bytes_each},
                                        {"target", target}});
    buffer_.append(static_cast<const char*>(from), count * bytes_each);
    return {{"bufferView", document_["bufferViews"].size() - 1}, {"count", count}};
  }

  std::size_t materialOf(const Label& label) {
    const auto known = materials_.find(label);
    if (known != materials_.end()) return known->second;
    const auto colour = colourOf(label);
    Json factor = Json::array();
    for (const std::uint8_t part : colour) factor.push_back(std::pow(part / 255.0, 2.2));  // sRGB to linear
    factor.push_back(1.0);
    document_["materials"].push_back(
        {{"name", label.name},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", factor}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.9}}}});
    return materials_[label] = document_["materials"].size() - 1;
  }

  const MapHierarchy& hierarchy_;
  Json document_;
  std::string buffer_;
  std::map<NodeId, std::size_t> numbers_;  ///< of the nodes in the file
  std::map<Label, std::size_t> materials_;
};

}  // namespace

std::string glbOf(const MapHierarchy& hierarchy) {
  return Gltf(hierarchy).bytes();
}

}  // namespace hoctomap
