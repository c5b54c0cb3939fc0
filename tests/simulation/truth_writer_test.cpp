// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/simulation/TruthWriter.h"

#include <gtest/gtest.h>
#include <png.h>

#include <fstream>
#include <map>
#include <sstream>

#include "SmallScenes.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap::test {
namespace {

/// Grey values of a 16-bit PNG; the size goes to `width` and `height`.
std::vector<std::uint16_t> readGrey16(const std::filesystem::path& path, int& width, int& height) {
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) return {};
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_read_png(png, info, PNG_TRANSFORM_SWAP_ENDIAN, nullptr);
  std::vector<std::uint16_t> values;
  if (png_get_bit_depth(png, info) == 16 && png_get_color_type(png, info) == PNG_COLOR_TYPE_GRAY) {
    width = static_cast<int>(png_get_image_width(png, info));
    height = static_cast<int>(png_get_image_height(png, info));
    for (int v = 0; v < height; ++v) {
      const auto* row = reinterpret_cast<const std::uint16_t*>(png_get_rows(png, info)[v]);
      values.insert(values.end(), row, row + width);
    }
  }
  png_destroy_read_struct(&png, &info, nullptr);
  std::fclose(file);
  return values;
}

using Row = std::map<std::string, std::string>;

std::vector<Row> readCsv(const std::filesystem::path& path) {
  const auto cells = [](const std::string& line) {
    std::vector<std::string> result(1);
    for (const char c : line)
      if (c == ',')
        result.emplace_back();
      else
        result.back() += c;
    return result;
  };
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  const auto header = cells(line);
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    const auto values = cells(line);
    EXPECT_EQ(values.size(), header.size()) << line;
    Row row;
    for (std::size_t i = 0; i < std::min(values.size(), header.size()); ++i) row[header[i]] = values[i];
    rows.push_back(row);
  }
  return rows;
}

class TruthWriterTest : public testing::Test {
 protected:
  TruthWriterTest() {
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = std::filesystem::path(testing::TempDir()) / ("hoctomap_truth_" + name);
  }
  ~TruthWriterTest() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::vector<SimulatedScan> writeTruth(const Simulation& simulation) {
    std::vector<SimulatedScan> scans;
    TruthWriter writer(folder_, simulation.scene);
    simulateScene(simulation, 1, [&](const SimulatedScan& scan) {
      writer.write(scan);
      scans.push_back(scan);
    });
    writer.finish();
    return scans;
  }

  std::filesystem::path folder_;
};

TEST_F(TruthWriterTest, ImagesHoldTheLabels) {
  const auto scans = writeTruth(tableSimulation());
  ASSERT_EQ(scans.size(), 3U);
  for (std::size_t k = 0; k < scans.size(); ++k) {
    int width = 0;
    int height = 0;
    EXPECT_EQ(readGrey16(folder_ / "labels" / ("00000" + std::to_string(k) + ".png"), width, height),
              scans[k].labels);
    EXPECT_EQ(width, 80);
    EXPECT_EQ(height, 60);
  }
}

TEST_F(TruthWriterTest, ObjectsAreNamed) {
  writeTruth(tableSimulation());
  std::map<std::string, std::string> names;
  for (const Row& row : readCsv(folder_ / "objects.csv")) names[row.at("value")] = row.at("object");
  const std::map<std::string, std::string> expected{
      {"0", ""}, {"1", ""}, {"10", "table"}, {"100", "box"}, {"101", "sphere"}};
  EXPECT_EQ(names, expected);
}

TEST_F(TruthWriterTest, PosesFollowTheScript) {
  Simulation simulation = tableSimulation();
  simulation.script = SceneScript({{.scan = 1, .action = SceneAction::vanish, .solid = "box"},
                                   {.scan = 2,
                                    .action = SceneAction::move,
                                    .solid = "table",
                                    .position = Eigen::Vector3d(1.5, 0.0, 0.0)}});
  const auto scans = writeTruth(simulation);
  const auto rows = readCsv(folder_ / "poses.csv");
  ASSERT_EQ(rows.size(), 9U);  // three scans of a table and two objects
  for (const Row& row : rows) {
    const auto k = std::stoul(row.at("scan"));
    const auto number = [&](const char* key) { return std::stod(row.at(key)); };
    const auto value = static_cast<std::uint16_t>(std::stoi(row.at("value")));
    EXPECT_EQ(std::stol(row.at("visible_pixels")),
              std::count(scans[k].labels.begin(), scans[k].labels.end(), value));
    if (row.at("object") == "box") {
      EXPECT_EQ(row.at("present"), k == 0 ? "1" : "0");
      EXPECT_NEAR(number("x"), k == 2 ? 1.6 : 1.1, 1e-6);
      EXPECT_NEAR(number("yaw"), 0.3 * 180.0 / 3.14159265358979, 1e-5);
      EXPECT_NEAR(number("hz"), 0.1, 1e-6);
      EXPECT_NEAR(number("bz"), 0.8, 1e-6);
    }
    if (row.at("object") == "sphere") {
      EXPECT_EQ(row.at("label"), "object");
      EXPECT_NEAR(number("cx"), k == 2 ? 1.4 : 0.9, 1e-5);
      EXPECT_NEAR(number("cz"), 0.76, 1e-5);
      EXPECT_NEAR(number("hy"), 0.06, 1e-5);
      // What was seen lies on the camera's side, and was carried along with the table.
      EXPECT_LT(number("sx"), number("cx"));
      EXPECT_GT(number("sx"), number("cx") - 0.06);
    }
  }
}

TEST_F(TruthWriterTest, AnUnseenObjectHasNoSeenCentroid) {
  Simulation simulation = tableSimulation();
  simulation.scene.setPresent(*simulation.scene.find("box"), false);
  writeTruth(simulation);
  for (const Row& row : readCsv(folder_ / "poses.csv"))
    if (row.at("object") == "box") {
      EXPECT_EQ(row.at("seen_voxels"), "0");
      EXPECT_EQ(row.at("sx"), "");
    }
}

TEST_F(TruthWriterTest, AFolderThatCannotBeMadeIsAFileError) {
  std::ofstream(folder_) << "a file where the folder should be";
  EXPECT_THROW(TruthWriter(folder_, tableScene().scene), FileError);
}

}  // namespace
}  // namespace hoctomap::test
