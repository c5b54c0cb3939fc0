// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/mrpt_io/FileHash.h"

#include <fstream>
#include <vector>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/Sha256.h"

namespace hoctomap {

std::string sha256OfFile(const std::filesystem::path& file) {
  Sha256 hash;
  std::vector<char> buffer(std::size_t{1} << 20);
  std::ifstream in(file, std::ios::binary);
  while (in) {
    in.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    hash.add({buffer.data(), static_cast<std::size_t>(in.gcount())});
  }
  if (!in.eof()) throw InputError(escapedText(file.string()) + ": cannot be read");
  return hash.hex();
}

}  // namespace hoctomap
