// SPDX-License-Identifier: BSD-3-Clause
// `hoctomap query`: what it prints, and what it refuses.
#include <gtest/gtest.h>

#include <sstream>

#include "TableLogs.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/query/HierarchyQuery.h"

namespace hoctomap {
namespace {

class QueryCommand : public ::testing::Test {
 protected:
  QueryCommand() {
    test::simulate("demo", folder / "a.rawlog");
    test::build(folder / "a.rawlog", map);
  }
  /// Runs a query; fails the test unless the exit code is `expected`.
  test::Outcome query(std::vector<std::string> arguments, int expected = 0) {
    arguments.insert(arguments.begin(), {"query", map});
    auto outcome = test::hoctomap(arguments);
    EXPECT_EQ(outcome.exit_code, expected) << arguments[2] << ": " << outcome.out << outcome.err;
    if (expected != 0) {
      EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
    return outcome;
  }
  /// A voxel of an object, as the text of its world point.
  std::string objectPoint() {
    const auto objects = test::nodesOf(map, "object");
    const Eigen::Vector3f& p = objects.front().world_voxels.front();
    std::ostringstream text;
    text.precision(9);
    text << p.x() << "," << p.y() << "," << p.z();
    return text.str();
  }

  test::TemporaryFolder folder;
  const std::string map = folder / "map";
};

TEST_F(QueryCommand, SaysWhoseTheVoxelIs) {
  const std::string p = objectPoint();
  const std::string id = std::to_string(test::nodesOf(map, "object").front().record.id.value);
  const auto text = query({"--point", p});
  EXPECT_EQ(text.out.find("state          occupied\nnode           " + id + "\nlabel          object\n"), 0U)
      << text.out;
  const auto json = query({"--point", p, "--json"});
  EXPECT_NE(json.out.find(R"("state":"occupied","node":)" + id + ","), std::string::npos) << json.out;
  EXPECT_NE(query({"--sphere", p + ",0.01"}).out.find("collides       yes"), std::string::npos);
  EXPECT_NE(query({"--box", p + ",0.01,0.01,0.01,30"}).out.find("collides       yes"), std::string::npos);
  EXPECT_NE(query({"--distance", p}).out.find("distance       0.0000"), std::string::npos);
  EXPECT_NE(query({"--objects", p + ",0.1,0.1,0.1"}).out.find(" object "), std::string::npos);
  EXPECT_EQ(query({"--unknown", "50,50,50,1,1,1"}).out, "unknown_share  1.0000\n");
  EXPECT_EQ(query({"--point", "50,50,50"}).out, "state          unknown\nprobability    0.5000\n");
  const auto ray = query({"--ray", p + ",0,0,1", "--ignore-unknown"});
  EXPECT_EQ(ray.out.find("end            hit\ndistance       0.0000"), 0U) << ray.out;
}

TEST_F(QueryCommand, ABatchIsAnsweredLineByLine) {
  const MapHierarchy hierarchy = readMap(map).hierarchy;
  const HierarchyQuery oracle(hierarchy);
  std::ostringstream questions;
  std::vector<PointAnswer> expected;
  const Eigen::AlignedBox3d known = worldBounds(hierarchy.box(kRootId));
  test::TemporaryFolder other;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3d share(i % 17 / 17.0, i % 23 / 23.0, i % 29 / 29.0);
    const Eigen::Vector3d p = known.min() + share.cwiseProduct(known.sizes());
    questions.precision(17);
    questions << p.x() << "," << p.y() << "," << p.z() << (i % 7 == 0 ? "\r\n" : "\n");
    expected.push_back(oracle.at(p));
  }
  test::writeFile(folder / "points.csv", questions.str());
  const auto rows = test::parseCsv(query({"--batch", folder / "points.csv"}).out);
  ASSERT_EQ(rows.size(), expected.size());
  std::map<std::string, int> states;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ++states[rows[i].at("state")];
    EXPECT_EQ(rows[i].at("node"), expected[i].node ? std::to_string(expected[i].node->value) : "");
    EXPECT_NEAR(std::stod(rows[i].at("probability")), expected[i].probability, 1e-6);
  }
  EXPECT_EQ(states.size(), 3U) << "free, occupied and unknown";
}

TEST_F(QueryCommand, ABatchMayHaveAHeaderAndAnotherKind) {
  test::writeFile(folder / "q.csv", "cx,cy,cz,radius\n0,0,0.7,9\n\n50,50,50,1\n");
  const auto csv = query({"--batch", folder / "q.csv", "--kind", "sphere"});
  EXPECT_EQ(csv.out.substr(0, csv.out.find('\n')), "cx,cy,cz,radius,collides,node,label,existence");
  EXPECT_NE(csv.out.find("\n50,50,50,1,0,,,\n"), std::string::npos) << csv.out;
  EXPECT_NE(csv.out.find("\n0,0,0.7,9,1,"), std::string::npos) << csv.out;
  const auto json = query({"--batch", folder / "q.csv", "--kind", "sphere", "--json"});
  EXPECT_EQ(json.out.front(), '[');
  EXPECT_NE(json.out.find(R"({"question":"sphere","numbers":[50.0,50.0,50.0,1.0],"collides":false)"),
            std::string::npos)
      << json.out;
  EXPECT_EQ(query({"--batch", "-"}).out, "x,y,z,state,node,label,existence,probability\n");
}

TEST_F(QueryCommand, BadQuestionsAreExit2WithOneLine) {
  for (const auto& [option, value] :
       std::vector<std::pair<std::string, std::string>>{{"--point", "1,2"},
                                                        {"--point", "1,2,nan"},
                                                        {"--point", "1,2,1e400"},
                                                        {"--point", "a,b,c"},
                                                        {"--point", "1,,2"},
                                                        {"--ray", "0,0,0,0,0,0"},
                                                        {"--sphere", "0,0,0,-1"},
                                                        {"--box", "0,0,0,1,1,-1"},
                                                        {"--box", "0,0,0,1,1,1,1,1"},
                                                        {"--kind", "cone"}}) {
    query({option, value}, 2);
  }
  query({}, 2);
  query({"--point", "0,0,0", "--distance", "0,0,0"}, 2);
  query({"--point", "0,0,0", "--max-range", "-1"}, 2);
}

TEST_F(QueryCommand, BadLinesAreExit3NamingFileAndLine) {
  for (const auto& [text, why] : std::map<std::string, std::string>{{"1,2,3\n1,2\n", "line 2: 2 numbers"},
                                                                    {"x,y,z\n1,2,3\n1;2;3\n", "line 3: "},
                                                                    {"1,2,3\n\n1,2,inf\n", "line 3: "},
                                                                    {"1,5,2,5,3,5\n", "line 1: 6 numbers"}}) {
    test::writeFile(folder / "bad.csv", text);
    const auto outcome = query({"--batch", folder / "bad.csv"}, 3);
    EXPECT_NE(outcome.err.find("bad.csv " + why), std::string::npos) << outcome.err;
  }
  query({"--batch", folder / "missing.csv"}, 3);
  query({"--batch", folder / "map"}, 3);
}

TEST_F(QueryCommand, ADamagedNodeIsExit4WhereTheQuestionTouchesIt) {
  const std::string p = objectPoint();
  const auto victim = test::nodesOf(map, "object").front().record.ot.path;
  test::writeFile(folder / ("map/" + victim), "no octree");
  query({"--point", p}, 4);
  query({"--point", "50,50,50"});
  EXPECT_EQ(test::hoctomap({"query", folder / "nothing", "--point", "0,0,0"}).exit_code, 4);
}

}  // namespace
}  // namespace hoctomap
