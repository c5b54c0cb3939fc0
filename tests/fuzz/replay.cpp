// SPDX-License-Identifier: BSD-3-Clause
// Runs a target without libFuzzer: over its seeds, over the files and folders given, and over mutations of
// the seeds. Dies where a fuzzer would.
//   TARGET [--write-seeds DIR] [--rounds N] [--seed S] [FILE|DIR ...]
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include "FuzzTarget.h"
#include "Mutation.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

namespace {

namespace fs = std::filesystem;

void run(const std::string& bytes) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

void runFile(const fs::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  run(std::move(bytes).str());
}

}  // namespace

int main(int argc, char** argv) {
  std::uint64_t rounds = 0;
  std::uint64_t seed = 1;
  const auto seeds = hoctomap::fuzz::seeds();
  for (const std::string& bytes : seeds) run(bytes);
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool has_value = i + 1 < argc;
    if (word == "--rounds" && has_value) {
      rounds = std::stoull(argv[++i]);
    } else if (word == "--seed" && has_value) {
      seed = std::stoull(argv[++i]);
    } else if (word == "--write-seeds" && has_value) {
      const fs::path folder = argv[++i];
      fs::create_directories(folder);
      for (std::size_t k = 0; k < seeds.size(); ++k)
        std::ofstream(folder / ("seed-" + std::to_string(k)), std::ios::binary) << seeds[k];
    } else if (fs::is_directory(word)) {
      for (const auto& entry : fs::recursive_directory_iterator(word))
        if (entry.is_regular_file()) runFile(entry.path());
    } else {
      runFile(word);
    }
  }
  std::mt19937_64 random(seed);
  for (std::uint64_t i = 0; i < rounds; ++i) run(hoctomap::fuzz::mutated(seeds[i % seeds.size()], random));
  std::printf("%zu seeds, %llu mutations\n", seeds.size(), static_cast<unsigned long long>(rounds));
}
