// SPDX-License-Identifier: BSD-3-Clause
// Changes of the map by hand (docs/decisions/0041).
#include "SurfacePoints.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/mapping/HierarchyMapper.h"

namespace hoctomap {

namespace {

std::string nodeName(NodeId id) {
  return "node " + std::to_string(id.value);
}

UpdateReport reportOf(const HierarchyMapper::Edit& edit) {
  UpdateReport report;
  report.scan = edit.scan;
  report.stamp = edit.stamp;
  return report;
}

}  // namespace

void HierarchyMapper::confirmEntered() {
  for (const NodeId id : hierarchy_.ids()) {
    Confirmation& confirmation = hierarchy_.node(id).confirmation;
    if (confirmation.entered_at_end) confirmation = {};
  }
}

/// What waits for confirmation is no part of the map that people see.
void HierarchyMapper::requireEditable(NodeId id) const {
  if (!hierarchy_.contains(id) || hierarchy_.node(id).confirmation.waits) {
    throw ConfigError("the map has no " + nodeName(id));
  }
  if (id == kRootId) throw ConfigError("node 0 is the root: it stays as it is");
}

UpdateReport HierarchyMapper::relabel(NodeId id, const Label& label, const Edit& edit) {
  requireEditable(id);
  const Label before = hierarchy_.node(id).label();
  if (label == labels::background || !profiles_.contains(label)) {
    std::string known;
    for (const auto& [name, unused] : profiles_) {
      if (name != labels::background) known += (known.empty() ? "" : ", ") + name.name;
    }
    throw ConfigError("nodes of this map cannot be labelled \"" + label.name + "\", but: " + known);
  }
  if (label == before) throw ConfigError(nodeName(id) + " is labelled \"" + label.name + "\" already");
  UpdateReport report = reportOf(edit);
  hierarchy_.relabel(id, label);
  note(report, NodeEventKind::updated, id, "relabelled by hand, was " + before.name);
  return report;
}

UpdateReport HierarchyMapper::remove(NodeId id, const Edit& edit) {
  requireEditable(id);
  UpdateReport report = reportOf(edit);
  note(report, NodeEventKind::removed, id, "by hand");
  if (config_.seam_votes) seams_.forget(SeamVotes::cellsOf(worldSurface(hierarchy_, id)));
  takeOut(id, edit.scan);
  return report;
}

UpdateReport HierarchyMapper::merge(NodeId whole, NodeId piece, const Edit& edit) {
  requireEditable(piece);
  if (whole != kRootId) requireEditable(whole);
  if (whole == piece) throw ConfigError(nodeName(whole) + " cannot be merged with itself");
  if (hierarchy_.isInSubtree(whole, piece)) {
    throw ConfigError(nodeName(whole) + " is below " + nodeName(piece) +
                      ", which cannot go into it; merge the other way round");
  }
  if (hierarchy_.node(piece).map().resolution() > hierarchy_.node(whole).map().resolution()) {
    throw ConfigError(nodeName(piece) + " is coarser than " + nodeName(whole) +
                      ", its voxels cannot go into finer ones; merge the other way round");
  }
  UpdateReport report = reportOf(edit);
  mergeInto(whole, piece, edit.scan, report);
  hierarchy_.node(whole).edition = edit.number;
  if (config_.seam_votes) assumeWhole(whole);
  return report;
}

}  // namespace hoctomap
