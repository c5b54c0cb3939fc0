// SPDX-License-Identifier: BSD-3-Clause
#include <functional>
#include <iostream>
#include <memory>
#include <numbers>

#include "Command.h"
#include "MappingSetup.h"
#include "NumberList.h"
#include "SceneMaker.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/MapCheck.h"
#include "hoctomap/io/MapDirectory.h"
#include "hoctomap/io/MapReader.h"

namespace hoctomap {

namespace {

struct EditOptions {
  std::string map;
  std::uint32_t node = 0;
  std::uint32_t other = 0;
  std::string label;
  std::string translate;
  std::string rotate;
  std::string pose;
  std::string frame = "world";
};

using EditStep = std::function<UpdateReport(HierarchyMapper&, const HierarchyMapper::Edit&)>;

/// Numbers of an option; angles among them are in degrees.
std::vector<double> numbersOf(const std::string& option, const std::string& text,
                              const std::vector<std::size_t>& counts) {
  try {
    const std::vector<double> numbers = numberList(text);
    for (const std::size_t count : counts) {
      if (numbers.size() == count) return numbers;
    }
    throw std::invalid_argument("has " + std::to_string(numbers.size()) + " numbers");
  } catch (const std::invalid_argument& e) {
    throw ConfigError(option + " " + escapedText(text, 100) + ": " + e.what());
  }
}

Pose poseOf(const std::vector<double>& shift, const std::vector<double>& angles) {
  const auto angle = [&](std::size_t i) {
    return i < angles.size() ? angles[i] * std::numbers::pi / 180.0 : 0.0;
  };
  return {shift[0], shift[1], shift[2], angle(0), angle(1), angle(2)};
}

/// The motion in the node's frame: t of t_i <- t_i o t (III-D).
Pose motionOf(const Pose& world_T_node, const EditOptions& options) {
  if (!options.pose.empty()) {
    const auto numbers = numbersOf("--pose", options.pose, {6});
    return -world_T_node +
           poseOf({numbers.begin(), numbers.begin() + 3}, {numbers.begin() + 3, numbers.end()});
  }
  const auto shift = options.translate.empty() ? std::vector<double>(3, 0.0)
                                               : numbersOf("--translate", options.translate, {3});
  const auto angles =
      options.rotate.empty() ? std::vector<double>() : numbersOf("--rotate", options.rotate, {1, 3});
  const Pose motion = poseOf(shift, angles);
  if (options.frame == "node") return motion;
  // In place: about the axes of the world through the origin of the node's frame.
  const Pose to_origin(world_T_node.x(), world_T_node.y(), world_T_node.z(), 0.0, 0.0, 0.0);
  return -world_T_node + (to_origin + motion + -to_origin + world_T_node);
}

UpdateReport move(HierarchyMapper& mapper, const HierarchyMapper::Edit& edit, const EditOptions& options) {
  if (options.pose.empty() && options.translate.empty() && options.rotate.empty()) {
    throw ConfigError("move wants --translate, --rotate or --pose");
  }
  const NodeId id{options.node};
  const MapHierarchy& map = mapper.hierarchy();
  if (id == kRootId) throw ConfigError("node 0 is the root: it stays as it is");
  if (!map.contains(id) || map.node(id).confirmation.waits) {
    throw ConfigError("the map has no node " + std::to_string(id.value));
  }
  const Pose world_T_node = map.world_T_node(id);
  return mapper.integrate(ObjectMotion{edit.stamp, id, motionOf(world_T_node, options)}, edit.scan);
}

HierarchyMapper mapperOf(const std::filesystem::path& directory, const Manifest& manifest) {
  const Settings settings = loadSettings(directory / manifest.config.path, {});
  MapReadOptions all;
  all.to_edit = true;
  StoredMap stored = readMap(directory, all);
  return {settings.mappingConfig(),    settings.labels,         makeStrategies(settings),
          std::move(stored.hierarchy), std::move(stored.seams), stored.manifest.sensor};
}

int edit(const EditOptions& options, const EditStep& step) {
  const std::filesystem::path path(options.map);
  const auto damage = findDamage(path, readManifest(path));  // before a lock is made beside what is no map
  if (!damage.empty()) {
    throw MapError(options.map + "/" + damage.front().path + ": " + damage.front().what);
  }
  MapDirectory directory(path, {MapOpenMode::edit, {}, "hoctomap " HOCTOMAP_VERSION, {}});
  const Manifest before = *directory.committed();
  HierarchyMapper mapper = mapperOf(path, before);
  mapper.confirmEntered();
  const HierarchyMapper::Edit here{before.scans == 0 ? 0 : before.scans - 1, before.last_stamp,
                                   before.edits + 1};
  const UpdateReport report = step(mapper, here);
  directory.append(report);
  directory.commit({.hierarchy = mapper.hierarchy(),
                    .removed = mapper.removed(),
                    .scans = before.scans,
                    .input = before.input,
                    .last_stamp = before.last_stamp,
                    .seams = &mapper.seams(),
                    .sensor = mapper.sensor(),
                    .motions = before.motions,
                    .mapped_scans = before.mapped_scans,
                    .skipped_scans = before.skipped_scans});
  directory.writeScene(makeScene);
  for (const NodeEvent& event : report.events) {
    std::cout << "node " << event.node.value << " (" << escapedText(event.label.name)
              << "): " << toString(event.kind) << ", " << escapedText(event.detail) << "\n";
  }
  std::cout << std::flush;
  return 0;
}

}  // namespace

void addEditCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<EditOptions>();
  CLI::App* command = addCommand(
      app, "edit", "Change a map by hand: relabel, move, remove or merge nodes",
      {"hoctomap edit map relabel 3 table", "hoctomap edit map move 3 --translate 0.1,0,0 --rotate 30",
       "hoctomap edit map move 3 --pose 1,0.2,0.75,90,0,0", "hoctomap edit map remove 4",
       "hoctomap edit map merge 3 5"});
  command->add_option("map", options->map, "map directory")->type_name("DIR")->required();
  command->require_subcommand(1);
  const auto addStep = [&](const std::string& name, const std::string& what, const EditStep& step) {
    CLI::App* added = command->add_subcommand(name, what);
    added->add_option("node", options->node, "id of a node")->type_name("NODE")->required();
    added->callback([options, step, &action] { action = [options, step] { return edit(*options, step); }; });
    return added;
  };

  addStep("relabel", "give a node another label of the map's configuration; its octree stays",
          [options](HierarchyMapper& mapper, const HierarchyMapper::Edit& here) {
            return mapper.relabel(NodeId{options->node}, Label{options->label}, here);
          })
      ->add_option("label", options->label, "the new label")
      ->type_name("LABEL")
      ->required();

  CLI::App* moves = addStep("move", "move a node; what stands on it follows",
                            [options](HierarchyMapper& mapper, const HierarchyMapper::Edit& here) {
                              return move(mapper, here, *options);
                            });
  auto* translate = moves->add_option("--translate", options->translate, "by so much, m")->type_name("X,Y,Z");
  auto* rotate =
      moves->add_option("--rotate", options->rotate, "in place, degrees")->type_name("YAW[,PITCH,ROLL]");
  moves->add_option("--frame", options->frame, "of these two: world (default) or node")
      ->check(CLI::IsMember({"world", "node"}))
      ->type_name("FRAME");
  moves->add_option("--pose", options->pose, "the new pose of its frame in the world, m and degrees")
      ->type_name("X,Y,Z,YAW,PITCH,ROLL")
      ->excludes(translate)
      ->excludes(rotate);

  addStep("remove", "remove a node; its children go to its parent",
          [options](HierarchyMapper& mapper, const HierarchyMapper::Edit& here) {
            return mapper.remove(NodeId{options->node}, here);
          });
  addStep("merge", "a second node goes into the first, its children with it",
          [options](HierarchyMapper& mapper, const HierarchyMapper::Edit& here) {
            return mapper.merge(NodeId{options->node}, NodeId{options->other}, here);
          })
      ->add_option("other", options->other, "id of the node that goes into it")
      ->type_name("OTHER")
      ->required();
}

}  // namespace hoctomap
