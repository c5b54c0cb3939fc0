// SPDX-License-Identifier: BSD-3-Clause
// Each stage of a map update by itself, with Google Benchmark. The log to measure with is taken from
// $HOCTOMAP_BENCHMARK_LOG; without it, one is simulated.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "Input.h"
#include "measuring/Scans.h"

namespace {

/// A folder of its own, removed at the end.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "hoctomap-benchmark-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A log in `folder`, where the benchmarks may also write.
std::filesystem::path logIn(const std::filesystem::path& folder) {
  auto log = folder / "log.rawlog";
  if (const char* given = std::getenv("HOCTOMAP_BENCHMARK_LOG"); given != nullptr && *given != '\0') {
    std::filesystem::create_symlink(std::filesystem::absolute(given), log);
  } else {
    hoctomap::simulateLog(HOCTOMAP_SOURCE_DIR "/configs/scenes/small_objects.ini", {"path.sweep.views=4"},
                          log);
  }
  return log;
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  try {
    const Folder folder;
    const hoctomap::BenchmarkInput input(logIn(folder.path()));
    hoctomap::registerInputStages(input);
    hoctomap::registerMappingStages(input);
    hoctomap::registerUpdate(input);
    hoctomap::registerCommit(input);
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
  } catch (const std::exception& e) {
    std::cerr << "hoctomap-benchmarks: " << e.what() << std::endl;
    return 1;
  }
  return 0;
}
