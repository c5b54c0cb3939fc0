// SPDX-License-Identifier: BSD-3-Clause
#include "NodeIndex.h"

#include <algorithm>
#include <utility>

#include "IndexBytes.h"
#include "ManifestTree.h"
#include "RecordChecks.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/Sha256.h"

namespace hoctomap {

namespace {

const std::string kMagic = "hoctomap index 1\n";

/// A box, whether it is empty or not: an empty one has low above high.
template <class Io, class Box>
void transferBox(Io& io, Box& box) {
  bool there = !box.isEmpty();
  index_bytes::transferFlag(io, there);
  if (!there) return;
  for (int axis = 0; axis < 3; ++axis) {
    io.value(box.min()[axis]);
    io.value(box.max()[axis]);
  }
}

template <class Io, class Place>
void transferPlace(Io& io, Place& place, std::uint64_t& record) {
  io.value(place.id.value);
  std::uint64_t depth = place.depth;
  io.value(depth);
  if constexpr (!std::is_const_v<Place>) place.depth = depth;
  io.value(place.resolution);
  io.value(place.existence);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) io.value(place.world_T_node(row, column));
  }
  transferBox(io, place.extent.known);
  transferBox(io, place.extent.occupied);
  io.value(place.extent.voxels.occupied);
  io.value(place.extent.voxels.free);
  io.value(record);
}

std::map<NodeId, std::size_t> depthsOf(const std::vector<NodeRecord>& nodes) {
  std::map<NodeId, std::size_t> depths;
  for (const NodeRecord& node : nodes) depths[node.id] = node.parent ? depths.at(*node.parent) + 1 : 0;
  return depths;
}

}  // namespace

std::string nodeIndexBytes(const Manifest& manifest, const std::string& nodes_text,
                           const std::map<NodeId, VoxelExtent>& extents) {
  std::string records;
  index_bytes::Writer record_writer(records);
  std::map<NodeId, std::pair<const NodeRecord*, std::uint64_t>> by_id;  // with the beginning of the record
  for (const NodeRecord& node : manifest.nodes) {
    by_id[node.id] = {&node, records.size()};
    index_bytes::transfer(record_writer, node);
  }
  for (const auto* list : {&manifest.removed, &manifest.waiting}) {
    for (const NodeRecord& node : *list) index_bytes::transfer(record_writer, node);
  }

  std::string bytes = kMagic;
  index_bytes::Writer writer(bytes);
  writer.value(std::uint64_t{nodes_text.size()});
  writer.text(sha256Hex(nodes_text));
  for (const auto* list : {&manifest.nodes, &manifest.removed, &manifest.waiting}) writer.resize(*list);
  const auto depths = depthsOf(manifest.nodes);
  for (const auto& [id, entry] : by_id) {
    const NodeRecord& node = *entry.first;
    const NodePlace place{
        id, depths.at(id), node.resolution, node.existence, toIsometry(node.world_T_node), extents.at(id)};
    std::uint64_t at = entry.second;
    transferPlace(writer, place, at);
  }
  return bytes + records;
}

NodeIndex::NodeIndex(std::string bytes, std::string name) : bytes_(std::move(bytes)), name_(std::move(name)) {
  if (!bytes_.starts_with(kMagic))
    throw MapError(name_ + ": is no index of nodes, or one of another version");
  index_bytes::Reader reader(bytes_, kMagic.size(), name_);
  reader.value(nodes_bytes_);
  reader.text(nodes_sha256_);
  reader.value(nodes_);
  reader.value(removed_);
  reader.value(waiting_);
  if (std::max({nodes_, removed_, waiting_}) > kMaxMapNodes) throw LimitError(name_ + ": has too many nodes");
  places_.resize(nodes_);
  records_.resize(nodes_);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    std::uint64_t record = 0;
    transferPlace(reader, places_[i], record);
    const double skewness = (places_[i].world_T_node.linear() * places_[i].world_T_node.linear().transpose() -
                             Eigen::Matrix3d::Identity())
                                .norm();
    if (skewness > 1e-6 || !(places_[i].resolution > 0.0)) reader.refuse("a node has no place");
    if (i > 0 && !(places_[i - 1].id < places_[i].id)) reader.refuse("the nodes are not in order");
    records_[i] = record;
  }
  first_record_ = reader.at();
  for (std::size_t& record : records_) {
    if (record > bytes_.size() - first_record_) reader.refuse("a node has no record");
    record += first_record_;
  }
}

NodeRecord NodeIndex::recordAt(std::size_t& at) const {
  NodeRecord record;
  index_bytes::Reader reader(bytes_, at, name_);
  index_bytes::transfer(reader, record);
  at = reader.at();
  if (const char* problem = problemOf(record)) reader.refuse(problem);
  return record;
}

NodeRecord NodeIndex::record(std::size_t place) const {
  std::size_t at = records_.at(place);
  NodeRecord record = recordAt(at);
  if (record.id != places_[place].id) throw MapError(name_ + ": a node has the record of another one");
  return record;
}

void NodeIndex::addNodes(Manifest& manifest) const {
  std::size_t at = first_record_;
  const auto take = [&](std::vector<NodeRecord>& list, std::uint32_t count) {
    list.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) list.push_back(recordAt(at));
  };
  take(manifest.nodes, nodes_);
  take(manifest.removed, removed_);
  take(manifest.waiting, waiting_);
  manifest.nodes = orderedTree(std::move(manifest.nodes), name_);
  checkIds(manifest, name_);
}

}  // namespace hoctomap
