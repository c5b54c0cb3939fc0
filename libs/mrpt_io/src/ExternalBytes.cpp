// SPDX-License-Identifier: BSD-3-Clause
#include "ExternalBytes.h"

#include <unistd.h>

#include <algorithm>
#include <new>

namespace hoctomap {

ExternalBytes::ExternalBytes(const ExternalFile& file) : file_(gzdopen(::dup(file.descriptor()), "rb")) {
  if (!file_) throw std::bad_alloc();
}

std::size_t ExternalBytes::readSome(void* into, std::size_t bytes) {
  return static_cast<std::size_t>(std::max(0, gzread(file_.get(), into, static_cast<unsigned>(bytes))));
}

bool ExternalBytes::atEnd() {
  char more = 0;
  int error = Z_OK;
  if (gzread(file_.get(), &more, 1) != 0) return false;
  static_cast<void>(gzerror(file_.get(), &error));
  return error == Z_OK;
}

}  // namespace hoctomap
