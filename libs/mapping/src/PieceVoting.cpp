// SPDX-License-Identifier: BSD-3-Clause
#include "PieceVoting.h"

#include <algorithm>
#include <map>

namespace hoctomap {

namespace {

constexpr std::uint64_t kLeastJoinedVotes = 2;  // one view alone never merges
constexpr std::size_t kLeastPoints = 10;        // in the piece's box: fewer say nothing

/// The node of the piece's label that has most of the scan's points in the piece's box; nothing if none has
/// half.
std::optional<NodeId> holderOfBox(const MapHierarchy& hierarchy, NodeId piece,
                                  std::span<const TakenSegment> taken) {
  const Obb box = hierarchy.box(piece);
  const Eigen::Isometry3d frame_T_world = box.world_T_frame.inverse();
  std::map<NodeId, std::size_t> points;
  std::size_t total = 0;
  for (const TakenSegment& segment : taken) {
    std::size_t inside = 0;
    for (const auto& p : *segment.world_points)
      inside += box.box.contains(frame_T_world * p.cast<double>()) ? 1U : 0U;
    points[segment.node] += inside;
    total += inside;
  }
  if (total < kLeastPoints) return std::nullopt;
  for (const auto& [node, inside] : points) {
    if (2 * inside > total && node != piece && hierarchy.contains(node) &&
        hierarchy.node(node).label() == hierarchy.node(piece).label()) {
      return node;
    }
  }
  return std::nullopt;
}

bool isSettled(const PieceVotes& votes, const MapNode& piece, const MapNode& whole) {
  const auto size = [](const MapNode& n) { return static_cast<double>(n.map().occupiedVoxels().size()); };
  const double relative_size = size(piece) / std::max(1.0, size(whole));
  return votes.joined >= kLeastJoinedVotes && relative_size <= 1.0 &&
         static_cast<double>(votes.joined) >
             static_cast<double>(votes.apart) * std::min(1.0, 4.0 * relative_size);
}

}  // namespace

std::optional<NodeId> voteOnPiece(MapHierarchy& hierarchy, NodeId piece, const Evidence& evidence,
                                  std::span<const TakenSegment> taken) {
  if (!hierarchy.contains(piece)) return std::nullopt;
  PieceVotes& votes = hierarchy.node(piece).votes;
  const auto own =
      std::find_if(taken.begin(), taken.end(), [piece](const auto& s) { return s.node == piece; });
  if (own != taken.end() && !own->joined_with) {
    ++votes.apart;
    return std::nullopt;
  }
  if (2 * evidence.present <= evidence.absent + evidence.occluded) return std::nullopt;  // not seen
  const auto whole = own != taken.end() ? own->joined_with : holderOfBox(hierarchy, piece, taken);
  if (!whole || !hierarchy.contains(*whole)) return std::nullopt;
  if (votes.with != *whole) votes.joined = 0;
  votes.with = *whole;
  ++votes.joined;
  if (!isSettled(votes, hierarchy.node(piece), hierarchy.node(*whole))) return std::nullopt;
  return whole;
}

}  // namespace hoctomap
