// SPDX-License-Identifier: BSD-3-Clause
// Damaged and hostile maps: one MapError that names the file, never a crash.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/MapCheck.h"
#include "hoctomap/io/MapDirectory.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/io/OctreeFile.h"
#include "hoctomap/io/Sha256.h"
#include "random_map.h"

namespace hoctomap {
namespace {

class MapRefused : public ::testing::Test {
 protected:
  MapRefused() {
    MapDirectory writer(map(), test::mapOptions(MapOpenMode::create));
    writer.commit({test::randomHierarchy(rng_, 3), {}, 5});
    manifest_ = readManifest(map());
  }
  [[nodiscard]] std::filesystem::path map() const { return folder_.path() / "map"; }

  [[nodiscard]] std::string yamlWith(const std::function<void(Manifest&)>& change) const {
    Manifest changed = manifest_;
    change(changed);
    return toYaml(changed);
  }
  static std::string messageOf(const std::function<void()>& call) {
    try {
      call();
    } catch (const MapError& error) {
      return error.what();
    }
    return "no MapError";
  }
  /// The manifest is refused, and the message holds file and word.
  static void expectRefused(const std::string& yaml, const std::string& word) {
    const std::string message = messageOf([&] { static_cast<void>(parseManifest(yaml, "m.yaml")); });
    EXPECT_TRUE(message.starts_with("m.yaml: ") || message.starts_with("m.yaml (")) << message;
    EXPECT_NE(message.find(word), std::string::npos) << message << "\nshould hold: " << word;
  }
  [[nodiscard]] std::string replaced(const std::string& from, const std::string& to) const {
    std::string yaml = toYaml(manifest_);
    const auto at = yaml.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? yaml : yaml.replace(at, from.size(), to);
  }
  /// Puts other bytes into node 1's file, with a manifest that vouches for them.
  void forgeOt(const std::string& bytes) {
    NodeRecord& node = manifest_.nodes.at(1);
    test::writeText(map() / node.ot.path, bytes);
    node.ot = {node.ot.path, bytes.size(), sha256Hex(bytes)};
    test::writeText(map() / "hierarchy.yaml", toYaml(manifest_));
  }
  void expectMapRefused(const std::string& file, const std::string& word) const {
    const std::string message = messageOf([&] { static_cast<void>(readMap(map())); });
    EXPECT_NE(message.find(file), std::string::npos) << message;
    EXPECT_NE(message.find(word), std::string::npos) << message;
    const auto damage = findDamage(map(), manifest_);
    ASSERT_EQ(damage.size(), 1U);
    EXPECT_EQ(damage.front().path, file);
  }

  test::Rng rng_{5};
  test::TemporaryFolder folder_;
  Manifest manifest_;
};

TEST_F(MapRefused, NoMap) {
  EXPECT_THROW(static_cast<void>(readManifest(folder_.path() / "nowhere")), MapError);
  EXPECT_THROW(static_cast<void>(readManifest(folder_.path())), MapError);
}

TEST_F(MapRefused, Trees) {
  const NodeId second = manifest_.nodes.at(2).id;
  expectRefused(yamlWith([](Manifest& m) { m.nodes.at(2).parent.reset(); }), "two roots");
  expectRefused(yamlWith([](Manifest& m) { m.nodes.at(0).parent = NodeId{1}; }), "no root");
  expectRefused(yamlWith([](Manifest& m) { m.nodes.clear(); }), "no root");
  expectRefused(yamlWith([](Manifest& m) { m.nodes.at(2).parent = NodeId{3000}; }), "no node 3000");
  expectRefused(yamlWith([](Manifest& m) { m.nodes.at(2).id = m.nodes.at(1).id; }), "twice");
  expectRefused(yamlWith([](Manifest& m) {
                  m.removed.push_back(m.nodes.at(2));
                  m.removed[0].removed_scan = 1;
                }),
                "twice");
  expectRefused(yamlWith([](Manifest& m) { m.nodes.at(0).children.clear(); }), "children");
  expectRefused(yamlWith([](Manifest& m) {
                  m.nodes.resize(1);
                  m.nodes.at(0).id = NodeId{1};
                }),
                "the root must have id 0");
  expectRefused(yamlWith([](Manifest& m) {
                  m.nodes.at(0).parent_T_node = Pose(1, 0, 0, 0, 0, 0);
                  m.nodes.at(0).world_T_node = m.nodes.at(0).parent_T_node;
                }),
                "frame must be the world's");
  expectRefused(yamlWith([&](Manifest& m) { m.next_id = second; }), "next_id");
  expectRefused(yamlWith([](Manifest& m) {  // two nodes that are each other's parents
                  const NodeId a = m.nodes.at(1).id;
                  const NodeId b = m.nodes.at(2).id;
                  for (NodeRecord& node : m.nodes) {
                    std::erase(node.children, a);
                    std::erase(node.children, b);
                  }
                  m.nodes.at(1).parent = b;
                  m.nodes.at(2).parent = a;
                  m.nodes.at(1).children = {b};
                  m.nodes.at(2).children = {a};
                  m.nodes.resize(3);
                  m.nodes.at(0).children.clear();
                }),
                "cycle");
}

TEST_F(MapRefused, Values) {
  for (const double existence : {0.0, 1.0, -0.1, 1.5}) {
    expectRefused(yamlWith([&](Manifest& m) { m.nodes.at(1).existence = existence; }), "existence");
  }
  expectRefused(
      yamlWith([](Manifest& m) { m.nodes.at(1).existence = std::numeric_limits<double>::quiet_NaN(); }),
      "existence");
  expectRefused(yamlWith([](Manifest& m) { m.nodes.at(1).existence_log_odds = 3.5; }), "existence_log_odds");
  for (const double resolution : {0.0, -0.1, std::numeric_limits<double>::infinity()}) {
    expectRefused(yamlWith([&](Manifest& m) { m.nodes.at(1).resolution = resolution; }), "resolution");
  }
  expectRefused(yamlWith([](Manifest& m) { m.nodes.at(1).occupancy.prob_hit = 1.0; }), "prob_hit");
  expectRefused(yamlWith([](Manifest& m) { m.nodes.at(1).occupancy.clamping_min = 0.99; }), "clamping_min");
  expectRefused(yamlWith([](Manifest& m) { m.nodes.at(1).ot.sha256 = "00"; }), "sha256");
  for (const char* path : {"../secret", "/etc/passwd", "nodes/../../x", "", "a\nb"}) {
    expectRefused(yamlWith([&](Manifest& m) { m.nodes.at(1).ot.path = path; }), "out of the map directory");
  }
  expectRefused(yamlWith([](Manifest& m) { m.nodes.at(1).world_T_node.x(77.0); }), "world_pose");
  expectRefused(yamlWith([](Manifest& m) { m.nodes.at(1).box_half_extents.y() = -0.1; }), "negative extent");
  for (const double infinite : {1.0, -1.0}) {
    expectRefused(
        yamlWith([&](Manifest& m) { m.last_stamp = infinite * std::numeric_limits<double>::infinity(); }),
        "last_stamp");
  }
}

TEST_F(MapRefused, WhatWaits) {
  const auto waiting = [](Manifest& m) {
    NodeRecord node = m.nodes.at(1);
    node.id = NodeId{m.next_id.value};
    m.next_id = NodeId{m.next_id.value + 1};
    node.children.clear();
    node.confirmation.waits = true;
    m.waiting.push_back(node);
  };
  Manifest sound = manifest_;
  waiting(sound);
  EXPECT_EQ(parseManifest(toYaml(sound), "m.yaml").waiting.size(), 1U);
  const auto with = [&](const std::function<void(NodeRecord&)>& change) {
    Manifest changed = sound;
    change(changed.waiting[0]);
    return toYaml(changed);
  };
  expectRefused(with([](NodeRecord& node) { node.parent = NodeId{3000}; }), "under a node of the tree");
  expectRefused(with([](NodeRecord& node) { node.parent.reset(); }), "under a node of the tree");
  expectRefused(with([](NodeRecord& node) { node.children = {NodeId{1}}; }), "alone");
  std::string yaml = toYaml(sound);
  const std::string flag = "enough: false";
  expectRefused(yaml.replace(yaml.find(flag), flag.size(), "enough: maybe"), "neither true nor false");
}

TEST_F(MapRefused, Texts) {
  expectRefused(replaced("format_version: 1", "format_version: 2"), "newer");
  expectRefused(replaced("format_version: 1", "format_version: one"), "format_version");
  expectRefused(replaced("scans: 5", "scans: 5junk"), "scans");
  expectRefused(replaced("scans: 5", "scans: -5"), "scans");
  expectRefused(replaced("  - id: 1\n", "  - id: 99999999999\n"), "id");
  expectRefused(replaced("    resolution: ", "    rezolution: "), "resolution");
  expectRefused(replaced("pose_matrix: [1.0, ", "pose_matrix: [2.0, "), "pose_matrix");
  expectRefused(replaced("pose_matrix: [1.0, ", "pose_matrix: ["), "pose_matrix");
  expectRefused(replaced("    pose: \"[0.0 ", "    pose: \"[5.0 "), "pose");
  expectRefused(replaced("    pose: \"[0.0 ", "    pose: \"[0,0 "), "pose");
  expectRefused(replaced("    pose: \"[", "    pose: \"("), "pose");
  expectRefused(replaced("0.0]\"\n    world_pose", "0.0)\"\n    world_pose"), "pose");
  expectRefused(replaced("generator: ", "generatr: "), "no key `generator`");
  expectRefused(replaced("format_version: 1\n", "format_version: 1\ninput: 's [[[[[[['\n"), "hash");
  expectRefused("", "mapping");
  expectRefused("just a text", "");
  expectRefused("[1, 2", "line");
  expectRefused("a: *nobody", "line");
  expectRefused(std::string(100'000, '['), "line");
  expectRefused(std::string("\0\xff\xfe\x01", 4), "");
}

TEST_F(MapRefused, EveryCutOfTheManifest) {
  const std::string yaml = toYaml(manifest_);
  for (std::size_t size = 0; size < yaml.size(); size += size + 100 < yaml.size() ? 37U : 1U) {
    EXPECT_THROW(static_cast<void>(parseManifest(yaml.substr(0, size), "m.yaml")), MapError) << size;
  }
  EXPECT_THROW(static_cast<void>(parseManifest(yaml + "\n", "m.yaml")), MapError);
}

/// Also a bit of a number, of a comment, and of the hash itself.
TEST_F(MapRefused, EveryFlippedBitOfTheManifest) {
  const std::string yaml = toYaml(manifest_);
  const std::size_t hash = yaml.find(": ") + 2;  // before it stands a comment
  for (std::size_t at = hash; at < yaml.size(); at += at < 300 ? 1U : 23U) {
    std::string flipped = yaml;
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << (at % 8)));
    EXPECT_THROW(static_cast<void>(parseManifest(flipped, "m.yaml")), MapError) << at;
  }
}

TEST_F(MapRefused, AManifestWithoutItsOwnHashIsThatOfAnotherProgram) {
  std::string yaml = toYaml(manifest_);
  yaml.erase(0, yaml.find('\n') + 1);
  EXPECT_EQ(toYaml(parseManifest(yaml, "m.yaml")), toYaml(manifest_));
  EXPECT_EQ(toYaml(parseManifest(yaml + "more: 1\n", "m.yaml")), toYaml(manifest_));
}

TEST_F(MapRefused, FilesOfAnotherKindOrSize) {
  std::filesystem::remove(map() / "config.ini");
  std::filesystem::create_directory(map() / "config.ini");
  EXPECT_EQ(findDamage(map(), manifest_).at(0).path, "config.ini");
  std::filesystem::resize_file(map() / "events.csv", 1);
  EXPECT_EQ(findDamage(map(), manifest_).at(1).path, "events.csv");
  std::filesystem::resize_file(map() / "hierarchy.yaml", (1U << 28U) + 1U);  // takes no room on the disk
  EXPECT_THROW(static_cast<void>(readManifest(map())), LimitError);
  // A map that cannot be read is overwritten all the same.
  MapDirectory writer(map(), test::mapOptions(MapOpenMode::overwrite));
  EXPECT_FALSE(writer.committed());
  EXPECT_THROW(writer.writeScene([](const auto&, const auto&) {}), std::logic_error);
}

/// Keys that came later may be missing.
TEST_F(MapRefused, MapsOfEarlierVersionsAreNot) {
  std::string yaml = toYaml(manifest_);
  for (const char* key : {"# sha256: ", "mapped_scans: ", "skipped_scans: ", "last_stamp: ", "waiting: "}) {
    const auto at = yaml.starts_with(key) ? 0 : yaml.find("\n" + std::string(key)) + 1;
    ASSERT_TRUE(yaml.substr(at).starts_with(key)) << key;
    yaml.erase(at, yaml.find('\n', at) + 1 - at);
  }
  const Manifest back = parseManifest(yaml, "m.yaml");
  EXPECT_EQ(back.nodes.size(), manifest_.nodes.size());
  EXPECT_EQ(back.mapped_scans, 0U);
}

TEST_F(MapRefused, TooDeepIsALimit) {
  MapHierarchy chain(labels::background, NodeMap(0.1, {}));
  for (std::uint32_t i = 0; i < 65; ++i) chain.add(labels::object, NodeMap(0.1, {}), Pose(), NodeId{i});
  const auto directory = folder_.path() / "deep";
  MapDirectory writer(directory, test::mapOptions(MapOpenMode::create));
  writer.commit({chain, {}, 1});
  EXPECT_THROW(static_cast<void>(readManifest(directory)), LimitError);
}

TEST_F(MapRefused, NodeFiles) {
  const std::string path = manifest_.nodes.at(1).ot.path;
  const std::string good = test::readText(map() / path);
  test::writeText(map() / path, good.substr(0, good.size() / 2));
  expectMapRefused(path, "bytes");
  std::string flipped = good;
  flipped[good.size() / 2] = static_cast<char>(flipped[good.size() / 2] ^ 1);
  test::writeText(map() / path, flipped);
  expectMapRefused(path, "hash");
  std::filesystem::remove(map() / path);
  expectMapRefused(path, "missing");
}

TEST_F(MapRefused, ForgedNodeFiles) {
  const std::string path = manifest_.nodes.at(1).ot.path;
  const std::string good = test::readText(map() / path);
  forgeOt(good.substr(0, good.size() - 1));
  expectMapRefused(path, "cut");

  std::string nan = good;
  const float value = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(nan.data() + nan.find("data\n") + 5, &value, sizeof value);
  forgeOt(nan);
  expectMapRefused(path, "log-odds");

  std::string bomb = "# Octomap OcTree file\nid OcTree\nsize 50000\nres 0.01\ndata\n";
  for (int i = 0; i < 50'000; ++i) bomb += std::string("\0\0\0\0\x01", 5);
  forgeOt(bomb);
  expectMapRefused(path, "deeper than 16");
}

}  // namespace
}  // namespace hoctomap
