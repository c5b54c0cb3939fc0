// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <sstream>

#include "Arrays.h"
#include "Bindings.h"
#include "Map.h"
#include "hoctomap/io/MapReader.h"

namespace hoctomap::python {

MapHierarchy copyOf(const MapHierarchy& hierarchy) {
  const auto copied = [](const NodeMap& map) {
    return NodeMap(std::make_unique<octomap::OcTree>(map.tree()), map.model());
  };
  const auto copyState = [](const MapNode& from, MapNode& to) {
    to.existence_log_odds = from.existence_log_odds;
    to.first_scan = from.first_scan;
    to.last_scan = from.last_scan;
    to.version = from.version;
    to.edition = from.edition;
    to.votes = from.votes;
    to.confirmation = from.confirmation;
  };
  MapHierarchy copy(hierarchy.root().label(), copied(hierarchy.root().map()));
  copyState(hierarchy.root(), copy.root());
  for (const NodeId id : hierarchy.preorder()) {
    const MapNode& node = hierarchy.node(id);
    if (id == kRootId || node.confirmation.waits) continue;
    copyState(node, copy.restore(id, node.label(), copied(node.map()), node.parent_T_node(), *node.parent()));
  }
  copy.setNextId(hierarchy.nextId());
  return copy;
}

namespace {

Node nodeOf(const std::shared_ptr<Map>& map, std::uint32_t id) {
  if (!map->hierarchy().contains(NodeId{id})) throw py::key_error("no node " + std::to_string(id));
  return {map, NodeId{id}};
}

std::vector<Node> nodesOf(const std::shared_ptr<Map>& map) {
  std::vector<Node> nodes;
  for (const NodeId id : map->hierarchy().preorder()) nodes.push_back({map, id});
  return nodes;
}

std::string describe(const Map& map) {
  std::ostringstream text;
  const MapHierarchy& hierarchy = map.hierarchy();
  for (const NodeId id : hierarchy.preorder()) {
    const MapNode& node = hierarchy.node(id);
    text << std::string(2 * hierarchy.depth(id), ' ') << id.value << " " << node.label().name << ", "
         << node.map().resolution() << " m, existence " << node.existence() << ", "
         << node.map().countVoxels().occupied << " occupied voxels\n";
  }
  return text.str();
}

std::shared_ptr<Map> load(const std::filesystem::path& directory, std::optional<std::uint64_t> at_scan) {
  const py::gil_scoped_release released;
  StoredMap stored = readMap(directory, {.at_scan = at_scan});
  return std::make_shared<Map>(std::move(stored.hierarchy), stored.manifest.scans);
}

/// All known cells of a node's octree: centres, edges, probabilities.
py::tuple cellsOf(const Node& node) {
  const octomap::OcTree& tree = node->map().tree();
  const auto count = static_cast<py::ssize_t>(tree.getNumLeafNodes());
  py::array_t<float> centres({count, py::ssize_t{3}});
  py::array_t<float> edges(count);
  py::array_t<float> probabilities(count);
  float* centre = centres.mutable_data();
  float* edge = edges.mutable_data();
  float* probability = probabilities.mutable_data();
  {
    const py::gil_scoped_release released;
    for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf) {
      *centre++ = static_cast<float>(leaf.getX());
      *centre++ = static_cast<float>(leaf.getY());
      *centre++ = static_cast<float>(leaf.getZ());
      *edge++ = static_cast<float>(leaf.getSize());
      *probability++ = static_cast<float>(leaf->getOccupancy());
    }
  }
  return py::make_tuple(centres, edges, probabilities);
}

py::array_t<float> worldVoxels(const Node& node) {
  const PointCloud& voxels = node->map().occupiedVoxels();
  const PointCloud world = transformed(node.map->hierarchy().world_T_node(node.id), voxels);
  return py::array_t<float>({static_cast<py::ssize_t>(world.size()), py::ssize_t{3}},
                            world.empty() ? nullptr : world.data()->data());
}

void bindBox(py::module_& module) {
  py::class_<Obb>(module, "Box", "An oriented box: a frame in the world, and a box along its axes. Metres.")
      .def(py::init([](const Array<double>& center, const Array<double>& half_extents,
                       std::optional<Array<double>> rotation) {
             Obb box;
             const Eigen::Vector3d half = pointOf(half_extents, "half_extents");
             Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
             if (rotation) {
               if (rotation->ndim() != 2 || rotation->shape(0) != 3 || rotation->shape(1) != 3)
                 throw py::value_error("rotation must be a 3x3 matrix");
               pose.topLeftCorner<3, 3>() =
                   Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation->data());
             }
             pose.topRightCorner<3, 1>() = pointOf(center, "center");
             if (!(half.array() >= 0.0).all() || !half.allFinite())
               throw py::value_error("half_extents must be finite and not negative");
             box.world_T_frame = toIsometry(poseFromMatrix(pose));
             box.box = Eigen::AlignedBox3d(-half, half);
             return box;
           }),
           py::arg("center"), py::arg("half_extents"), py::arg("rotation") = py::none(),
           "A box with its centre in the world, half its edges, and the rotation of its frame (3x3).")
      .def_property_readonly(
          "center",
          [](const Obb& b) {
            return toArray(b.box.isEmpty() ? Eigen::Vector3d(b.world_T_frame.translation()) : b.center());
          },
          "Centre in the world, (3,).")
      .def_property_readonly(
          "half_extents",
          [](const Obb& b) {
            return toArray(b.box.isEmpty() ? Eigen::Vector3d::Zero().eval()
                                           : Eigen::Vector3d(b.box.sizes() / 2.0));
          },
          "Half the edges, (3,). Zero for the box of nothing.")
      .def_property_readonly(
          "world_T_frame", [](const Obb& b) { return toArray(b.world_T_frame.matrix()); },
          "The frame whose axes the box follows, (4, 4); the centre need not be its origin.")
      .def(
          "contains",
          [](const Obb& b, const Array<double>& point) { return b.contains(pointOf(point, "point")); },
          py::arg("point"), "Whether a point of the world is inside.")
      .def("intersects", &intersects, py::arg("other"), "Whether two boxes share a point.");
}

void bindNode(py::module_& module) {
  py::class_<Node>(module, "Node", "A node of a map: an octree in its own frame.")
      .def_property_readonly(
          "id", [](const Node& n) { return n.id.value; }, "Number of the node; the root is 0.")
      .def_property_readonly("label", [](const Node& n) { return n->label().name; })
      .def_property_readonly(
          "parent",
          [](const Node& n) {
            return n->parent() ? std::optional<std::uint32_t>(n->parent()->value) : std::nullopt;
          },
          "Number of the parent; None for the root.")
      .def_property_readonly(
          "children",
          [](const Node& n) {
            std::vector<std::uint32_t> ids;
            for (const NodeId id : n->children()) ids.push_back(id.value);
            return ids;
          },
          "Numbers of the children, ascending.")
      .def_property_readonly("depth", [](const Node& n) { return n.map->hierarchy().depth(n.id); })
      .def_property_readonly(
          "resolution", [](const Node& n) { return n->map().resolution(); }, "Edge of a voxel, m.")
      .def_property_readonly(
          "existence", [](const Node& n) { return n->existence(); }, "Probability that the node exists.")
      .def_property_readonly("first_scan", [](const Node& n) { return n->first_scan; })
      .def_property_readonly("last_scan", [](const Node& n) { return n->last_scan; })
      .def_property_readonly(
          "world_T_node", [](const Node& n) { return toArray(n.map->hierarchy().world_T_node(n.id)); },
          "Takes coordinates in the node's frame to the world, (4, 4).")
      .def_property_readonly(
          "parent_T_node", [](const Node& n) { return toArray(n->parent_T_node()); },
          "Takes coordinates in the node's frame to that of its parent, (4, 4).")
      .def_property_readonly(
          "box", [](const Node& n) { return n.map->hierarchy().box(n.id); },
          "Box around the occupied voxels, padded by one voxel.")
      .def_property_readonly(
          "voxels", [](const Node& n) { return viewOf(n->map().occupiedVoxels(), py::cast(n.map)); },
          "Centres of the occupied voxels in the node's frame, (N, 3) float32, m. Read-only, not copied.")
      .def("world_voxels", &worldVoxels, "The same in the world's frame, (N, 3) float32, m. A copy.")
      .def("cells", &cellsOf,
           "All known cells of the octree in the node's frame: centres (N, 3), edges (N,) in m, "
           "probabilities of\n"
           "being occupied (N,), float32. A pruned cell counts once, with its own edge.")
      .def_property_readonly(
          "occupied_voxels", [](const Node& n) { return n->map().countVoxels().occupied; },
          "Number of occupied voxels, at the node's resolution.")
      .def_property_readonly(
          "free_voxels", [](const Node& n) { return n->map().countVoxels().free; },
          "Number of free voxels, at the node's resolution.")
      .def_property_readonly("map", [](const Node& n) { return n.map; })
      .def("__repr__", [](const Node& n) {
        return "<hoctomap.Node " + std::to_string(n.id.value) + " " + n->label().name + ">";
      });
}

}  // namespace

void bindMap(py::module_& module) {
  bindBox(module);
  py::class_<Map, std::shared_ptr<Map>> map(
      module, "Map", "A hierarchy of octree maps that does not change. From load(), or from a Mapper.");
  bindNode(module);
  map.def_property_readonly("scans", &Map::scans, "Scans taken in, skipped ones included.")
      .def_property_readonly("root", [](const std::shared_ptr<Map>& m) { return nodeOf(m, 0); })
      .def_property_readonly(
          "nodes", [](const std::shared_ptr<Map>& m) { return nodesOf(m); },
          "All nodes, parents before children.")
      .def(
          "with_label",
          [](const std::shared_ptr<Map>& m, const std::string& label) {
            std::vector<Node> nodes = nodesOf(m);
            std::erase_if(nodes, [&](const Node& n) { return n->label().name != label; });
            return nodes;
          },
          py::arg("label"), "The nodes of one label.")
      .def("__len__", [](const Map& m) { return m.hierarchy().size(); })
      .def("__contains__", [](const Map& m, std::uint32_t id) { return m.hierarchy().contains(NodeId{id}); })
      .def(
          "__getitem__", [](const std::shared_ptr<Map>& m, std::uint32_t id) { return nodeOf(m, id); },
          py::arg("id"))
      .def("__iter__", [](const std::shared_ptr<Map>& m) { return py::iter(py::cast(nodesOf(m))); })
      .def("__str__", &describe)
      .def("__repr__", [](const Map& m) {
        return "<hoctomap.Map of " + std::to_string(m.hierarchy().size()) + " nodes>";
      });
  module.def(
      "load",
      [](const std::filesystem::path& directory, std::optional<std::uint64_t> at_scan) {
        return load(directory, at_scan);
      },
      py::arg("directory"), py::arg("at_scan") = py::none(),
      "Reads a map directory; every octree is checked against its hash. at_scan: the state that was kept "
      "after\n"
      "this scan. Raises MapError if the map is damaged, FileError if it cannot be read.");
}

}  // namespace hoctomap::python
