// SPDX-License-Identifier: BSD-3-Clause
// What a map holds for a run that goes on: nodes that wait, votes on seams, the sensor, movements.
#include <gtest/gtest.h>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/MapCheck.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/io/Sha256.h"
#include "random_map.h"

namespace hoctomap {
namespace {

SeamVotes randomSeams(test::Rng& rng) {
  std::uniform_int_distribution<std::int32_t> index(-1000, 1000);
  std::uniform_int_distribution<int> evidence(-32768, 32767);
  std::bernoulli_distribution one_half;
  SeamVotes seams;
  for (int i = 0; i < 50; ++i) {
    SeamVotes::Votes votes;
    votes.is_object = one_half(rng);
    for (std::size_t d = 0; d < SeamVotes::kDirections; ++d) {
      if (!one_half(rng)) continue;
      votes.known.set(d);
      votes.evidence.at(d) = static_cast<std::int16_t>(evidence(rng));
    }
    seams.set({index(rng), index(rng), index(rng)}, votes);
  }
  return seams;
}

class RunState : public ::testing::Test {
 protected:
  RunState() {
    hierarchy_.node(waits_).confirmation = {true, false, 1, 2, 300, true};
    hierarchy_.node(let_in_).confirmation = {false, true, 2, 1, 200, true};
    MapDirectory writer(map(), test::mapOptions(MapOpenMode::create));
    writer.append(test::reportOf(hierarchy_, kRootId, 3));
    commit(writer, hierarchy_, seams_);
  }
  void commit(MapDirectory& writer, const MapHierarchy& hierarchy, const SeamVotes& seams) const {
    writer.commit({.hierarchy = hierarchy,
                   .removed = {},
                   .scans = 4,
                   .input = "\"a\\log\"\n\x01\x7f\xc3\xa4",
                   .last_stamp = 0.1,
                   .seams = &seams,
                   .sensor = sensor_,
                   .motions = motions_});
  }
  [[nodiscard]] std::filesystem::path map() const { return folder_.path() / "map"; }
  static MapReadOptions toGoOn() {
    MapReadOptions options;
    options.to_go_on = true;
    return options;
  }
  /// The same file with other bytes, and a manifest that vouches for them.
  void forgeSeams(const std::string& text) const {
    Manifest manifest = readManifest(map());
    manifest.seams = FileRecord{manifest.seams->path, text.size(), sha256Hex(text)};
    test::writeText(map() / manifest.seams->path, text);
    test::writeText(map() / "hierarchy.yaml", toYaml(manifest));
  }

  test::Rng rng_{21};
  test::TemporaryFolder folder_;
  MapHierarchy hierarchy_ = test::randomHierarchy(rng_, 5);
  SeamVotes seams_ = randomSeams(rng_);
  const NodeId waits_ = hierarchy_.add(labels::object, test::randomNodeMap(rng_, 0.002), Pose(), kRootId);
  const NodeId let_in_ = hierarchy_.add(labels::object, test::randomNodeMap(rng_, 0.002), Pose(), kRootId);
  const StillSensor sensor_{test::randomPose(rng_, 1.0), 2};
  const MotionsTaken motions_{3, 0.1, 1, "told"};
};

TEST_F(RunState, ComesBackToARunThatGoesOn) {
  const StoredMap back = readMap(map(), toGoOn());
  EXPECT_EQ(back.hierarchy.ids(), hierarchy_.ids());
  EXPECT_EQ(back.hierarchy.node(waits_).confirmation, hierarchy_.node(waits_).confirmation);
  EXPECT_EQ(back.hierarchy.node(let_in_).confirmation, hierarchy_.node(let_in_).confirmation.heldBack())
      << "the end of the log let it in";
  EXPECT_EQ(back.seams, seams_);
  EXPECT_EQ(back.manifest.motions, motions_);
  EXPECT_EQ(back.manifest.input, "\"a\\log\"\n\x01\x7f\xc3\xa4");
  ASSERT_TRUE(back.manifest.sensor);
  EXPECT_TRUE(back.manifest.sensor->isAt(sensor_.world_T_sensor));
  EXPECT_EQ(back.manifest.sensor->since_scan, sensor_.since_scan);
}

TEST_F(RunState, IsNoPartOfTheMapOtherwise) {
  const StoredMap back = readMap(map());
  EXPECT_FALSE(back.hierarchy.contains(waits_));
  EXPECT_TRUE(back.hierarchy.contains(let_in_));
  EXPECT_TRUE(back.seams.all().empty());
}

TEST_F(RunState, AnEditKeepsItByteForByte) {
  MapReadOptions options;
  options.to_edit = true;
  const StoredMap back = readMap(map(), options);
  const auto before = test::contents(map());
  {
    MapDirectory writer(map(), test::mapOptions(MapOpenMode::resume));
    commit(writer, back.hierarchy, back.seams);
  }
  EXPECT_EQ(test::contents(map()), before);
  EXPECT_TRUE(checkMap(map()).damage.empty());
}

TEST_F(RunState, DamagedVotesAreRefusedWithTheirLine) {
  const std::string good = test::readText(map() / readManifest(map()).seams->path);
  const std::size_t row = good.find('\n') + 1;
  const auto with = [&](const std::string& cells) {
    return good.substr(0, row) + cells + std::string(SeamVotes::kDirections - 1, ',') + "\n";
  };
  forgeSeams(with("1,2,3,1,"));
  EXPECT_NO_THROW(static_cast<void>(readMap(map(), toGoOn())));
  for (const std::string& bad :
       {good.substr(0, good.size() - 1), good.substr(0, row + 5), with("1,,3,1,"), with("1,2,x,1,"),
        with("1,2,3,2,"), with("1,2,3,1,40000"), with("1,2,3,1,-40000"), with("1,2,3,1,99999999999"),
        with("1,2,3,1,1;"), "x" + good, std::string()}) {
    forgeSeams(bad);
    try {
      static_cast<void>(readMap(map(), toGoOn()));
      FAIL() << bad.substr(0, 100);
    } catch (const MapError& error) {
      EXPECT_NE(std::string(error.what()).find("seams-"), std::string::npos) << error.what();
    }
  }
}

TEST_F(RunState, ADamagedNodeCanBeLeftOut) {
  const FileRecord file = readManifest(map()).nodes.at(1).ot;
  std::filesystem::resize_file(map() / file.path, file.bytes - 1);
  EXPECT_THROW(static_cast<void>(readMap(map())), MapError);
  std::vector<Damage> damage;
  MapReadOptions options;
  options.damage = &damage;
  const StoredMap rest = readMap(map(), options);
  ASSERT_EQ(damage.size(), 1U);
  EXPECT_EQ(damage[0].path, file.path);
  EXPECT_EQ(rest.hierarchy.ids().size(), hierarchy_.ids().size() - 1) << "without the one that waits";
}

}  // namespace
}  // namespace hoctomap
