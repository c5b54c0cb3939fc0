// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hoctomap::test {

/// How a program ended, and what it said.
struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
  std::size_t peak_memory = 0;  ///< bytes, of the program or of one that it ran, whichever took more
};

/// Runs a program to its end. Standard input is empty. @param environment added to this process's own
Outcome runProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                   const std::map<std::string, std::string>& environment = {});

/// Runs `hoctomap` of this build with its helper of this build.
Outcome hoctomap(const std::vector<std::string>& arguments);

/// A folder of its own that is removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

std::string readFile(const std::filesystem::path& file);
void writeFile(const std::filesystem::path& file, const std::string& bytes);

/// Contents of all regular files below a folder, by relative name.
std::map<std::string, std::string> readTree(const std::filesystem::path& folder);

/// A map directory without the files that may differ from run to run (`timing.csv`, `log.txt`, the lock).
std::map<std::string, std::string> reproducibleFiles(const std::filesystem::path& map);

/// The fields of a CSV text by column name, one map a row. No quoting.
std::vector<std::map<std::string, std::string>> parseCsv(const std::string& text);

}  // namespace hoctomap::test
