// SPDX-License-Identifier: BSD-3-Clause
#include "GreedyMesh.h"

#include <map>
#include <set>

namespace hoctomap {

namespace {

/// Number of a voxel along the axes; voxel 0 begins at the origin.
using Cell = std::array<int, 3>;
/// Faces of one plane: rows of columns.
using Plane = std::set<std::array<int, 2>>;

std::set<Cell> cellsOf(const NodeMap& map) {
  std::set<Cell> cells;
  const double edge = map.resolution();
  for (const Eigen::Vector3f& p : map.occupiedVoxels()) {
    const auto number = [&](int axis) {
      return static_cast<int>(std::floor(static_cast<double>(p[axis]) / edge));
    };
    cells.insert({number(0), number(1), number(2)});
  }
  return cells;
}

/// Takes the rectangle that begins at the first face out of the plane: {row, column} of its first and behind
/// its last face.
std::array<std::array<int, 2>, 2> takeRectangle(Plane& plane) {
  const int row = plane.begin()->at(0);
  const int column = plane.begin()->at(1);
  int end_column = column;
  while (plane.contains({row, end_column})) ++end_column;
  const auto full = [&](int r) {
    for (int c = column; c < end_column; ++c) {
      if (!plane.contains({r, c})) return false;
    }
    return true;
  };
  int end_row = row;
  while (full(end_row)) {
    for (int c = column; c < end_column; ++c) plane.erase({end_row, c});
    ++end_row;
  }
  return {{{row, column}, {end_row, end_column}}};
}

}  // namespace

SurfaceMesh greedyMesh(const NodeMap& map) {
  const std::set<Cell> cells = cellsOf(map);
  SurfaceMesh mesh;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3;  // u, v, axis: right-handed
    const std::size_t v = (axis + 2) % 3;
    for (const int side : {-1, 1}) {
      std::map<int, Plane> planes;
      for (const Cell& cell : cells) {
        Cell beside = cell;
        beside[axis] += side;
        if (!cells.contains(beside)) planes[cell[axis]].insert({cell[v], cell[u]});
      }
      for (auto& [number, plane] : planes) {
        const int level = number + (side > 0 ? 1 : 0);
        while (!plane.empty()) {
          const auto [first, last] = takeRectangle(plane);
          const auto corner = [&](int at_u, int at_v) {
            Eigen::Vector3d p;
            p[static_cast<Eigen::Index>(axis)] = level;
            p[static_cast<Eigen::Index>(u)] = at_u;
            p[static_cast<Eigen::Index>(v)] = at_v;
            mesh.vertices.emplace_back((map.resolution() * p).cast<float>());
          };
          const auto begin = static_cast<std::uint32_t>(mesh.vertices.size());
          corner(first[1], first[0]);
          corner(last[1], first[0]);
          corner(last[1], last[0]);
          corner(first[1], last[0]);
          const std::array<std::uint32_t, 6> order = side > 0
                                                         ? std::array<std::uint32_t, 6>{0, 1, 2, 0, 2, 3}
                                                         : std::array<std::uint32_t, 6>{0, 2, 1, 0, 3, 2};
          for (const std::uint32_t index : order) mesh.triangles.push_back(begin + index);
        }
      }
    }
  }
  return mesh;
}

}  // namespace hoctomap
