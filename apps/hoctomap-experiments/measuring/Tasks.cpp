// SPDX-License-Identifier: BSD-3-Clause
#include "measuring/Tasks.h"

#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

Figures measure(const Task& task) {
  limitThisProcess(task.limits);
  if (task.name == "whole") return measureWhole(task);
  if (task.name == "cells") return measureCells(task);
  if (task.name == "boxes") return measureBoxes(task);
  if (task.name == "mapping") return measureMapping(task);
  if (task.name == "machine") return measureMachine(task);
  throw ConfigError("no measurement is called '" + task.name + "'");
}

}  // namespace hoctomap
