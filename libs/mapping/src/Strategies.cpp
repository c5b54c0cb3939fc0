// SPDX-License-Identifier: BSD-3-Clause
// Adapters that make a strategy from a lambda.
#include <numeric>
#include <utility>

#include "hoctomap/mapping/AssociationFunction.h"
#include "hoctomap/mapping/LabelingFunction.h"
#include "hoctomap/mapping/Segmentation.h"

namespace hoctomap {

namespace {

class LambdaSegmentation : public Segmentation {
 public:
  explicit LambdaSegmentation(std::function<std::vector<Segment>(const Measurement&)> f) : f_(std::move(f)) {}
  [[nodiscard]] std::vector<Segment> segment(const Measurement& z) const override { return f_(z); }

 private:
  std::function<std::vector<Segment>(const Measurement&)> f_;
};

class LambdaLabeling : public LabelingFunction {
 public:
  explicit LambdaLabeling(std::function<Label(const Measurement&, const Segment&)> f) : f_(std::move(f)) {}
  [[nodiscard]] Label label(const Measurement& z, const Segment& segment) const override {
    return f_(z, segment);
  }

 private:
  std::function<Label(const Measurement&, const Segment&)> f_;
};

using Associate =
    std::function<std::optional<NodeId>(const MapHierarchy&, const LabelledSegment&, const Admissible&)>;

class LambdaAssociation : public AssociationFunction {
 public:
  explicit LambdaAssociation(Associate f) : f_(std::move(f)) {}
  [[nodiscard]] std::optional<NodeId> associate(const MapHierarchy& hierarchy, const LabelledSegment& segment,
                                                const Admissible& admissible) const override {
    return f_(hierarchy, segment, admissible);
  }

 private:
  Associate f_;
};

}  // namespace

std::unique_ptr<Segmentation> makeSegmentation(
    std::function<std::vector<Segment>(const Measurement&)> segment) {
  return std::make_unique<LambdaSegmentation>(std::move(segment));
}

std::unique_ptr<Segmentation> makeWholeSegmentation() {
  return makeSegmentation([](const Measurement& z) {
    Segment whole;
    whole.points.resize(z.world_points.size());
    std::iota(whole.points.begin(), whole.points.end(), 0U);
    return std::vector<Segment>{std::move(whole)};
  });
}

std::unique_ptr<LabelingFunction> makeLabeling(
    std::function<Label(const Measurement&, const Segment&)> label) {
  return std::make_unique<LambdaLabeling>(std::move(label));
}

std::unique_ptr<AssociationFunction> makeAssociation(Associate associate) {
  return std::make_unique<LambdaAssociation>(std::move(associate));
}

}  // namespace hoctomap
