// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/hierarchy/Relation.h"

#include <algorithm>
#include <utility>

#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

namespace {

class LambdaRelation : public Relation {
 public:
  LambdaRelation(std::string name, std::function<bool(const NodeView&, const NodeView&)> holds)
      : name_(std::move(name)), holds_(std::move(holds)) {}
  [[nodiscard]] bool holds(const NodeView& above, const NodeView& below) const override {
    return holds_(above, below);
  }
  [[nodiscard]] std::string name() const override { return name_; }

 private:
  std::string name_;
  std::function<bool(const NodeView&, const NodeView&)> holds_;
};

class LabelRelation : public Relation {
 public:
  using Holds = std::function<bool(const Label&, const Label&)>;
  LabelRelation(std::string name, Holds holds) : name_(std::move(name)), holds_(std::move(holds)) {}
  [[nodiscard]] bool holds(const NodeView& above, const NodeView& below) const override {
    return holds_(above.label, below.label);
  }
  [[nodiscard]] bool mayHold(const Label& above, const Label& below) const override {
    return holds_(above, below);
  }
  [[nodiscard]] bool dependsOnLabelsOnly() const override { return true; }
  [[nodiscard]] std::string name() const override { return name_; }

 private:
  std::string name_;
  Holds holds_;
};

}  // namespace

std::unique_ptr<Relation> makeRelation(std::string name,
                                       std::function<bool(const NodeView&, const NodeView&)> holds) {
  return std::make_unique<LambdaRelation>(std::move(name), std::move(holds));
}

std::unique_ptr<Relation> makeLabelRelation(std::string name,
                                            std::function<bool(const Label&, const Label&)> holds) {
  return std::make_unique<LabelRelation>(std::move(name), std::move(holds));
}

bool Relation::mayHold(const Label&, const Label&) const {
  return true;
}

void RelationSet::add(std::unique_ptr<Relation> relation) {
  relations_.push_back(std::move(relation));
}

bool RelationSet::holds(const NodeView& above, const NodeView& below) const {
  const Relation* holding = nullptr;
  for (const auto& relation : relations_) {
    if (!relation->holds(above, below)) continue;
    if (holding != nullptr) {
      throw RelationConflict("relations '" + holding->name() + "' and '" + relation->name() +
                             "' both hold between nodes labelled '" + above.label.name + "' and '" +
                             below.label.name + "'; relations must be mutually exclusive");
    }
    holding = relation.get();
  }
  return holding != nullptr;
}

bool RelationSet::mayHold(const Label& above, const Label& below) const {
  return std::any_of(relations_.begin(), relations_.end(),
                     [&](const auto& relation) { return relation->mayHold(above, below); });
}

std::vector<NodeId> RelationSet::candidateAncestors(const MapHierarchy& hierarchy,
                                                    const NodeView& below) const {  // Eq. (6)
  std::vector<NodeId> candidates;
  hierarchy.forEachNode([&](const MapNode& node) {
    if (node.confirmation.waits || !mayHold(node.label(), below.label)) return;
    if (holds(hierarchy.view(node.id()), below)) candidates.push_back(node.id());
  });
  return candidates;
}

NodeId RelationSet::deepestAncestor(const MapHierarchy& hierarchy, const NodeView& below,
                                    const NodeId* except) const {  // Eq. (7)
  if (const auto found = deepestInReach(hierarchy, below, except)) return *found;
  NodeId best = kRootId;
  bool found = false;
  for (const NodeId id : candidateAncestors(hierarchy, below)) {
    if (except != nullptr && hierarchy.isInSubtree(id, *except)) continue;
    if (!found || isBetter(hierarchy, id, best, below)) best = id;
    found = true;
  }
  return best;
}

std::optional<NodeId> RelationSet::deepestInReach(const MapHierarchy& hierarchy, const NodeView& below,
                                                  const NodeId* except) const {
  const bool labels_decide = std::all_of(relations_.begin(), relations_.end(), [](const auto& relation) {
    return relation->dependsOnLabelsOnly();
  });
  if (!reach_ || !labels_decide || below.box.box.isEmpty()) return std::nullopt;
  const auto kinds = hierarchy.kinds();
  const auto deepest = std::find_if(kinds.begin(), kinds.end(),
                                    [&](const NodeKind& kind) { return mayHold(kind.label, below.label); });
  if (deepest == kinds.end()) return kRootId;
  const auto isCandidate = [&](NodeId id) {
    const MapNode& node = hierarchy.node(id);
    return !node.confirmation.waits && mayHold(node.label(), below.label) &&
           hierarchy.depth(id) == deepest->depth &&
           (except == nullptr || !hierarchy.isInSubtree(id, *except));
  };
  const auto nearest = hierarchy.nearest(below.box.center(), isCandidate);
  if (!nearest) return std::nullopt;
  std::optional<NodeId> best;
  for (const NodeId id : hierarchy.idsNear(reach_(hierarchy.view(*nearest), below))) {
    if (!isCandidate(id) || !holds(hierarchy.view(id), below)) continue;
    if (!best || isBetter(hierarchy, id, *best, below)) best = id;
  }
  return best;
}

bool RelationSet::isBetter(const MapHierarchy& hierarchy, NodeId candidate, NodeId best,
                           const NodeView& below) const {
  const auto depth = hierarchy.depth(candidate);
  const auto best_depth = hierarchy.depth(best);
  if (depth != best_depth) return depth > best_depth;
  return tie_break_ && tie_break_(hierarchy.view(candidate), hierarchy.view(best), below) < 0;
}

bool RelationSet::adopts(const MapHierarchy& hierarchy, NodeId above, NodeId below) const {
  const MapNode& node = hierarchy.node(below);
  if (!node.parent() || *node.parent() == above) return false;
  if (hierarchy.node(above).confirmation.waits) return false;
  if (!mayHold(hierarchy.node(above).label(), node.label())) return false;
  const NodeView view = hierarchy.view(below);
  if (!holds(hierarchy.view(above), view) || hierarchy.isInSubtree(above, below)) return false;
  return !holds(hierarchy.view(*node.parent()), view) || isBetter(hierarchy, above, *node.parent(), view);
}

}  // namespace hoctomap
