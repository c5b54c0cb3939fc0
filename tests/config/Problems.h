// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "hoctomap/config/IniDocument.h"
#include "hoctomap/config/Settings.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap::test {

/// The message of the ConfigError that `action` throws, "" if it throws none.
template <class Action>
std::string problemsOf(Action action) {
  try {
    action();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

inline std::string problemsOf(const IniDocument& document) {
  return problemsOf([&] { document.finish(); });
}

}  // namespace hoctomap::test
