// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/OctreeFile.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <sstream>

#include "hoctomap/geometry/Errors.h"
#include "random_map.h"

namespace hoctomap {
namespace {

std::string otHeader(std::uint64_t size) {
  return "# Octomap OcTree file\nid OcTree\nsize " + std::to_string(size) + "\nres 0.05\ndata\n";
}

std::string otNode(float log_odds, int children) {
  std::string bytes(sizeof log_odds, '\0');
  std::memcpy(bytes.data(), &log_odds, sizeof log_odds);
  return bytes + static_cast<char>(children);
}

class OctreeFile : public ::testing::Test {
 protected:
  test::Rng rng_{7};
  NodeMap map_ = test::randomNodeMap(rng_, 0.1 / 48.0);
  const octomap::OcTree& tree_ = map_.tree();
};

TEST_F(OctreeFile, ReadsBackBitForBit) {
  const std::string bytes = otBytes(tree_);
  const auto back = parseOt(bytes, tree_.getResolution(), "x.ot");
  EXPECT_EQ(back->getResolution(), tree_.getResolution());  // the header has six digits only
  EXPECT_TRUE(*back == tree_);
  EXPECT_EQ(otBytes(*back), bytes);
}

TEST_F(OctreeFile, StockReadsBoth) {
  std::istringstream ot(otBytes(tree_));
  const std::unique_ptr<octomap::AbstractOcTree> read(octomap::AbstractOcTree::read(ot));
  ASSERT_NE(dynamic_cast<octomap::OcTree*>(read.get()), nullptr);
  EXPECT_EQ(read->size(), tree_.size());

  std::istringstream bt(btBytes(tree_));
  octomap::OcTree likely(1.0);
  ASSERT_TRUE(likely.readBinary(bt));
  for (auto leaf = tree_.begin_leafs(); leaf != tree_.end_leafs(); ++leaf) {
    const auto* other = likely.search(leaf.getCoordinate());
    ASSERT_NE(other, nullptr);
    EXPECT_EQ(likely.isNodeOccupied(other), tree_.isNodeOccupied(*leaf));
  }
}

void expectBytesOfStock(const octomap::OcTree& tree, const std::string& what) {
  std::ostringstream ot;
  tree.write(ot);
  EXPECT_EQ(otBytes(tree), ot.str()) << what;
  octomap::OcTree copy(tree);
  std::ostringstream bt;
  copy.writeBinary(bt);
  EXPECT_EQ(btBytes(tree), bt.str()) << what;
}

TEST_F(OctreeFile, BothHaveTheBytesOfStock) {
  expectBytesOfStock(tree_, "a map");
  for (std::uint64_t seed = 1; seed <= 30;
       ++seed) {  // blocks of one value and of several, by any order of updates
    test::Rng rng(seed);
    octomap::OcTree tree(0.1);
    for (int block = 0; block < 6; ++block) {
      const int edge = 1 << static_cast<int>(rng() % 5);
      octomap::OcTreeKey first;
      for (unsigned axis = 0; axis < 3; ++axis)
        first[axis] = static_cast<octomap::key_type>(32768 + edge * static_cast<int>(rng() % 4));
      const bool lazy = static_cast<int>(rng() % 2) == 0;
      for (int i = 0; i < edge * edge * edge; ++i) {
        const octomap::OcTreeKey key(static_cast<octomap::key_type>(first[0] + i / (edge * edge)),
                                     static_cast<octomap::key_type>(first[1] + i / edge % edge),
                                     static_cast<octomap::key_type>(first[2] + i % edge));
        // Values that differ, of one side of the threshold: they are one in a `.bt` only.
        tree.updateNode(key, static_cast<float>((block % 2 == 0 ? 0.9 : -0.9) * test::uniform(rng, 0.5, 1.0)),
                        lazy);
      }
    }
    tree.updateInnerOccupancy();
    expectBytesOfStock(tree, "seed " + std::to_string(seed));
    tree.prune();
    expectBytesOfStock(tree, "pruned, seed " + std::to_string(seed));
    tree.expand();
    expectBytesOfStock(tree, "expanded, seed " + std::to_string(seed));
  }
}

TEST_F(OctreeFile, StockPrunesNothingAboveALevelWithoutAnythingToPrune) {
  octomap::OcTree tree(0.1);
  for (unsigned i = 0; i < 8; ++i) {  // eight leaves two levels up, of values that only a `.bt` makes one
    for (unsigned j = 0; j < 64; ++j) {
      const auto at = [&](unsigned axis) {
        return static_cast<octomap::key_type>(32768 + 4 * (i >> axis & 1U) + (j >> (2 * axis) & 3U));
      };
      tree.updateNode(octomap::OcTreeKey(at(0), at(1), at(2)), 0.5F + 0.1F * static_cast<float>(i));
    }
  }
  ASSERT_EQ(tree.getNumLeafNodes(), 8U);
  expectBytesOfStock(tree, "eight leaves");
}

TEST_F(OctreeFile, WritingBtLeavesTheTree) {
  const std::string before = otBytes(tree_);
  checkBt(btBytes(tree_), "x.bt");
  EXPECT_EQ(otBytes(tree_), before);
}

TEST_F(OctreeFile, EmptyTree) {
  const octomap::OcTree empty(0.05);
  checkOt(otBytes(empty), "x.ot");
  checkBt(btBytes(empty), "x.bt");
  EXPECT_EQ(parseOt(otBytes(empty), 0.05, "x.ot")->size(), 0U);
}

TEST_F(OctreeFile, EveryCutIsRefused) {
  const std::string ot = otBytes(tree_);
  const std::string bt = btBytes(tree_);
  for (std::size_t size = 0; size < ot.size(); size += 1 + ot.size() / 997) {
    EXPECT_THROW(checkOt(std::string_view(ot).substr(0, size), "x.ot"), MapError) << size;
  }
  for (std::size_t size = 0; size < bt.size(); size += 1 + bt.size() / 997) {
    EXPECT_THROW(checkBt(std::string_view(bt).substr(0, size), "x.bt"), MapError) << size;
  }
  EXPECT_THROW(checkOt(ot + '\0', "x.ot"), MapError);
  EXPECT_THROW(checkBt(bt + '\0', "x.bt"), MapError);
}

TEST_F(OctreeFile, NestedChainsAreRefused) {
  std::string ot = otHeader(200'000);
  std::string bt = "# Octomap OcTree binary file\nid OcTree\nsize 200000\nres 0.05\ndata\n";
  for (int i = 0; i < 200'000; ++i) {
    ot += otNode(1.0F, 1);
    bt += std::string("\x03\x00", 2);
  }
  EXPECT_THROW(checkOt(ot, "x.ot"), MapError);
  EXPECT_THROW(checkBt(bt, "x.bt"), MapError);
}

TEST_F(OctreeFile, DepthOfSixteenIsTheLimit) {
  const auto chain = [](std::uint64_t inner) {
    std::string ot = otHeader(inner + 1);
    for (std::uint64_t i = 0; i < inner; ++i) ot += otNode(1.0F, 128);
    return ot + otNode(1.0F, 0);
  };
  EXPECT_NO_THROW(checkOt(chain(16), "x.ot"));
  EXPECT_THROW(checkOt(chain(17), "x.ot"), MapError);
}

TEST_F(OctreeFile, LogOddsMustBeFinite) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity()}) {
    EXPECT_THROW(checkOt(otHeader(1) + otNode(bad, 0), "x.ot"), MapError);
  }
  EXPECT_NO_THROW(checkOt(otHeader(1) + otNode(-2.0F, 0), "x.ot"));
}

TEST_F(OctreeFile, HeaderIsStrict) {
  const std::string node = otNode(1.0F, 0);
  const auto refused = [&](const std::string& header) {
    EXPECT_THROW(checkOt(header + node, "x.ot"), MapError) << header;
  };
  refused("# OcTree\nid OcTree\nsize 1\nres 0.05\ndata\n");
  refused("# Octomap OcTree file\nid ColorOcTree\nsize 1\nres 0.05\ndata\n");
  refused("# Octomap OcTree file\nid OcTree\nsize 2\nres 0.05\ndata\n");
  refused("# Octomap OcTree file\nid OcTree\nsize -1\nres 0.05\ndata\n");
  refused("# Octomap OcTree file\nid OcTree\nsize 1\nsize 1\nres 0.05\ndata\n");
  for (const char* res : {"0", "-1", "nan", "inf", "0.05x", "1e999"}) {
    refused("# Octomap OcTree file\nid OcTree\nsize 1\nres " + std::string(res) + "\ndata\n");
  }
  refused("# Octomap OcTree file\nid OcTree\nres 0.05\ndata\n");
  refused("# Octomap OcTree file\nid OcTree\nsize 1\nres 0.05\nwhat 1\ndata\n");
  refused("# Octomap OcTree file\nid OcTree\nid OcTree\nsize 1\nres 0.05\ndata\n");
  refused("# Octomap OcTree file\nid OcTree\nsize 1\nres 0.05\nres 0.05\ndata\n");
  refused("# Octomap OcTree file\nid OcTree\nsize 1\ndata\n");
  refused("# Octomap OcTree file\nid OcTree\nsize 1\nres 0.05\ndata\n" + otNode(1.0F, 1));  // holds two
  refused("# Octomap OcTree file\n" + std::string(1'000'000, 'x'));
}

TEST_F(OctreeFile, AnotherResolutionIsRefused) {
  EXPECT_THROW(static_cast<void>(parseOt(otBytes(tree_), 0.002, "x.ot")), MapError);
}

}  // namespace
}  // namespace hoctomap
