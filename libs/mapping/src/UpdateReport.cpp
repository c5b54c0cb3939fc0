// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/mapping/UpdateReport.h"

#include <stdexcept>

namespace hoctomap {

std::string toString(NodeEventKind kind) {
  switch (kind) {
    case NodeEventKind::created:
      return "created";
    case NodeEventKind::updated:
      return "updated";
    case NodeEventKind::removed:
      return "removed";
    case NodeEventKind::merged:
      return "merged";
    case NodeEventKind::moved:
      return "moved";
    case NodeEventKind::split:
      return "split";
    case NodeEventKind::reidentified:
      return "reidentified";
  }
  throw std::invalid_argument("no such node event");
}

std::string createdDetail(std::uint64_t points, std::uint64_t scan, NodeId parent) {
  return std::to_string(points) + " points of scan " + std::to_string(scan) + ", parent " +
         std::to_string(parent.value);
}

}  // namespace hoctomap
