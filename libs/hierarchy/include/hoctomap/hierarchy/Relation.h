// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "hoctomap/geometry/Obb.h"
#include "hoctomap/hierarchy/Label.h"
#include "hoctomap/hierarchy/NodeId.h"

namespace hoctomap {

class MapHierarchy;
class NodeMap;

/// What a relation may look at: a node of the hierarchy, or one that is about to be added.
struct NodeView {
  Label label;
  Obb box;                       ///< in the world
  const NodeMap* map = nullptr;  ///< null for a node that has no map yet
};

/// A spatial relation r of Section III-B on pairs of nodes, such as *supports* or *contains*.
class Relation {
 public:
  virtual ~Relation() = default;
  /// Whether (above, below) is in r: `above` is at a higher level of the hierarchy than `below`.
  [[nodiscard]] virtual bool holds(const NodeView& above, const NodeView& below) const = 0;
  [[nodiscard]] virtual std::string name() const = 0;
  /// Whether it can hold between nodes of these labels at all: spares the search for parents most nodes.
  [[nodiscard]] virtual bool mayHold(const Label& above, const Label& below) const;
  /// Whether it holds wherever it may: then nobody needs to look at boxes and maps to know.
  [[nodiscard]] virtual bool dependsOnLabelsOnly() const { return false; }
};

/// A relation from a lambda `bool(const NodeView& above, const NodeView& below)`.
[[nodiscard]] std::unique_ptr<Relation> makeRelation(
    std::string name, std::function<bool(const NodeView&, const NodeView&)> holds);

/// A relation that depends on the labels only.
[[nodiscard]] std::unique_ptr<Relation> makeLabelRelation(
    std::string name, std::function<bool(const Label& above, const Label& below)> holds);

/// Thrown when two relations of a set hold for one pair: they must be mutually exclusive (Section III-B).
struct RelationConflict : std::logic_error {
  using std::logic_error::logic_error;
};

/// The set R of relations that defines a hierarchy, and the search for a parent in it.
class RelationSet {
 public:
  /// Which of two equally deep candidate ancestors is the better parent: negative for `a`, positive for `b`,
  /// 0 if it does not matter (then the lower id wins).
  using TieBreak = std::function<int(const NodeView& a, const NodeView& b, const NodeView& below)>;
  /// Box in the world that holds a part of the box of every node that the tie-break may prefer to `best`, and
  /// of `best`: spares the search for parents what is elsewhere.
  using Reach = std::function<Eigen::AlignedBox3d(const NodeView& best, const NodeView& below)>;

  void add(std::unique_ptr<Relation> relation);
  void setTieBreak(TieBreak tie_break, Reach reach = {}) {
    tie_break_ = std::move(tie_break);
    reach_ = std::move(reach);
  }

  /// Whether some relation holds for the pair.
  /// @throws RelationConflict if more than one does.
  [[nodiscard]] bool holds(const NodeView& above, const NodeView& below) const;

  /// Whether some relation can hold between nodes of these labels.
  [[nodiscard]] bool mayHold(const Label& above, const Label& below) const;

  /// A of Eq. 6: all nodes that are related to `below`, ascending; without those that wait for confirmation.
  [[nodiscard]] std::vector<NodeId> candidateAncestors(const MapHierarchy& hierarchy,
                                                       const NodeView& below) const;

  /// a* of Eq. 7: the deepest candidate; the root if there is none. `except`: a node that may not be chosen,
  /// nor anything below it (for finding a new parent of a node that is already there).
  [[nodiscard]] NodeId deepestAncestor(const MapHierarchy& hierarchy, const NodeView& below,
                                       const NodeId* except = nullptr) const;

  /// Whether `above` is a better parent, in the sense of Eq. 7, for `below` than the one it has.
  [[nodiscard]] bool adopts(const MapHierarchy& hierarchy, NodeId above, NodeId below) const;

 private:
  /// The same, of relations between labels, without a look at all nodes; none if that is needed.
  [[nodiscard]] std::optional<NodeId> deepestInReach(const MapHierarchy& hierarchy, const NodeView& below,
                                                     const NodeId* except) const;
  [[nodiscard]] bool isBetter(const MapHierarchy& hierarchy, NodeId candidate, NodeId best,
                              const NodeView& below) const;

  std::vector<std::unique_ptr<Relation>> relations_;
  TieBreak tie_break_;
  Reach reach_;
};

}  // namespace hoctomap
