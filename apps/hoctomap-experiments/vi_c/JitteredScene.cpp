// SPDX-License-Identifier: BSD-3-Clause
#include "vi_c/JitteredScene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <vector>

namespace hoctomap {

namespace {

using Plan = std::vector<Eigen::Vector2d>;

/// Points of a surface in the plan of its own frame, one in a cell of 4 mm.
Plan planOf(const TriangleMesh& mesh) {
  constexpr double kCell = 0.004;  // m
  std::set<std::pair<long, long>> cells;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector2d a = mesh.vertices[t[i]].cast<double>().head<2>();
      const Eigen::Vector2d b = mesh.vertices[t[(i + 1) % 3]].cast<double>().head<2>();
      const int steps = static_cast<int>(std::ceil((b - a).norm() / kCell)) + 1;
      for (int s = 0; s <= steps; ++s) {
        const Eigen::Vector2d p = a + (b - a) * (static_cast<double>(s) / steps);
        cells.emplace(std::lround(p.x() / kCell), std::lround(p.y() / kCell));
      }
    }
  }
  Plan plan;
  for (const auto& [x, y] : cells)
    plan.emplace_back(kCell * static_cast<double>(x), kCell * static_cast<double>(y));
  return plan;
}

Plan placed(const Plan& plan, const Pose& support_T_solid) {
  const Eigen::Isometry3d t = toIsometry(support_T_solid);
  Plan result;
  for (const Eigen::Vector2d& p : plan)
    result.emplace_back((t * Eigen::Vector3d(p.x(), p.y(), 0.0)).head<2>());
  return result;
}

bool nearerThan(const Plan& a, const Plan& b, double distance) {
  return std::any_of(a.begin(), a.end(), [&](const Eigen::Vector2d& p) {
    return std::any_of(b.begin(), b.end(),
                       [&](const Eigen::Vector2d& q) { return (p - q).squaredNorm() < distance * distance; });
  });
}

bool within(const Plan& plan, const TriangleMesh& table, double margin) {
  const auto box = surfaceExtent(table, Eigen::Isometry3d::Identity()).box;
  return std::all_of(plan.begin(), plan.end(), [&](const Eigen::Vector2d& p) {
    return p.x() > box.min().x() + margin && p.x() < box.max().x() - margin &&
           p.y() > box.min().y() + margin && p.y() < box.max().y() - margin;
  });
}

}  // namespace

Scene jittered(Scene scene, std::uint64_t seed) {
  constexpr double kShift = 0.04;  // m
  constexpr double kTurn = 0.35;   // radians
  constexpr double kApart = 0.015;
  constexpr double kEdge = 0.03;
  constexpr int kDraws = 20;
  std::mt19937_64 random(seed);
  const auto within_one = [&random] { return static_cast<double>(random() >> 11U) * 0x1p-52 - 1.0; };

  std::map<SolidId, Plan> plans;  // of the objects on tables, where they stand
  for (const SolidId id : scene.ids()) {
    const Solid& solid = scene.solid(id);
    if (solid.label == SolidLabel::object && solid.support && scene.present(id))
      plans[id] = placed(planOf(*solid.surface), solid.support_T_solid);
  }
  for (auto& [id, plan] : plans) {
    const Solid solid = scene.solid(id);
    const Plan own = planOf(*solid.surface);
    for (int draw = 0; draw < kDraws; ++draw) {
      const Pose& old = solid.support_T_solid;
      const Pose pose(old.x() + kShift * within_one(), old.y() + kShift * within_one(), old.z(),
                      old.yaw() + kTurn * within_one(), old.pitch(), old.roll());
      Plan there = placed(own, pose);
      const bool free = std::none_of(plans.begin(), plans.end(), [&, me = id](const auto& other) {
        return other.first != me && scene.solid(other.first).support == solid.support &&
               nearerThan(there, other.second, kApart);
      });
      if (!free || !within(there, *scene.solid(*solid.support).surface, kEdge)) continue;
      scene.place(id, solid.support, pose);
      plan = std::move(there);
      break;
    }
  }
  return scene;
}

}  // namespace hoctomap
