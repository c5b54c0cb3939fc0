// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace hoctomap {

/// What the user gets is one line and an exit code; one type a code (docs/reliability.md).
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};
struct ConfigError : Error {  ///< usage or configuration: exit 2
  using Error::Error;
};
struct InputError : Error {  ///< log or poses: exit 3
  using Error::Error;
};
struct MapError : Error {  ///< a map on disk: exit 4
  using Error::Error;
};
struct FileError : Error {  ///< reading or writing files: exit 5
  using Error::Error;
};
struct LimitError : Error {  ///< a limit reached: exit 6
  using Error::Error;
};

}  // namespace hoctomap
