// SPDX-License-Identifier: BSD-3-Clause
#include "changes/ChangeRun.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "MappingSetup.h"

namespace hoctomap {

namespace {

/// What a node stands for, and the pose that its object had when the node was put where it is.
struct Identity {
  SolidId solid;
  Pose world_T_solid;
};

bool samePose(const Pose& a, const Pose& b) {
  const Eigen::Isometry3d d = toIsometry(a).inverse() * toIsometry(b);
  return d.translation().norm() < 0.005 && Eigen::AngleAxisd(d.rotation()).angle() < 0.03;
}

class Run {
 public:
  Run(const ChangeScript& script, const Settings& settings)
      : script_(script),
        mapper_(settings.mappingConfig(), settings.labels, makeStrategies(settings)),
        before_(script.simulation.scene) {
    result_.name = script.name;
  }

  ChangeResult run() && {
    simulateScene(script_.simulation, 0, [this](const SimulatedScan& scan) { integrate(scan); });
    closeState();
    return std::move(result_);
  }

 private:
  void integrate(const SimulatedScan& scan) {
    if (scan.scan > 0 && scan.scan % script_.scans_per_state == 0) closeState();
    Measurement z = unproject(scan.image, scan.world_T_sensor, {});
    z.scan = scan.scan;
    z.stamp = scan.stamp;
    z.sensor = scan.sensor;
    const UpdateReport report = mapper_.integrate(z);
    for (const std::string& warning : report.warnings) warnings_ += "; " + warning;
    for (const NodeEvent& event : report.events) note(event, scan, z);
    for (const ExistenceEntry& entry : report.existence) {
      const auto known = identities_.find(entry.node);
      if (known == identities_.end()) continue;
      const Identity& identity = known->second;
      const bool exists = scan.scene.present(identity.solid) &&
                          samePose(identity.world_T_solid, scan.scene.world_T_solid(identity.solid));
      result_.existence.push_back({entry.p_posterior, exists});
    }
    now_ = scan.scene;
  }

  void note(const NodeEvent& event, const SimulatedScan& scan, const Measurement& z) {
    const bool is_object = event.label == labels::object;
    switch (event.kind) {
      case NodeEventKind::created:
        if (is_object) ++appeared_;
        identify(event.node, scan, z);
        break;
      case NodeEventKind::removed:
        if (is_object) ++vanished_;
        break;
      case NodeEventKind::reidentified:
        moved_.push_back(event);
        moveIdentities(event.node, scan.scene);
        break;
      default:
        break;
    }
  }

  /// The solid that most of a new node's surface shows, by the truth image.
  void identify(NodeId id, const SimulatedScan& scan, const Measurement& z) {
    std::map<std::int32_t, int> votes;
    const MapHierarchy& map = mapper_.hierarchy();
    if (!map.contains(id)) return;
    const Eigen::Isometry3d sensor_T_node =
        toIsometry(z.world_T_sensor).inverse() * toIsometry(map.world_T_node(id));
    const PinholeCamera& camera = scan.image.camera;
    for (const auto& voxel : map.node(id).map().occupiedVoxels()) {
      const Eigen::Vector3d p = sensor_T_node * voxel.cast<double>();
      const auto u = std::lround(camera.cx - camera.fx * p.y() / p.x());
      const auto v = std::lround(camera.cy - camera.fy * p.z() / p.x());
      if (u < 0 || v < 0 || u >= camera.width || v >= camera.height) continue;
      ++votes[scan.solids[static_cast<std::size_t>(v * camera.width + u)]];
    }
    const auto most = std::max_element(votes.begin(), votes.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    if (most == votes.end() || most->first < 0) return;
    const SolidId solid{static_cast<std::uint32_t>(most->first)};
    if (scan.scene.solid(solid).label == SolidLabel::background) return;
    identities_[id] = {solid, scan.scene.world_T_solid(solid)};
  }

  /// What moved and what it carries is now where the truth says.
  void moveIdentities(NodeId id, const Scene& scene) {
    const auto known = identities_.find(id);
    if (known != identities_.end()) known->second.world_T_solid = scene.world_T_solid(known->second.solid);
    if (!mapper_.hierarchy().contains(id)) return;
    for (const NodeId child : mapper_.hierarchy().node(id).children()) moveIdentities(child, scene);
  }

  void closeState() {
    if (state_ > 0) {
      const ExpectedChanges& expected = script_.states[state_ - 1];
      count("appeared", expected.appeared.size(), appeared_);
      count("vanished", expected.vanished.size(), vanished_);
      count("moved", expected.moved.size(), moved_.size());
      for (const std::string& name : expected.moved) addMotion(name);
    } else {
      count("appeared at the beginning", presentObjects(), appeared_);
    }
    before_ = now_ ? *now_ : before_;
    appeared_ = vanished_ = 0;
    moved_.clear();
    warnings_.clear();
    ++state_;
  }

  [[nodiscard]] std::size_t presentObjects() const {
    std::size_t objects = 0;
    for (const SolidId id : before_.ids()) {
      if (before_.present(id) && before_.solid(id).label == SolidLabel::object) ++objects;
    }
    return objects;
  }

  void count(const std::string& what, std::size_t expected, std::size_t reported) {
    const bool is_first = state_ == 0;  // the objects of the first state are not changes
    if (!is_first) {
      result_.counts.right += static_cast<int>(std::min(expected, reported));
      result_.counts.false_alarms += static_cast<int>(reported - std::min(expected, reported));
      result_.counts.missed += static_cast<int>(expected - std::min(expected, reported));
    }
    if (expected == reported) return;
    result_.mistakes.push_back(script_.name + " state " + std::to_string(state_) + ": " + what + " " +
                               std::to_string(expected) + ", reported " + std::to_string(reported) +
                               warnings_);
  }

  /// The reported motion that fits the true motion of a solid best.
  void addMotion(const std::string& name) {
    const SolidId id = before_.find(name).value();
    const Eigen::Isometry3d from = toIsometry(before_.world_T_solid(id));
    const Eigen::Isometry3d to = toIsometry(now_->world_T_solid(id));
    const bool is_round = std::find(script_.round.begin(), script_.round.end(), name) != script_.round.end();
    std::optional<MotionError> best;
    for (const NodeEvent& event : moved_) {
      const auto motion = poseInBrackets(event.detail);
      if (!motion) continue;
      // In the solid's own frame: what is left between where it is said to be and where it is.
      const Eigen::Isometry3d rest = to.inverse() * *motion * from;
      const Eigen::Vector3d centre(0.0, 0.0, 0.05);
      MotionError error{name, (rest * centre - centre).norm(), Eigen::AngleAxisd(rest.rotation()).angle()};
      error.turn = is_round ? 0.0 : std::min(error.turn, std::abs(std::numbers::pi - error.turn));
      for (const double turn : otherTurns(event.detail))
        error.turn = std::min(error.turn, turnLeft(rest, turn));
      if (!best || error.shift < best->shift) best = error;
    }
    constexpr double kAnotherOne = 0.1;  // m: the motion of something else
    if (best && best->shift < kAnotherOne) result_.motions.push_back(*best);
  }

  /// Turns that are reported to be as likely, rad.
  static std::vector<double> otherTurns(const std::string& text) {
    const std::string words = "or turned by ";
    std::vector<double> turns;
    for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1))
      turns.push_back(std::stod(text.substr(at + words.size())) * std::numbers::pi / 180.0);
    return turns;
  }

  /// What is left of a motion's error if the thing turned by so much more.
  static double turnLeft(const Eigen::Isometry3d& rest, double turn) {
    const Eigen::AngleAxisd more(turn, Eigen::Vector3d::UnitZ());
    return Eigen::AngleAxisd(rest.rotation() * more.toRotationMatrix()).angle();
  }

  static std::optional<Eigen::Isometry3d> poseInBrackets(const std::string& text) {
    const std::size_t begin = text.find('[');
    const std::size_t end = text.find(']', begin);
    if (begin == std::string::npos || end == std::string::npos) return std::nullopt;
    Pose pose;
    pose.fromString(text.substr(begin, end - begin + 1));
    return toIsometry(pose);
  }

  const ChangeScript& script_;
  HierarchyMapper mapper_;
  ChangeResult result_;
  std::map<NodeId, Identity> identities_;
  std::size_t state_ = 0;
  Scene before_;              ///< at the end of the last state
  std::optional<Scene> now_;  ///< of the last scan
  std::size_t appeared_ = 0;
  std::size_t vanished_ = 0;
  std::vector<NodeEvent> moved_;
  std::string warnings_;
};

}  // namespace

void ChangeCounts::operator+=(const ChangeCounts& other) {
  right += other.right;
  false_alarms += other.false_alarms;
  missed += other.missed;
}

double ChangeCounts::precision() const {
  return right + false_alarms == 0 ? 1.0 : static_cast<double>(right) / (right + false_alarms);
}

double ChangeCounts::recall() const {
  return right + missed == 0 ? 1.0 : static_cast<double>(right) / (right + missed);
}

ChangeResult runChangeScript(const ChangeScript& script, const Settings& settings) {
  return Run(script, settings).run();
}

}  // namespace hoctomap
