// SPDX-License-Identifier: BSD-3-Clause
// What is wrong with a configuration, and what the user is told.
#include <gtest/gtest.h>

#include <algorithm>

#include "Problems.h"
#include "hoctomap/config/Settings.h"

namespace hoctomap {
namespace {

using test::problemsOf;

std::string problems(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return problemsOf([&] { static_cast<void>(parseSettings(text, "f.ini", overrides)); });
}

struct Defect {
  const char* setting;  ///< as for --set
  const char* problem;
};

void expectDefects(const std::vector<Defect>& defects) {
  for (const Defect& defect : defects) {
    EXPECT_EQ(problemsOf([&] { static_cast<void>(loadSettings({}, {defect.setting})); }),
              std::string("--set: ") + defect.problem);
  }
}

TEST(SettingsDefects, Resolution) {
  expectDefects(
      {Defect{"label.object.resolution=12junk", "[label.object] resolution: \"12junk\" is not a number"},
       Defect{"label.object.resolution=0,002",
              "[label.object] resolution: \"0,002\" is not a number (the decimal sign is a point)"},
       Defect{"label.object.resolution=0",
              "[label.object] resolution: \"0\" is out of range: must be >= 0.0001 and <= 10"},
       Defect{"label.object.resolution=-0.01",
              "[label.object] resolution: \"-0.01\" is out of range: must be >= 0.0001 and <= 10"},
       Defect{"label.object.resolution=0.00009",
              "[label.object] resolution: \"0.00009\" is out of range: must be >= 0.0001 and <= 10"},
       Defect{"label.object.resolution=nan", "[label.object] resolution: \"nan\" is not a finite number"},
       Defect{"label.object.resolution=inf", "[label.object] resolution: \"inf\" is not a finite number"},
       Defect{"label.object.resolution=none", "[label.object] resolution: \"none\" is not a number"},
       Defect{"label.object.resolution=", "[label.object] resolution: has no value"}});
}

TEST(SettingsDefects, Occupancy) {
  expectDefects(
      {Defect{"label.table.prob_hit=0.5",
              "[label.table] prob_hit: \"0.5\" is out of range: must be > 0.5 and < 1"},
       Defect{"label.table.prob_hit=1",
              "[label.table] prob_hit: \"1\" is out of range: must be > 0.5 and < 1"},
       Defect{"label.table.prob_miss=0.5",
              "[label.table] prob_miss: \"0.5\" is out of range: must be > 0 and < 0.5"},
       Defect{"label.table.prob_miss=0",
              "[label.table] prob_miss: \"0\" is out of range: must be > 0 and < 0.5"},
       Defect{"label.table.clamping_max=1",
              "[label.table] clamping_max: \"1\" is out of range: must be > 0 and < 1"},
       Defect{"label.table.clamping_max=0.4",
              "[label.table] clamping_max: 0.4 must be at least occupancy_threshold, which is 0.5"},
       Defect{"label.table.occupancy_threshold=0.1",
              "[label.table] occupancy_threshold: 0.1 must be above clamping_min, which is 0.1192"}});
}

TEST(SettingsDefects, Ranges) {
  expectDefects(
      {Defect{"sensor.max_range=0", "[sensor] max_range: \"0\" is out of range: must be > 0"},
       Defect{"sensor.max_range=nan", "[sensor] max_range: \"nan\" is not a finite number"},
       Defect{"sensor.max_range=inf", "[sensor] max_range: \"inf\" is not a finite number"},
       Defect{"sensor.max_range=None", "[sensor] max_range: \"None\" is not a number"},
       Defect{"label.object.max_range=0", "[label.object] max_range: \"0\" is out of range: must be > 0"},
       Defect{"label.object.max_range=-1", "[label.object] max_range: \"-1\" is out of range: must be > 0"},
       Defect{"poses.max_gap=-0.1", "[poses] max_gap: \"-0.1\" is out of range: must be >= 0 and <= 3600"}});
}

TEST(SettingsDefects, Words) {
  expectDefects(
      {Defect{"label.table.frame=pac", "[label.table] frame: \"pac\" is none of world, pca"},
       Defect{"label.table.carve=all", "[label.table] carve: \"all\" is none of own, scan"},
       Defect{"label.table.existence=1", "[label.table] existence: \"1\" is none of false, true"},
       Defect{"segmentation.method=euklidean",
              "[segmentation] method: \"euklidean\" is none of euclidean, convex_patches"},
       Defect{"mapping.checkpoint_scans=0.5", "[mapping] checkpoint_scans: \"0.5\" is not a whole number"},
       Defect{"mapping.checkpoint_scans=0",
              "[mapping] checkpoint_scans: \"0\" is out of range: must be >= 1 and <= 1000000"}});
}

TEST(SettingsDefects, Names) {
  expectDefects(
      {Defect{"label.object.resolutoin=1",
              "[label.object] resolutoin: unknown key; did you mean resolution?"},
       Defect{"mapping.max_range=1",
              "[mapping] max_range: unknown key; did you mean [label.background] max_range?"},
       Defect{"lable.object.resolution=1", "[lable.object]: unknown section; did you mean [label.object]?"},
       Defect{"pose.max_gap=1", "[pose]: unknown section; did you mean [poses]?"},
       Defect{"label.a b.carve=own", "[label.a b]: a label is up to 64 letters, digits, _ and -"},
       Defect{"label..carve=own", "[label.]: a label is up to 64 letters, digits, _ and -"},
       Defect{"label.../x.carve=own", "[label.../x]: a label is up to 64 letters, digits, _ and -"}});
}

TEST(SettingsDefects, NumbersOutOfOrder) {
  const std::string sections = "[label.background]\n[label.table]\n[label.object]\n";
  EXPECT_EQ(problems(sections + "clamping_min = 0.98\nclamping_max = 0.1\noccupancy_threshold = 0.99\n"),
            "f.ini:5: [label.object] clamping_max: 0.1 must be above clamping_min, which is 0.98\n"
            "f.ini:6: [label.object] occupancy_threshold: 0.99 must be at most clamping_max, which is 0.1");
  EXPECT_EQ(problems(sections + "[segmentation]\ntable_height_min = 1\n"),
            "f.ini:5: [segmentation] table_height_min: 1 must be below table_height_max, which is 1");
  EXPECT_EQ(problems(sections + "[sensor]\nmin_range = 2\nmax_range = 1\n"),
            "f.ini:6: [sensor] max_range: 1 must be above min_range, which is 2");
  EXPECT_EQ(problems(sections + "[sensor]\nmin_range = 2\nmax_range = none\n"), "");
  EXPECT_EQ(problems(sections + "[existence]\nmax_beams = 5\n"),
            "f.ini:5: [existence] max_beams: 5 must be at least min_beams, which is 10");
  EXPECT_EQ(problems(sections + "existence_prior = 0.05\n"),
            "f.ini:4: [label.object] existence_prior: 0.05 must be above p_absent, which is 0.1");
  EXPECT_EQ(problems(sections + "existence_prior = 0.95\n"),
            "f.ini:4: [label.object] existence_prior: 0.95 must be below p_present, which is 0.9");
}

TEST(SettingsDefects, ALabelWithoutASection) {
  EXPECT_EQ(problems("[label.background]\n[label.tabel]\nresolution = 1\n"),
            "f.ini: [label.table]: a label without a section: add it, if only for the defaults\n"
            "f.ini: [label.object]: a label without a section: add it, if only for the defaults");
  EXPECT_EQ(problems(""),
            "f.ini: [label.background]: a label without a section: add it, if only for the defaults\n"
            "f.ini: [label.table]: a label without a section: add it, if only for the defaults\n"
            "f.ini: [label.object]: a label without a section: add it, if only for the defaults");
  EXPECT_EQ(problems("[label.background]\n[label.table]\n[label.object]\n"), "");
  EXPECT_EQ(problems("[label.background]\n[label.table]\n", {"label.object.carve=own"}), "");
}

TEST(SettingsDefects, AMonolithicMapNeedsTheBackgroundOnly) {
  EXPECT_EQ(problems("[mapping]\nmonolithic = true\n[label.background]\n"), "");
  EXPECT_EQ(problems("[mapping]\nmonolithic = true\n"),
            "f.ini: [label.background]: a label without a section: add it, if only for the defaults");
}

TEST(SettingsDefects, TheRootIsInTheWorldFrame) {
  EXPECT_EQ(problemsOf([] { static_cast<void>(loadSettings({}, {"label.background.frame=pca"})); }),
            "--set: [label.background] frame: the frame of the root is the world frame");
}

TEST(SettingsDefects, AllAreReportedTogether) {
  const std::string message = problems(
      "[mapping]\n"
      "checkpoint_scan = 3\n"
      "[sensor]\n"
      "max_range = 0\n"
      "max_range = 5\n"
      "[label.background]\n"
      "resolution = 12junk\n"
      "prob_hit = 0.4\n"
      "prob_miss = 0.6\n"
      "[label.table]\n"
      "resolution = inf\n"
      "clamping_min = 0.9\n"
      "clamping_max = 0.1\n"
      "what\n"
      "[pozes]\n",
      {"segmentation.min_table_area=big", "segmentation.zzz=1"});
  EXPECT_EQ(message,
            "f.ini: [label.object]: a label without a section: add it, if only for the defaults\n"
            "f.ini:2: [mapping] checkpoint_scan: unknown key; did you mean checkpoint_scans?\n"
            "f.ini:4: [sensor] max_range: \"0\" is out of range: must be > 0\n"
            "f.ini:5: [sensor] max_range: duplicate, first in line 4\n"
            "f.ini:7: [label.background] resolution: \"12junk\" is not a number\n"
            "f.ini:8: [label.background] prob_hit: \"0.4\" is out of range: must be > 0.5 and < 1\n"
            "f.ini:9: [label.background] prob_miss: \"0.6\" is out of range: must be > 0 and < 0.5\n"
            "f.ini:11: [label.table] resolution: \"inf\" is not a finite number\n"
            "f.ini:12: [label.table] clamping_min: 0.9 must be below occupancy_threshold, which is 0.5\n"
            "f.ini:13: [label.table] clamping_max: 0.1 must be above clamping_min, which is 0.9\n"
            "f.ini:13: [label.table] clamping_max: 0.1 must be at least occupancy_threshold, which is 0.5\n"
            "f.ini:14: [label.table]: \"what\" is neither [section] nor key = value\n"
            "f.ini:15: [pozes]: unknown section; did you mean [poses]?\n"
            "--set: [segmentation] min_table_area: \"big\" is not a number\n"
            "--set: [segmentation] zzz: unknown key");
}

TEST(SettingsDefects, FilesThatAreNot) {
  EXPECT_EQ(problemsOf([] { static_cast<void>(loadSettings("/no/such.ini")); }),
            "/no/such.ini: no such configuration file");
  EXPECT_EQ(problemsOf([] { static_cast<void>(loadSettings("/")); }),
            "/: is a directory, not a configuration file");
  EXPECT_EQ(problemsOf([] { static_cast<void>(loadSettings({}, {"resolution=1"})); }),
            "--set \"resolution=1\": expected section.key=value");
}

}  // namespace
}  // namespace hoctomap
