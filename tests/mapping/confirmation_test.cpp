// SPDX-License-Identifier: BSD-3-Clause
// Nodes wait until a second view confirms them (docs/decisions/0022).
#include <gtest/gtest.h>

#include "ScriptedMapper.h"

namespace hoctomap {
namespace {

using namespace test;  // the words of ScriptedMapper.h

const NodeId kCupNode{2};

MappingConfig confirmedBy(std::uint64_t scans) {
  MappingConfig config;
  config.confirm_scans = scans;
  return config;
}

std::size_t objectEvents(const UpdateReport& report) {
  return static_cast<std::size_t>(std::count_if(report.events.begin(), report.events.end(),
                                                [](const auto& e) { return e.label == labels::object; }));
}

TEST(Confirmation, ASecondViewLetsTheNodeInWithAllThatWasMeasured) {
  Mapper waiting(confirmedBy(2));
  Mapper at_once(confirmedBy(1));
  (*waiting.evidence)[kCupNode] = (*at_once.evidence)[kCupNode] = seen(true);
  const UpdateReport first = waiting.integrate(Scan(0, {kFloor, kTable, kCup}));
  EXPECT_EQ(objectEvents(first), 0U);
  EXPECT_TRUE(waiting.h().node(kCupNode).confirmation.waits);
  const UpdateReport second = waiting.integrate(Scan(1, {kFloor, kTable, kCup}));
  ASSERT_EQ(objectEvents(second), 1U);
  const auto created = std::find_if(second.events.begin(), second.events.end(),
                                    [](const auto& e) { return e.kind == NodeEventKind::created; });
  ASSERT_NE(created, second.events.end());
  EXPECT_EQ(created->node, kCupNode);
  EXPECT_FALSE(waiting.h().node(kCupNode).confirmation.waits);
  EXPECT_TRUE(second.existence.empty() || std::none_of(second.existence.begin(), second.existence.end(),
                                                       [](const auto& row) { return row.node == kCupNode; }));
  at_once.integrate(Scan(0, {kFloor, kTable, kCup}));
  at_once.integrate(Scan(1, {kFloor, kTable, kCup}));
  EXPECT_EQ(otBytes(waiting.h().node(kCupNode).map()), otBytes(at_once.h().node(kCupNode).map()));
}

TEST(Confirmation, ARefutedNodeGoesWithoutAWord) {
  Mapper m(confirmedBy(2));
  m.integrate(Scan(0, {kFloor, kTable, kCup}));
  (*m.evidence)[kCupNode] = seen(false);
  for (std::uint64_t k = 1; k <= 4; ++k) {
    const UpdateReport report = m.integrate(Scan(k, {kFloor, kTable}));
    EXPECT_EQ(objectEvents(report), 0U);
    for (const auto& row : report.existence) EXPECT_NE(row.node, kCupNode);
  }
  EXPECT_FALSE(m.h().contains(kCupNode));
  EXPECT_TRUE(m.mapper.removed().empty());
  EXPECT_TRUE(m.mapper.finish(4, 104.0).events.empty());
}

TEST(Confirmation, ALogOfOneScanGivesItsObjects) {
  Mapper m(confirmedBy(2));
  m.integrate(Scan(0, {kFloor, kTable, kCup, kBox}));
  const UpdateReport end = m.mapper.finish(0, 100.0);
  EXPECT_EQ(count(end, NodeEventKind::created), 2U);
  EXPECT_EQ(end.scan, 0U);
  EXPECT_TRUE(m.h().node(kCupNode).confirmation.entered_at_end);
}

TEST(Confirmation, WhatMoreViewsPassOverThanShowDoesNotEnterAtTheEnd) {
  Mapper m(confirmedBy(2));
  m.integrate(Scan(0, {kFloor, kTable, kCup}));
  (*m.evidence)[kCupNode] = seen(true);  // beams end there, but no scan makes a segment of it
  for (std::uint64_t k = 1; k <= 2; ++k) m.integrate(Scan(k, {kFloor, kTable}));
  EXPECT_TRUE(m.mapper.finish(2, 102.0).events.empty());
  EXPECT_TRUE(m.h().node(kCupNode).confirmation.waits);
}

TEST(Confirmation, NorDoesWhatOtherViewsHaveInSightWithoutATraceOfIt) {
  for (const bool in_sight : {true, false}) {
    Mapper m(confirmedBy(2));
    m.integrate(Scan(0, {kFloor, kTable, kCup}));
    Evidence low;  // too near to the table for any beam to tell
    low.in_sight = in_sight;
    (*m.evidence)[kCupNode] = low;
    for (std::uint64_t k = 1; k <= 2; ++k) m.integrate(Scan(k, {kFloor, kTable}));
    EXPECT_EQ(m.mapper.finish(2, 102.0).events.empty(), in_sight);
  }
}

TEST(Confirmation, NothingHangsUnderANodeThatWaits) {
  Mapper m(confirmedBy(2));
  m.integrate(Scan(0, {kFloor, kTable, kCup, kBox}));
  m.integrate(Scan(1, {kFloor, kTable, kCup, kBox}));
  for (const NodeId id : m.h().ids()) {
    if (m.h().node(id).confirmation.waits) {
      EXPECT_TRUE(m.h().node(id).children().empty());
    }
  }
  EXPECT_EQ(m.h().node(kCupNode).parent(), NodeId{1});
}

}  // namespace
}  // namespace hoctomap
