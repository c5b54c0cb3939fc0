// SPDX-License-Identifier: BSD-3-Clause
#include "MapRun.h"

#include <chrono>
#include <utility>

#include "StopSignal.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

MapRun::MapRun(const Settings& settings, HierarchyMapper& mapper, MapDirectory& directory, RunLog& log,
               Options options, MotionLedger& motions)
    : settings_(settings),
      mapper_(mapper),
      directory_(directory),
      log_(log),
      options_(std::move(options)),
      motions_(motions),
      next_scan_(options_.first_scan),
      last_stamp_(options_.last_stamp),
      summary_(options_.mapped_scans, options_.skipped_scans),
      memory_(settings.limits.max_memory) {}

void MapRun::run(PipeSource& source, Progress& progress) {
  ScanPipeline pipeline(source, mapper_);
  while (StopSignal::requested() == 0) {
    auto next = pipeline.next();
    if (!next) break;
    summary_.addSeconds("read", next->read_seconds);
    if (const auto* z = std::get_if<Measurement>(&next->item)) {
      integrate(*z, std::move(*next->prepared), next->read_seconds);
    } else if (const auto* motion = std::get_if<ObjectMotion>(&next->item)) {
      if (motions_.takeFromLog()) integrate(*motion, next_scan_);
    } else {
      const auto& skipped = std::get<SkippedScan>(next->item);
      last_stamp_ = skipped.stamp;
      summary_.addSkipped(skipped);
      directory_.append(ScanRow{.scan = skipped.scan, .stamp = skipped.stamp, .skipped = skipped.reason});
      log_.warn("scans skipped: " + skipped.reason + " (first: scan " + std::to_string(skipped.scan) + ")");
      finishScan(skipped.scan);
    }
    progress.show(summary_.used() + summary_.skipped(), mapper_.hierarchy().size());
  }
  if (StopSignal::requested() == 0) finishLog();
  commit(false);
  for (const ToldMotion& motion : motions_.left()) {
    log_.warn("events: line " + std::to_string(motion.line) +
              " is for later than the last scan and was not used");
  }
}

/// Nodes that still wait for confirmation: those that enough speaks for enter the map.
void MapRun::finishLog() {
  if (next_scan_ == 0) return;
  const UpdateReport report = mapper_.finish(next_scan_ - 1, last_stamp_);
  summary_.addReport(report);
  directory_.appendEnd(report);
  checkLimits(report);
}

void MapRun::applyToldMotions(const Measurement& z) {
  for (const ToldMotion& told : motions_.takeDue(z.scan, z.stamp)) {
    if (const auto node = findNode(mapper_.hierarchy(), told)) {
      integrate(ObjectMotion{z.stamp, *node, motionInNodeFrame(mapper_.hierarchy(), *node, told)}, z.scan);
    } else {
      log_.warn("events: line " + std::to_string(told.line) + " is about no movable node and was not used");
    }
  }
}

void MapRun::integrate(const Measurement& z, PreparedScan prepared, double read_seconds) {
  try {
    memory_.requireRoom(z.scan);
  } catch (const LimitError&) {
    commit(false);  // the scans before it are whole
    throw;
  }
  applyToldMotions(z);
  last_stamp_ = z.stamp;
  const UpdateReport report = mapper_.integrate(z, std::move(prepared));
  summary_.addUsed(z);
  summary_.addReport(report);
  directory_.append(report);
  directory_.append(scanRow(z));
  for (const auto& event : report.events) {
    if (event.kind == NodeEventKind::updated) continue;
    log_.debug("scan " + std::to_string(z.scan) + ": " + event.label.name + " " +
               std::to_string(event.node.value) + " " + toString(event.kind) + " (" + event.detail + ")");
  }
  checkLimits(report);
  TimingRow row{z.scan, z.world_points.size(), read_seconds, report.seconds, 0.0};
  const auto start = Clock::now();
  finishScan(z.scan);
  row.write_s = secondsSince(start);
  directory_.append(row);
}

void MapRun::checkLimits(const UpdateReport& report) const {
  const MapHierarchy& map = mapper_.hierarchy();
  const std::string scan = "scan " + std::to_string(report.scan) + ": ";
  if (map.size() > static_cast<std::size_t>(settings_.limits.max_nodes)) {
    throw LimitError(scan + "the map has more than " + std::to_string(settings_.limits.max_nodes) +
                     " nodes ([limits] max_nodes)");
  }
  for (const NodeEvent& event : report.events) {
    if (event.kind == NodeEventKind::created && map.contains(event.node) &&
        map.depth(event.node) > static_cast<std::size_t>(settings_.limits.max_depth)) {
      throw LimitError(scan + "the hierarchy is deeper than " + std::to_string(settings_.limits.max_depth) +
                       " ([limits] max_depth)");
    }
  }
}

void MapRun::integrate(const ObjectMotion& motion, std::uint64_t scan) {
  const UpdateReport report = mapper_.integrate(motion, scan);
  for (const auto& warning : report.warnings) log_.warn(warning);
  directory_.append(report);
}

/// When to commit, and what to keep, goes by the number of the scan alone, so that a run that was stopped and
/// continued leaves the same files.
void MapRun::finishScan(std::uint64_t scan) {
  const auto crossed = [&](std::uint64_t every) { return (scan + 1) / every != next_scan_ / every; };
  const bool snapshot = options_.snapshot_every > 0 && crossed(options_.snapshot_every);
  const bool checkpoint = crossed(static_cast<std::uint64_t>(settings_.checkpoint_scans));
  next_scan_ = scan + 1;
  motions_.finishScan();
  if (snapshot || checkpoint) commit(snapshot);
}

void MapRun::commit(bool keep) {
  const auto start = Clock::now();
  directory_.commit({mapper_.hierarchy(), mapper_.removed(), next_scan_, options_.input, keep, last_stamp_,
                     &mapper_.seams(), mapper_.sensor(), motions_.taken(), summary_.mappedInAll(),
                     summary_.skippedInAll()});
  summary_.addSeconds("write", secondsSince(start));
}

}  // namespace hoctomap
