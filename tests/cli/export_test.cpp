// SPDX-License-Identifier: BSD-3-Clause
// `hoctomap export`: every format is opened by software that is not ours.
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <gtest/gtest.h>
#include <octomap/MapCollection.h>
#include <octomap/MapNode.h>

#include <assimp/Importer.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "TableLogs.h"
#include "hoctomap/io/MapReader.h"

namespace hoctomap {
namespace {

using test::TemporaryFolder;

/// A map of the demo scene: a background, a table, three objects. Made once.
class Export : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    test::simulate("demo", *folder_ / "a.rawlog");
    test::build(*folder_ / "a.rawlog", *folder_ / "map");
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::string map() { return *folder_ / "map"; }
  static std::string out(const std::string& name) { return *folder_ / name; }
  static void run(const std::string& format, const std::string& name,
                  const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"export", map(), "--format", format, "-o", out(name)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto outcome = test::hoctomap(arguments);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  static std::vector<test::MappedNode> nodes() {
    std::vector<test::MappedNode> all;
    for (const char* label : {"background", "table", "object"}) {
      for (auto& node : test::nodesOf(map(), label)) all.push_back(std::move(node));
    }
    return all;
  }

  static std::unique_ptr<TemporaryFolder> folder_;
};

std::unique_ptr<TemporaryFolder> Export::folder_;

/// Where OctoMap's collection looks for a point: the voxel's centre, a hair aside so that rounding of poses
/// does not matter.
octomap::point3d octoPoint(const Eigen::Vector3f& p) {
  return {p.x(), p.y(), p.z()};
}

TEST_F(Export, StockMapCollectionAnswersAcrossNodes) {
  run("mapcollection", "collection");
  using Collection = octomap::MapCollection<octomap::MapNode<octomap::OcTree>>;
  Collection collection(out("collection/mapcollection.txt"));
  EXPECT_EQ(collection.size(), 5U);
  EXPECT_FALSE(collection.isOccupied(0.0F, 0.0F, 8.0F));
  for (const auto& node : nodes()) {
    std::size_t occupied = 0;
    for (const auto& voxel : node.world_voxels) occupied += collection.isOccupied(octoPoint(voxel)) ? 1U : 0U;
    EXPECT_EQ(occupied, node.world_voxels.size()) << node.record.id.value;
    if (node.record.label != labels::object) continue;
    // A ray from above onto the object ends on it, although table and background lie behind.
    octomap::point3d end;
    const Eigen::Vector3f top = node.world_voxels.front() + Eigen::Vector3f(0.F, 0.F, 0.3F);
    testing::internal::CaptureStdout();  // OctoMap tells of every ray
    const bool hit = collection.castRay(octoPoint(top), {0.F, 0.F, -1.F}, end, true, 2.0);
    testing::internal::GetCapturedStdout();
    ASSERT_TRUE(hit);
    const auto near = std::any_of(node.world_voxels.begin(), node.world_voxels.end(), [&](const auto& voxel) {
      return (voxel - Eigen::Vector3f(end.x(), end.y(), end.z())).norm() < 2.0 * node.record.resolution;
    });
    EXPECT_TRUE(near) << node.record.id.value;
  }
}

TEST_F(Export, OneTreeOfTheWholeHierarchy) {
  run("ot", "merged.ot", {"--merged", "--resolution", "0.02"});
  run("bt", "merged.bt", {"--merged", "--resolution", "0.02"});
  const auto converted = test::runProgram("convert_octree", {out("merged.ot"), out("converted.bt")});
  EXPECT_EQ(converted.exit_code, 0) << converted.err;
  octomap::OcTree tree(0.5);
  ASSERT_TRUE(tree.readBinary(out("merged.bt")));
  EXPECT_DOUBLE_EQ(tree.getResolution(), 0.02);
  EXPECT_EQ(test::readFile(out("merged.bt")), test::readFile(out("converted.bt")))
      << "the tool says the same";
  for (const auto& node : nodes()) {
    if (node.record.label != labels::object) continue;
    for (const auto& voxel : node.world_voxels) {
      const auto* leaf = tree.search(octoPoint(voxel));
      ASSERT_NE(leaf, nullptr);
      EXPECT_TRUE(tree.isNodeOccupied(leaf));
    }
  }
  run("bt", "one.bt", {"--node", "1"});
  octomap::OcTree one(0.5);
  ASSERT_TRUE(one.readBinary(out("one.bt")));
  EXPECT_EQ(one.getResolution(), nodes()[1].record.resolution);
}

/// The rows of a PCD text that PCL has written, by the names of its fields.
std::vector<std::map<std::string, double>> pcdRows(const std::string& text) {
  std::vector<std::string> fields;
  std::vector<std::map<std::string, double>> rows;
  std::istringstream lines(text);
  bool data = false;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    if (line.rfind("FIELDS ", 0) == 0) {
      std::string word;
      words >> word;
      while (words >> word) fields.push_back(word);
    } else if (data) {
      auto& row = rows.emplace_back();
      for (const auto& field : fields) words >> row[field];
    }
    data = data || line.rfind("DATA ascii", 0) == 0;
  }
  return rows;
}

TEST_F(Export, PclsToolsReadPointsWithLabelNodeAndProbability) {
  run("pcd", "voxels.pcd");
  run("ply", "voxels.ply");
  const auto text =
      test::runProgram("pcl_convert_pcd_ascii_binary", {out("voxels.pcd"), out("text.pcd"), "0"});
  if (text.exit_code == 127) GTEST_SKIP() << "pcl-tools is not installed";
  ASSERT_EQ(text.exit_code, 0) << text.err;
  ASSERT_EQ(test::runProgram("pcl_ply2pcd", {"-format", "0", out("voxels.ply"), out("ply.pcd")}).exit_code,
            0);
  const auto pcd = pcdRows(test::readFile(out("text.pcd")));
  const auto ply = pcdRows(test::readFile(out("ply.pcd")));
  std::map<double, std::vector<Eigen::Vector3f>> points;
  ASSERT_EQ(ply.size(), pcd.size());
  for (std::size_t i = 0; i < pcd.size(); ++i) {
    const auto& row = pcd[i];
    points[row.at("node")].emplace_back(row.at("x"), row.at("y"), row.at("z"));
    EXPECT_GE(row.at("probability"), 0.5);
    EXPECT_LE(row.at("probability"), 0.98);
    for (const char* field : {"x", "y", "z", "label", "node", "probability"})
      ASSERT_NEAR(ply[i].at(field), row.at(field), 1e-5) << field;
  }
  const std::map<std::string, double> numbers{{"background", 0}, {"object", 1}, {"table", 2}};
  for (const auto& node : nodes()) {
    const auto& got = points[node.record.id.value];
    ASSERT_EQ(got.size(), node.world_voxels.size());
    for (std::size_t i = 0; i < got.size(); ++i) EXPECT_LT((got[i] - node.world_voxels[i]).norm(), 1e-4);
    const auto first = std::find_if(pcd.begin(), pcd.end(),
                                    [&](const auto& row) { return row.at("node") == node.record.id.value; });
    EXPECT_EQ(first->at("label"), numbers.at(node.record.label.name));
  }
  EXPECT_NE(test::readFile(out("voxels.ply")).find("comment label 1 object\n"), std::string::npos);
}

/// Volume, centroid times volume and area of a closed surface, in the world of the file.
struct Solid {
  double volume = 0.0;
  double area = 0.0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};

void collect(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent,
             std::map<std::string, Solid>& solids) {
  const aiMatrix4x4 world = parent * node.mTransformation;
  for (unsigned m = 0; m < node.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[m]];
    Solid& solid = solids[node.mName.C_Str()];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      std::array<Eigen::Vector3d, 3> p;
      for (unsigned c = 0; c < 3; ++c) {
        const aiVector3D v = world * mesh.mVertices[mesh.mFaces[f].mIndices[c]];
        p[c] = {v.x, -v.z, v.y};  // y up to z up
      }
      const double volume = p[0].dot(p[1].cross(p[2])) / 6.0;
      solid.volume += volume;
      solid.moment += volume * (p[0] + p[1] + p[2]) / 4.0;
      solid.area += 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
    }
  }
  for (unsigned c = 0; c < node.mNumChildren; ++c) collect(scene, *node.mChildren[c], world, solids);
}

TEST_F(Export, GlbHasTheSurfaceOfEveryNodeAtItsPlace) {
  run("glb", "map.glb");
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(out("map.glb"), 0);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  std::map<std::string, Solid> solids;
  collect(*scene, *scene->mRootNode, aiMatrix4x4(), solids);
  EXPECT_EQ(solids.size(), 5U);
  const StoredMap stored = readMap(map());
  for (const auto& node : nodes()) {
    const std::string name = node.record.label.name + " " + std::to_string(node.record.id.value);
    ASSERT_TRUE(solids.contains(name)) << name;
    const Solid& solid = solids.at(name);
    const double r = node.record.resolution;
    const double volume = std::pow(r, 3) * static_cast<double>(node.world_voxels.size());
    EXPECT_NEAR(solid.volume, volume, 1e-3 * volume) << name;
    EXPECT_LT((solid.moment / solid.volume - node.centroid).norm(), 1e-3) << name;
    // Faces between a voxel that is occupied and one that is not: the surface, and no face inside.
    const octomap::OcTree& tree = stored.hierarchy.node(node.record.id).map().tree();
    std::size_t faces = 0;
    for (const auto& voxel : stored.hierarchy.node(node.record.id).map().occupiedVoxels()) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-r, r}) {
          Eigen::Vector3d beside = voxel.cast<double>();
          beside[axis] += side;
          const auto* leaf = tree.search(beside.x(), beside.y(), beside.z());
          faces += leaf == nullptr || !tree.isNodeOccupied(leaf) ? 1U : 0U;
        }
      }
    }
    EXPECT_NEAR(solid.area, r * r * static_cast<double>(faces), 1e-3 * solid.area) << name;
  }
}

TEST_F(Export, TheKhronosValidatorFindsNothingInTheGlb) {
  if (!std::filesystem::exists(HOCTOMAP_GLTF "/node_modules/gltf-validator"))
    GTEST_SKIP() << "gltf-validator is not installed (scripts/install_dependencies.sh)";
  run("glb", "valid.glb");
  const auto outcome = test::runProgram("node", {HOCTOMAP_GLTF "/validate.js", out("valid.glb")});
  if (outcome.exit_code == 127) GTEST_SKIP() << "node is not installed";
  const auto report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["issues"]["messages"].size(), 0U) << report["issues"].dump(1);
  EXPECT_EQ(report["info"]["drawCallCount"], 5);
}

TEST_F(Export, SceneViewer3DShowsTheScene) {
  run("3dscene", "map.3Dscene");
  EXPECT_EQ(test::readFile(out("map.3Dscene")), test::readFile(map() + "/hierarchy.3Dscene"))
      << "as build writes it";
  const auto outcome = test::runProgram("python3", {HOCTOMAP_LOOK_AT_SCENE, out("map.3Dscene")});
  if (outcome.exit_code == 77) GTEST_SKIP() << "Xvfb or SceneViewer3D is not installed";
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
}

TEST_F(Export, ATableOfObjects) {
  run("csv", "objects.csv");
  const auto rows = test::parseCsv(test::readFile(out("objects.csv")));
  ASSERT_EQ(rows.size(), 4U) << "a table and three objects";
  for (const auto& node : nodes()) {
    if (!node.record.parent) continue;
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& r) {
      return r.at("node") == std::to_string(node.record.id.value);
    });
    ASSERT_NE(row, rows.end());
    const auto number = [&](const std::string& key) { return std::stod(row->at(key)); };
    EXPECT_EQ(row->at("label"), node.record.label.name);
    EXPECT_NEAR(number("existence"), node.record.existence, 1e-9);
    EXPECT_NEAR(number("volume"),
                std::pow(node.record.resolution, 3) * static_cast<double>(node.world_voxels.size()), 1e-12);
    const Pose pose(number("x"), number("y"), number("z"), number("yaw") * M_PI / 180.0,
                    number("pitch") * M_PI / 180.0, number("roll") * M_PI / 180.0);
    EXPECT_LT((toIsometry(pose).matrix() - toIsometry(node.record.world_T_node).matrix()).norm(), 1e-9);
    // Every voxel lies in the box, which is turned as the node.
    const Eigen::Vector3d center(number("box_x"), number("box_y"), number("box_z"));
    const Eigen::Vector3d half = 0.5 * Eigen::Vector3d(number("size_x"), number("size_y"), number("size_z"));
    for (const auto& voxel : node.world_voxels) {
      const Eigen::Vector3d in_box = toIsometry(pose).linear().transpose() * (voxel.cast<double>() - center);
      EXPECT_TRUE((in_box.cwiseAbs().array() <= half.array()).all());
    }
  }
}

TEST_F(Export, OfADamagedMapWhatIsIntact) {
  std::filesystem::copy(map(), out("damaged"), std::filesystem::copy_options::recursive);
  const auto table = test::nodesOf(map(), "table").at(0).record;
  test::writeFile(out("damaged/" + table.ot.path), "no octree");
  for (const std::string format : {"ply", "pcd", "glb", "3dscene", "mapcollection"}) {
    const auto outcome =
        test::hoctomap({"export", out("damaged"), "--format", format, "-o", out("rest." + format)});
    EXPECT_EQ(outcome.exit_code, 4) << format;
    EXPECT_NE(outcome.out.find("exported 4 nodes"), std::string::npos) << outcome.out;
    EXPECT_TRUE(std::filesystem::exists(out("rest." + format))) << format;
  }
  octomap::MapCollection<octomap::MapNode<octomap::OcTree>> rest(out("rest.mapcollection/mapcollection.txt"));
  EXPECT_EQ(rest.size(), 4U);
}

TEST_F(Export, WrongUseIsExit2OrNamesTheNode) {
  const auto exitOf = [](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"export", map(), "-o", out("never")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::hoctomap(arguments).exit_code;
  };
  EXPECT_EQ(exitOf({"--format", "glb", "--node", "1"}), 2);
  EXPECT_EQ(exitOf({"--format", "ply", "--merged"}), 2);
  EXPECT_EQ(exitOf({"--format", "bt", "--resolution", "0.01"}), 2);
  EXPECT_EQ(exitOf({"--format", "bt", "--merged", "--resolution", "0"}), 2);
  EXPECT_EQ(exitOf({"--format", "bt", "--merged", "--resolution", "0.0001"}), 6);
  EXPECT_EQ(exitOf({"--format", "stl"}), 2);
  EXPECT_EQ(exitOf({"--format", "bt", "--node", "99"}), 4);
  EXPECT_FALSE(std::filesystem::exists(out("never")));
}

}  // namespace
}  // namespace hoctomap
