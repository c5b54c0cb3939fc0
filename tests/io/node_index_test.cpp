// SPDX-License-Identifier: BSD-3-Clause
// Indexes with a right hash and wrong content, value by value: readers go by the manifest's text, `verify`
// names the index.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/MapCheck.h"
#include "hoctomap/io/MapDirectory.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/io/OpenMap.h"
#include "hoctomap/io/Sha256.h"
#include "random_map.h"

namespace hoctomap {
namespace {

// Where things are (docs/map-format.md): the first line, the size and the hash of the manifest's nodes, three
// counts, places.
constexpr std::size_t kVersion = 15;
constexpr std::size_t kCounts = 17 + 8 + 4 + 64;
constexpr std::size_t kPlaces = kCounts + 3 * 4;
constexpr std::size_t kDepth = kPlaces + 4;
constexpr std::size_t kResolution = kDepth + 8;
constexpr std::size_t kExistence = kResolution + 8;
constexpr std::size_t kPose = kExistence + 8;

template <class T>
void put(std::string& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// Where a number stands last: in the record of the last node.
std::size_t lastPlaceOf(const std::string& bytes, double value) {
  std::string pattern(sizeof value, '\0');
  put(pattern, 0, value);
  return bytes.rfind(pattern);
}

class NodeIndexTest : public ::testing::Test {
 protected:
  NodeIndexTest() {
    MapDirectory writer(map(), test::mapOptions(MapOpenMode::create));
    writer.commit({hierarchy_, {}, 4});
    manifest_ = readManifest(map());
    whole_ = test::readText(indexFile());
  }
  [[nodiscard]] std::filesystem::path map() const { return folder_.path() / "map"; }
  [[nodiscard]] std::filesystem::path indexFile() const { return map() / manifest_.index->path; }

  /// The map with a changed index and a manifest that vouches for it.
  void forge(const std::function<void(std::string&)>& change) {
    std::string bytes = whole_;
    change(bytes);
    ASSERT_NE(bytes, whole_);
    test::writeText(indexFile(), bytes);
    manifest_.index->bytes = bytes.size();
    manifest_.index->sha256 = sha256Hex(bytes);
    test::writeText(map() / "hierarchy.yaml", toYaml(manifest_));
  }
  void expectNamed(const std::string& word) const {
    const MapCheck check = checkMap(map());
    ASSERT_EQ(check.damage.size(), 1U) << word;
    EXPECT_EQ(check.damage[0].path, manifest_.index->path);
    EXPECT_NE(check.damage[0].what.find(word), std::string::npos) << check.damage[0].what;
  }
  /// Refused as a whole: who reads it falls back on the text.
  void expectLeftAlone(const std::function<void(std::string&)>& change, const std::string& word) {
    forge(change);
    EXPECT_EQ(toYaml(readManifest(map())), toYaml(manifest_)) << word;
    expectNamed(word);
  }

  test::Rng rng_{13};
  test::TemporaryFolder folder_;
  MapHierarchy hierarchy_ = test::randomHierarchy(rng_, 4);
  Manifest manifest_;
  std::string whole_;
};

TEST_F(NodeIndexTest, AHeadOrAPlaceThatIsImpossible) {
  const auto with = [](std::size_t at, auto value) {
    return [=](std::string& bytes) { put(bytes, at, value); };
  };
  expectLeftAlone(with(kVersion, '2'), "no index of nodes, or one of another version");
  expectLeftAlone(with(kCounts, std::uint32_t{100'001}), "too many nodes");
  expectLeftAlone(with(kPlaces, std::uint32_t{1000}), "not in order");
  expectLeftAlone(with(kResolution, 0.0), "has no place");
  expectLeftAlone(with(kResolution, std::nan("")), "not finite");
  expectLeftAlone(with(kPose, 2.0), "has no place");
}

TEST_F(NodeIndexTest, ARecordThatIsImpossible) {
  const NodeRecord& node = manifest_.nodes.back();
  const auto instead = [](double of, double value) {
    return [=](std::string& bytes) { put(bytes, lastPlaceOf(bytes, of), value); };
  };
  expectLeftAlone(instead(node.resolution, -1.0), "a resolution is not above 0");
  expectLeftAlone(instead(node.existence, 1.0), "an existence is not between 0 and 1");
  expectLeftAlone(instead(node.existence_log_odds, 0.0), "an existence is not that of its log-odds");
  expectLeftAlone(instead(node.box_half_extents.x(), -1.0), "a box has a negative extent");
  expectLeftAlone(instead(node.occupancy.prob_hit, 1.5), "a sensor model is impossible");
  expectLeftAlone(instead(node.occupancy.clamping_max, 0.01), "a sensor model is impossible");
  expectLeftAlone([&](std::string& bytes) { bytes[bytes.rfind(node.ot.path)] = '/'; }, "leads out of");
  expectLeftAlone([&](std::string& bytes) { bytes[bytes.rfind(node.bt.sha256)] = 'x'; }, "no SHA-256");
}

TEST_F(NodeIndexTest, APlaceWithTheRecordOfAnotherNode) {
  // A place ends with the beginning of its record; all of these nodes have voxels, hence places of one size.
  constexpr std::size_t kPlace = kPose - kPlaces + 12 * 8 + 2 * (1 + 6 * 8) + 2 * 8 + 8;
  const std::size_t of_second = kPlaces + 2 * kPlace - 8;
  for (const std::uint64_t record : {0U, 5U}) {
    forge([&](std::string& bytes) { put(bytes, of_second, record); });
    EXPECT_THROW(static_cast<void>(findNode(map(), NodeId{1})), MapError);
    expectNamed(record == 0 ? "record of another one" : "index-");
  }
}

TEST_F(NodeIndexTest, APlaceThatIsNotThatOfItsRecord) {
  for (const auto& lie : std::vector<std::function<void(std::string&)>>{
           [](std::string& bytes) { put(bytes, kDepth, std::uint64_t{3}); },
           [](std::string& bytes) { put(bytes, kResolution, 0.5); },
           [](std::string& bytes) { put(bytes, kExistence, 0.123); },
           [](std::string& bytes) { put(bytes, kPose + 3 * 8, 1.0); }}) {
    forge(lie);
    expectNamed("says something else than the manifest");
  }
}

TEST_F(NodeIndexTest, AManifestWithAWrongHashOfItselfIsNotReadByIts) {
  std::string text = test::readText(map() / "hierarchy.yaml");
  text.back() = ' ';
  test::writeText(map() / "hierarchy.yaml", text);
  EXPECT_THROW(static_cast<void>(findNode(map(), kRootId)), MapError);
  EXPECT_THROW(static_cast<void>(readManifest(map())), MapError);
}

TEST_F(NodeIndexTest, AMapNeedNotHaveOne) {
  manifest_.index.reset();
  test::writeText(map() / "hierarchy.yaml", toYaml(manifest_));
  EXPECT_TRUE(checkMap(map()).damage.empty());
  EXPECT_EQ(OpenMap(map()).places().size(), manifest_.nodes.size());
}

TEST_F(NodeIndexTest, OneLargerThanAnyManifestIsNotRead) {
  manifest_.index->bytes = std::uint64_t{1} << 29U;
  test::writeText(map() / "hierarchy.yaml", toYaml(manifest_));
  EXPECT_EQ(toYaml(readManifest(map())), toYaml(manifest_));
  EXPECT_EQ(OpenMap(map()).places().size(), manifest_.nodes.size());
  expectNamed("bytes, the manifest says");
}

/// Of a manifest beyond 16 MiB only the head is read, and its index is bound to the number of bytes that
/// follow.
TEST_F(NodeIndexTest, ALargeManifestIsKnownByItsHead) {
  const std::string text = test::readText(map() / "hierarchy.yaml");
  const std::string rest(std::size_t{1} << 24U, ' ');
  test::writeText(map() / "hierarchy.yaml", text.substr(text.find('\n') + 1) + "#" + rest + "\n");
  EXPECT_EQ(OpenMap(map()).places().size(), manifest_.nodes.size()) << "not of this text: read as a whole";
  forge([&](std::string& bytes) {
    put(bytes, kVersion + 2, std::uint64_t{text.size() - text.find("\nnodes:") - 1 + rest.size()});
  });
  const std::string forged = toYaml(manifest_);
  test::writeText(map() / "hierarchy.yaml", forged + rest);
  EXPECT_EQ(findNode(map(), NodeId{1}).node->ot, manifest_.find(NodeId{1})->ot);
}

}  // namespace
}  // namespace hoctomap
