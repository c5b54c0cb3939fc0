// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/Sha256.h"

#include <gtest/gtest.h>

namespace hoctomap {
namespace {

// The examples of FIPS 180-4.
TEST(Sha256, KnownHashes) {
  EXPECT_EQ(sha256Hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256Hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Sha256, PiecesGiveTheHashOfTheWhole) {
  Sha256 pieces;
  pieces.add("a");
  EXPECT_EQ(pieces.hex(), sha256Hex("a"));
  const Sha256 fork = pieces.copy();
  pieces.add("bc");
  EXPECT_EQ(pieces.hex(), sha256Hex("abc"));
  EXPECT_EQ(fork.hex(), sha256Hex("a"));
}

}  // namespace
}  // namespace hoctomap
