// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/MapDescription.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "hoctomap/io/MapDirectory.h"
#include "hoctomap/io/MapReader.h"
#include "random_map.h"

namespace hoctomap {
namespace {

TEST(MapDescription, OneLineANode) {
  const test::TemporaryFolder folder;
  MapHierarchy hierarchy(labels::background, NodeMap(0.05, {}));
  const NodeId table = hierarchy.add(labels::table, NodeMap(0.01, {}), Pose(), kRootId);
  hierarchy.add(Label{"cup\x1b[31m"}, NodeMap(0.002, {}), Pose(), table);
  hierarchy.add(labels::object, NodeMap(0.002, {}), Pose(), kRootId);
  MapDirectory writer(folder.path() / "map", test::mapOptions(MapOpenMode::create));
  writer.commit({hierarchy, {}, 2});
  const std::string text = describeMap(readManifest(folder.path() / "map"));
  EXPECT_NE(text.find("\n0 background"), std::string::npos) << text;
  EXPECT_NE(text.find("\n├─ 1 table"), std::string::npos) << text;
  EXPECT_NE(text.find("\n│  └─ 2 cup\\x1b[31m"), std::string::npos) << text;
  EXPECT_NE(text.find("\n└─ 3 object"), std::string::npos) << text;
  EXPECT_NE(text.find("2.0 mm"), std::string::npos) << text;
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
}

TEST(MapDescription, JsonHasTheKeysOfTheManifest) {
  const test::TemporaryFolder folder;
  test::Rng rng(3);
  MapDirectory writer(folder.path() / "map", test::mapOptions(MapOpenMode::create));
  writer.commit({test::randomHierarchy(rng, 3), {}, 5});
  const std::string json = mapJson(readManifest(folder.path() / "map"));
  for (const char* key : {"\"format_version\": 1", "\"scans\": 5", "\"nodes\": [", "\"removed\": []",
                          "\"label\": \"background\"", "\"parent\": null", "\"obb\": {", "\"sha256\": \""}) {
    EXPECT_NE(json.find(key), std::string::npos) << key;
  }
}

}  // namespace
}  // namespace hoctomap
