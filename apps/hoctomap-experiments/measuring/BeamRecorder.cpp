// SPDX-License-Identifier: BSD-3-Clause
#include "measuring/BeamRecorder.h"

#include <utility>

namespace hoctomap {

namespace {

class BeamRecorder : public ScanUpdate {
 public:
  BeamRecorder(std::unique_ptr<ScanUpdate> engine, double resolution, BeamRecord& record)
      : engine_(std::move(engine)), resolution_(resolution), record_(record) {}

  ScanUpdateReport apply(octomap::OcTree& tree, const Beams& beams) const override {
    if (tree.getResolution() == resolution_) add(tree, beams);
    return engine_->apply(tree, beams);
  }

 private:
  void add(const octomap::OcTree& tree, const Beams& beams) const {
    const std::lock_guard lock(mutex_);
    // An empty tree is a new one, though it may stand where one stood that is gone.
    if (tree.size() == 0 || !numbers_.contains(&tree)) numbers_[&tree] = record_.trees++;
    RecordedUpdate update{numbers_[&tree],
                          {beams.hits.begin(), beams.hits.end()},
                          {beams.passing.begin(), beams.passing.end()},
                          beams};
    update.beams.hits = {};
    update.beams.passing = {};
    record_.updates.push_back(std::move(update));
  }

  std::unique_ptr<ScanUpdate> engine_;
  double resolution_;
  BeamRecord& record_;
  mutable std::mutex mutex_;
  mutable std::map<const octomap::OcTree*, std::size_t> numbers_;
};

}  // namespace

Beams RecordedUpdate::view() const {
  Beams result = beams;
  result.hits = hits;
  result.passing = passing;
  return result;
}

std::unique_ptr<ScanUpdate> makeBeamRecorder(std::unique_ptr<ScanUpdate> engine, double resolution,
                                             BeamRecord& record) {
  return std::make_unique<BeamRecorder>(std::move(engine), resolution, record);
}

}  // namespace hoctomap
