// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/mapping/ScanPipeline.h"

#include <tbb/task_group.h>

#include <chrono>
#include <exception>
#include <utility>

namespace hoctomap {

/// An item that has been taken from the source, or what the source threw instead.
struct ScanPipeline::Ahead {
  Item item;
  std::exception_ptr error;
  tbb::task_group preparing;

  ~Ahead() {
    preparing.cancel();
    try {
      preparing.wait();
    } catch (...) {
      // Nobody asked for this item any more.
    }
  }
};

ScanPipeline::ScanPipeline(MeasurementSource& source, const HierarchyMapper& mapper)
    : source_(source), mapper_(mapper) {}
ScanPipeline::~ScanPipeline() = default;

std::unique_ptr<ScanPipeline::Ahead> ScanPipeline::fetch() {
  auto ahead = std::make_unique<Ahead>();
  Item& item = ahead->item;
  try {
    const auto start = std::chrono::steady_clock::now();
    auto taken = source_.next();
    if (!taken) return nullptr;
    item.item = std::move(*taken);
    item.read_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  } catch (...) {
    ahead->error = std::current_exception();
    return ahead;
  }
  if (const auto* z = std::get_if<Measurement>(&item.item))
    ahead->preparing.run([this, z, &item] { item.prepared = mapper_.prepare(*z); });
  return ahead;
}

std::optional<ScanPipeline::Item> ScanPipeline::next() {
  if (!std::exchange(started_, true)) ahead_ = fetch();
  const std::unique_ptr<Ahead> current = std::move(ahead_);
  if (!current) return std::nullopt;
  if (current->error) std::rethrow_exception(current->error);
  ahead_ = fetch();
  current->preparing.wait();
  return std::move(current->item);
}

}  // namespace hoctomap
