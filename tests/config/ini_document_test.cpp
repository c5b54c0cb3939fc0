// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/config/IniDocument.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>

#include "Problems.h"

namespace hoctomap {
namespace {

using test::problemsOf;

constexpr Range any{};

IniDocument ini(std::string_view text) {
  return IniDocument::fromText(text, "f.ini");
}

TEST(IniDocument, ReadsEveryType) {
  IniDocument document =
      ini("[a.b]\nnumber = -2.5e-3\nplus = +1\ninteger = -7\nyes = true\nno = false\ntext = two words\n"
          "choice = red\nlist = 1, 2 3\t4\nnone = none\n");
  EXPECT_EQ(document.number("a.b", "number", 0.0, any), -2.5e-3);
  EXPECT_EQ(document.number("a.b", "plus", 0.0, any), 1.0);
  EXPECT_EQ(document.integer("a.b", "integer", 0, any), -7);
  EXPECT_TRUE(document.boolean("a.b", "yes", false));
  EXPECT_FALSE(document.boolean("a.b", "no", true));
  EXPECT_EQ(document.text("a.b", "text", ""), "two words");
  EXPECT_EQ(document.choice("a.b", "choice", "blue", {"blue", "red"}), "red");
  EXPECT_EQ(document.numberOrNone("a.b", "none", 3.0, any), std::nullopt);
  EXPECT_EQ(document.numbers("a.b", "list", {}, 4, any), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(problemsOf(document), "");
}

TEST(IniDocument, AbsentKeysGiveTheFallback) {
  IniDocument document = ini("");
  EXPECT_EQ(document.number("a", "x", 1.5, {2, 3}), 1.5);
  EXPECT_EQ(document.numberOrNone("a", "x", 1.5, any), 1.5);
  EXPECT_EQ(document.integer("a", "x", 4, any), 4);
  EXPECT_TRUE(document.boolean("a", "x", true));
  EXPECT_EQ(document.text("a", "x", "t"), "t");
  EXPECT_EQ(document.choice("a", "x", "t", {"u"}), "t");
  EXPECT_EQ(document.numbers("a", "x", {1, 2}, 3, any), (std::vector<double>{1, 2}));
  EXPECT_FALSE(document.has("a", "x"));
  EXPECT_EQ(problemsOf(document), "");
}

TEST(IniDocument, CommentsBlanksByteOrderMarkAndCrLf) {
  IniDocument document =
      ini("\xEF\xBB\xBF; head\r\n# too\r\n// too\r\n\r\n  [ a ]  # c\r\n\tx\t=\t1 ; c\r\ny=2 # c\r\nz = 3 // "
          "c\r\n"
          "t = a;b#c//d ; e\r\nempty = # nothing");
  EXPECT_EQ(document.sections(), std::vector<std::string>{"a"});
  EXPECT_EQ(document.number("a", "x", 0, any), 1);
  EXPECT_EQ(document.number("a", "y", 0, any), 2);
  EXPECT_EQ(document.number("a", "z", 0, any), 3);
  EXPECT_EQ(document.text("a", "t", ""), "a;b#c//d");
  EXPECT_EQ(document.text("a", "empty", "x"), "");
  EXPECT_EQ(problemsOf(document), "");
}

TEST(IniDocument, SectionsKeepTheOrderOfTheFile) {
  IniDocument document = ini("[b]\n[a]\n[c.d]\n");
  document.set("e.x=1");
  EXPECT_EQ(document.sections(), (std::vector<std::string>{"b", "a", "c.d", "e"}));
  EXPECT_TRUE(document.hasSection("c.d"));
  EXPECT_FALSE(document.hasSection("d"));
}

struct BadNumber {
  const char* value;
  const char* what;
};

TEST(IniDocument, BadNumbersAreNamedAndGiveTheFallback) {
  const std::vector<BadNumber> numbers{{"12junk", "\"12junk\" is not a number"},
                                       {"0,7", "\"0,7\" is not a number (the decimal sign is a point)"},
                                       {"0.7 0.8", "\"0.7 0.8\" is not a number"},
                                       {"", "has no value"},
                                       {"0x1p-1", "\"0x1p-1\" is not a number"},
                                       {"+-0.7", "\"+-0.7\" is not a number"},
                                       {"+", "\"+\" is not a number"},
                                       {"nan", "\"nan\" is not a finite number"},
                                       {"-inf", "\"-inf\" is not a finite number"},
                                       {"1e999", "\"1e999\" is not a finite number"},
                                       {"none", "\"none\" is not a number"},
                                       {"0.5", "\"0.5\" is out of range: must be > 0.5 and <= 1"},
                                       {"1.1", "\"1.1\" is out of range: must be > 0.5 and <= 1"}};
  for (const BadNumber& bad : numbers) {
    IniDocument document = ini(std::string("[a]\nx = ") + bad.value + "\n");
    EXPECT_EQ(document.number("a", "x", 0.75, {0.5, 1, true, false}), 0.75);
    EXPECT_EQ(problemsOf(document), std::string("f.ini:2: [a] x: ") + bad.what);
  }
}

TEST(IniDocument, OtherTypesAreCheckedInFull) {
  IniDocument document = ini(
      "[a]\ni = 1.0\nj = 99999999999999999999\nk = 11\nb = True\nc = rde\nn = 1 2\nm = 1,,2\no = 1 2,\np =\n"
      "q = 1 x\nr = -1\n");
  EXPECT_EQ(document.integer("a", "i", 3, any), 3);
  EXPECT_EQ(document.integer("a", "j", 3, any), 3);
  EXPECT_EQ(document.integer("a", "k", 3, {0, 10}), 3);
  EXPECT_FALSE(document.boolean("a", "b", false));
  EXPECT_EQ(document.choice("a", "c", "blue", {"blue", "red"}), "blue");
  for (const char* key : {"n", "m", "p", "q"}) document.numbers("a", key, {}, 3, any);
  document.numbers("a", "o", {}, std::nullopt, any);
  EXPECT_EQ(document.numberOrNone("a", "r", 5.0, {0, 10}), 5.0);
  EXPECT_EQ(problemsOf(document),
            "f.ini:2: [a] i: \"1.0\" is not a whole number\n"
            "f.ini:3: [a] j: \"99999999999999999999\" is out of range\n"
            "f.ini:4: [a] k: \"11\" is out of range: must be >= 0 and <= 10\n"
            "f.ini:5: [a] b: \"True\" is none of true, false\n"
            "f.ini:6: [a] c: \"rde\" is none of blue, red\n"
            "f.ini:7: [a] n: needs 3 numbers, has 2\n"
            "f.ini:8: [a] m: has no value\n"
            "f.ini:9: [a] o: has no value\n"
            "f.ini:10: [a] p: needs 3 numbers, has 0\n"
            "f.ini:11: [a] q: needs 3 numbers, has 2\n"
            "f.ini:12: [a] r: \"-1\" is out of range: must be >= 0 and <= 10");
}

TEST(IniDocument, UnknownAndDuplicateNamesAreReportedTogetherInTheOrderOfTheFile) {
  IniDocument document =
      ini("[alpha]\nresolutoin = 1\nresolution = 2\nresolution = 3\nfar = 1\n[alpa]\nx = "
          "1\n[alpha]\n[other]\nQ=1\n");
  document.number("alpha", "resolution", 0, any);
  document.number("beta", "far", 0, any);
  EXPECT_EQ(problemsOf(document),
            "f.ini:2: [alpha] resolutoin: unknown key; did you mean resolution?\n"
            "f.ini:4: [alpha] resolution: duplicate, first in line 3\n"
            "f.ini:5: [alpha] far: unknown key; did you mean [beta] far?\n"
            "f.ini:6: [alpa]: unknown section; did you mean [alpha]?\n"
            "f.ini:8: [alpha]: duplicate section, first in line 1\n"
            "f.ini:9: [other]: unknown section");
}

TEST(IniDocument, NamesAreCaseSensitiveAndTheSuggestionIsNot) {
  IniDocument document = ini("[a]\nMAX_RANGE = 1\n");
  document.number("a", "max_range", 0, any);
  EXPECT_EQ(problemsOf(document), "f.ini:2: [a] MAX_RANGE: unknown key; did you mean max_range?");
}

TEST(IniDocument, LinesThatAreNoIni) {
  IniDocument document = ini("x = 1\n[a]\nnonsense\n= 3\n[]\n[b\ny = 1\n[c] d\n");
  document.number("a", "x", 0, any);
  document.number("b", "y", 0, any);
  document.number("c", "z", 0, any);
  EXPECT_EQ(problemsOf(document),
            "f.ini:1: x: stands in no [section]\n"
            "f.ini:3: [a]: \"nonsense\" is neither [section] nor key = value\n"
            "f.ini:4: [a]: \"= 3\" is neither [section] nor key = value\n"
            "f.ini:5: \"[]\" is no [section]\n"
            "f.ini:6: \"[b\" is no [section]\n"
            "f.ini:8: \"[c] d\" is no [section]");
}

TEST(IniDocument, OverridesReplaceAndAdd) {
  IniDocument document = ini("[a.b]\nx = junk\n");
  document.set("a.b.x=1");
  document.set("a.b.x = 2");
  document.set("c.y = 1=2 ; kept");
  EXPECT_EQ(document.number("a.b", "x", 0, any), 2);
  EXPECT_EQ(document.text("c", "y", ""), "1=2 ; kept");
  EXPECT_EQ(problemsOf(document), "");
}

TEST(IniDocument, ProblemsOfOverridesNameThem) {
  IniDocument document = ini("[a]\nx = 1\n");
  document.set("a.x=zero");
  document.set("a.xs=1");
  document.set("q.x=1");
  document.number("a", "x", 0, any);
  EXPECT_EQ(problemsOf(document),
            "--set: [a] x: \"zero\" is not a number\n"
            "--set: [q]: unknown section\n"
            "--set: [a] xs: unknown key; did you mean x?");
}

TEST(IniDocument, OverridesOfAnotherFormAreRefused) {
  IniDocument document = ini("");
  for (const char* text : {"", "a", "a.b", "ab=1", ".b=1", "a.=1", " . = ", "=", "ab=1.5"}) {
    EXPECT_EQ(problemsOf([&] { document.set(text); }),
              std::string("--set \"") + text + "\": expected section.key=value");
  }
}

TEST(IniDocument, ControlCharactersAreEscaped) {
  const std::string bad = "a\x1b[31m\x7f\xc2\x9b\xff\xc3\xa4\r\t.";
  IniDocument document = IniDocument::fromText("[a]\nx = " + bad + "\n" + bad + " = 1\n", "f\n.ini");
  document.number("a", "x", 0, any);
  const std::string shown = "a\\x1b[31m\\x7f\\xc2\\x9b\\xff\xc3\xa4\\x0d\\x09.";
  EXPECT_EQ(problemsOf(document),
            "f\\x0a.ini:2: [a] x: \"" + shown + "\" is not a number\n" +  //
                "f\\x0a.ini:3: [a] " + shown + ": unknown key");
}

TEST(IniDocument, NulBytesDoNotEndTheText) {
  using namespace std::string_view_literals;
  IniDocument document = ini("[a]\nx = 1\0\ny = junk\n"sv);
  document.number("a", "x", 0, any);
  document.number("a", "y", 0, any);
  EXPECT_EQ(problemsOf(document),
            "f.ini:2: [a] x: \"1\\x00\" is not a number\nf.ini:3: [a] y: \"junk\" is not a number");
}

TEST(IniDocument, ManyProblemsAndLongTextsAreCut) {
  std::string text = "[a]\nx = " + std::string(5000, 'z') + "\n";
  for (int i = 0; i < 5000; ++i) text += "junk\n";
  IniDocument document = ini(text);
  document.number("a", "x", 0, any);
  const std::string problems = problemsOf(document);
  EXPECT_EQ(std::count(problems.begin(), problems.end(), '\n'), 100);
  EXPECT_LT(problems.size(), 10'000U);
  EXPECT_TRUE(problems.ends_with("f.ini: and more problems"));
}

TEST(IniDocument, ProblemsOfTheCallerNameTheLine) {
  IniDocument document = ini("[a]\nx = 1\n");
  document.number("a", "x", 0, any);
  document.problem("a", "x", "is odd");
  document.problem("a", "y", "is missing");
  document.problem("b", "", "is missing");
  document.problem("", "", "is empty");
  EXPECT_EQ(problemsOf(document),
            "f.ini: [b]: is missing\nf.ini: is empty\nf.ini:1: [a] y: is missing\nf.ini:2: [a] x: is odd");
}

class IniFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::path(::testing::TempDir()) /
        ("hoctomap_ini_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& text) {
    std::ofstream(folder_ / "f.ini", std::ios::binary) << text;
    return folder_ / "f.ini";
  }
  std::filesystem::path folder_;
};

TEST_F(IniFiles, AreRead) {
  IniDocument document = IniDocument::fromFile(write("[a]\nx = 3"));
  EXPECT_EQ(document.number("a", "x", 0, any), 3);
  document.problem("a", "x", "what");
  EXPECT_EQ(problemsOf(document), (folder_ / "f.ini").string() + ":2: [a] x: what");
}

TEST_F(IniFiles, ThatCannotBeReadAreNamed) {
  const auto what = [](const std::filesystem::path& path) {
    return problemsOf([&] { static_cast<void>(IniDocument::fromFile(path)); });
  };
  EXPECT_EQ(what(folder_ / "no\n.ini"), (folder_ / "no\\x0a.ini").string() + ": no such configuration file");
  EXPECT_EQ(what(folder_), folder_.string() + ": is a directory, not a configuration file");
  EXPECT_EQ(what("/dev/null"), "/dev/null: is no regular file");
  EXPECT_NE(what(write(std::string(1'000'001, '\n'))).find("larger than 1 MB"), std::string::npos);
  EXPECT_EQ(what(write(std::string(1'000'000, '\n'))), "");
}

TEST_F(IniFiles, WithoutPermissionAreNamed) {
  const std::filesystem::path path = write("[a]\n");
  std::filesystem::permissions(path, std::filesystem::perms::none);
  if (std::ifstream(path)) GTEST_SKIP() << "this user may read every file";
  EXPECT_EQ(problemsOf([&] { static_cast<void>(IniDocument::fromFile(path)); }),
            path.string() + ": cannot be opened for reading");
}

TEST(Range, TextAndContains) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(Range{}.text(), "any");
  EXPECT_EQ((Range{0, infinity, true}).text(), "> 0");
  EXPECT_EQ((Range{.max = 0.1, .open_max = true}).text(), "< 0.1");
  EXPECT_EQ((Range{1, 2}).text(), ">= 1 and <= 2");
  EXPECT_TRUE((Range{1, 2}).contains(1) && (Range{1, 2}).contains(2));
  EXPECT_FALSE((Range{1, 2, true, true}).contains(1) || (Range{1, 2, true, true}).contains(2));
  EXPECT_FALSE(Range{}.contains(std::numeric_limits<double>::quiet_NaN()));
}

}  // namespace
}  // namespace hoctomap
