// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/OctreeFile.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <locale>
#include <optional>
#include <sstream>

#include "NumberText.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/octree/TreeBytes.h"

namespace hoctomap {
namespace {

constexpr unsigned kMaxDepth = 16;
constexpr std::size_t kOtNodeBytes = 5;
constexpr std::string_view kOtBegin = "# Octomap OcTree file";
constexpr std::string_view kBtBegin = "# Octomap OcTree binary file";

struct Header {
  std::uint64_t size = 0;  ///< announced number of nodes
  double resolution = 0.0;
  std::size_t data = 0;  ///< where the nodes begin
};

/// Reads the lines up to `data`: comments, and each of id, size and res exactly once.
Header readHeader(std::string_view bytes, std::string_view first_line, const std::string& name) {
  const auto refuse = [&](const std::string& what) { throw MapError(name + ": " + what); };
  std::optional<std::string_view> id;
  std::optional<std::uint64_t> size;
  std::optional<double> resolution;
  std::size_t at = 0;
  for (int line_number = 1;; ++line_number) {
    const auto end = bytes.substr(at, 256).find('\n');
    if (end == std::string_view::npos) refuse("the header ends early");
    const std::string_view line = bytes.substr(at, end);
    at += end + 1;
    if (line_number == 1) {
      if (!line.starts_with(first_line)) refuse("does not begin with \"" + std::string(first_line) + "\"");
      continue;
    }
    if (line.starts_with('#')) continue;
    if (line == "data") break;
    const auto blank = line.find(' ');
    const std::string_view key = line.substr(0, blank);
    const std::string_view value = blank == std::string_view::npos ? "" : line.substr(blank + 1);
    if (key == "id" && !id) {
      id = value;
    } else if (key == "size" && !size && parseCount(value)) {
      size = parseCount(value);
    } else if (key == "res" && !resolution && parseNumber(value).value_or(0.0) > 0.0) {
      resolution = parseNumber(value);
    } else {
      refuse("line " + std::to_string(line_number) + " of the header is wrong: \"" + escapedText(line) +
             "\"");
    }
  }
  if (id != "OcTree") refuse("the header does not say \"id OcTree\"");
  if (!size || !resolution) refuse("size or res is missing in the header");
  return {*size, *resolution, at};
}

/// Walks the nodes in the file's order. Children still to come, one bit mask a level: no recursion, so that a
/// hostile chain cannot overflow the stack.
class NodeWalk {
 public:
  NodeWalk(std::string_view data, std::size_t offset, const std::string& name)
      : data_(data), offset_(offset), name_(name) {}

  [[noreturn]] void refuse(const std::string& what) const {
    throw MapError(name_ + ": " + what + " at byte " + std::to_string(offset_ + at_));
  }
  std::string_view take(std::size_t count) {
    if (data_.size() - at_ < count) refuse("cut inside an octree node");
    at_ += count;
    return data_.substr(at_ - count, count);
  }
  void enter(unsigned children) {
    if (children != 0 && depth_ >= kMaxDepth) refuse("the octree is deeper than 16");
    pending_.at(depth_) = children;
  }
  /// Goes on to the next node that the masks announce; false when there is none.
  bool next() {
    while (pending_.at(depth_) == 0) {
      if (depth_ == 0) return false;
      --depth_;
    }
    pending_.at(depth_) &= pending_.at(depth_) - 1;
    ++depth_;
    return true;
  }
  void finish(std::uint64_t counted, std::uint64_t announced) const {
    if (at_ != data_.size()) refuse("bytes after the last octree node");
    if (counted != announced) {
      refuse("holds " + std::to_string(counted) + " octree nodes, its header says " +
             std::to_string(announced));
    }
  }

 private:
  std::string_view data_;
  std::size_t offset_;
  const std::string& name_;
  std::size_t at_ = 0;
  unsigned depth_ = 0;
  std::array<unsigned, kMaxDepth + 1> pending_{};
};

Header checkedOtHeader(std::string_view bytes, const std::string& name) {
  const Header header = readHeader(bytes, kOtBegin, name);
  if (header.size > (bytes.size() - header.data) / kOtNodeBytes) {
    throw MapError(name + ": cut: too short for the " + std::to_string(header.size) +
                   " octree nodes that its header says");
  }
  NodeWalk walk(bytes.substr(header.data), header.data, name);
  std::uint64_t nodes = 0;
  if (header.size > 0) {
    do {
      ++nodes;
      const std::string_view node = walk.take(kOtNodeBytes);  // log-odds, then the mask of children
      float log_odds = 0.0F;
      std::memcpy(&log_odds, node.data(), sizeof log_odds);
      if (!std::isfinite(log_odds)) walk.refuse("log-odds that are no finite number");
      walk.enter(static_cast<unsigned char>(node[4]));
    } while (walk.next());
  }
  walk.finish(nodes, header.size);
  return header;
}

/// A file of OctoMap's.
std::string fileOf(std::string_view first_line, const octomap::OcTree& tree, const TreeBytes& nodes) {
  std::ostringstream header;
  header.imbue(std::locale::classic());
  header << first_line << "\n# (feel free to add / change comments, but leave the first line as it is!)\n#\n";
  header << "id " << tree.getTreeType() << "\nsize " << nodes.nodes << "\nres " << tree.getResolution()
         << "\ndata\n";
  return std::move(header).str() + nodes.bytes;
}

/// As `memoryUsage()`, which goes through the tree to count its leaves.
std::uint64_t memoryOf(const octomap::OcTree& tree, const TreeBytes& ot) {
  using Tree = octomap::OcTreeBaseImpl<octomap::OcTreeNode, octomap::AbstractOccupancyOcTree>;
  constexpr std::uint64_t kChildren = sizeof(octomap::OcTreeNode* [8]);
  return sizeof(Tree) + tree.memoryUsageNode() * ot.nodes + kChildren * (ot.nodes - ot.leaves);
}

}  // namespace

OctreeFiles octreeFiles(const octomap::OcTree& tree) {
  const TreeBytes ot = otNodes(tree);
  return {fileOf(kOtBegin, tree, ot), fileOf(kBtBegin, tree, btNodes(ot, tree.getOccupancyThresLog())),
          extentOf(ot, tree.getResolution(), tree.getOccupancyThresLog()), memoryOf(tree, ot)};
}

std::string otBytes(const octomap::OcTree& tree) {
  return fileOf(kOtBegin, tree, otNodes(tree));
}

std::string btBytes(const octomap::OcTree& tree) {
  return octreeFiles(tree).bt;
}

void checkOt(std::string_view bytes, const std::string& name) {
  static_cast<void>(checkedOtHeader(bytes, name));
}

void checkBt(std::string_view bytes, const std::string& name) {
  const Header header = readHeader(bytes, kBtBegin, name);
  NodeWalk walk(bytes.substr(header.data), header.data, name);
  std::uint64_t nodes = header.size > 0 ? 1 : 0;  // the root has no bits of its own
  if (header.size > 0) {
    do {
      const std::string_view node = walk.take(2);
      unsigned inner = 0;
      for (unsigned child = 0; child < 8; ++child) {
        const auto byte = static_cast<unsigned char>(node[child / 4]);
        const unsigned kind = (byte >> (2 * (child % 4))) & 3U;  // 0 unknown, 1 and 2 leaves, 3 inner node
        nodes += kind != 0 ? 1 : 0;
        if (kind == 3) inner |= 1U << child;
      }
      walk.enter(inner);
    } while (walk.next());
  }
  walk.finish(nodes, header.size);
}

std::unique_ptr<octomap::OcTree> parseOt(std::string_view bytes, double resolution, const std::string& name) {
  const Header header = checkedOtHeader(bytes, name);
  if (std::abs(header.resolution - resolution) > 1e-5 * resolution) {
    throw MapError(name + ": its resolution is " + shortestText(header.resolution) + ", that of the node " +
                   shortestText(resolution));
  }
  auto tree = std::make_unique<octomap::OcTree>(resolution);
  if (header.size == 0) return tree;  // OctoMap would read a root from beyond the end
  std::istringstream data(std::string(bytes.substr(header.data)), std::ios::binary);
  tree->readData(data);
  return tree;
}

}  // namespace hoctomap
