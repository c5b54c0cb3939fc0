// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "hoctomap/query/HierarchyQuery.h"

namespace hoctomap {

/// What one can ask of a map, and by which numbers.
enum class QuestionKind { point, ray, box, sphere, distance, unknown, objects };

struct QuestionForm {
  QuestionKind kind;
  std::string_view name;            ///< of the option and of `--kind`
  std::string_view numbers;         ///< what they are, `x,y,z`; further ones may follow in brackets
  std::string_view columns;         ///< of the answer in CSV
  std::string_view what;            ///< for the help
  std::vector<std::size_t> counts;  ///< how many numbers there may be
};
[[nodiscard]] const std::vector<QuestionForm>& questionForms();

/// Takes the fields of an answer, in the order of `QuestionForm::columns`.
class AnswerSink {
 public:
  virtual ~AnswerSink() = default;
  virtual void text(std::string_view name, std::string_view value) = 0;
  virtual void number(std::string_view name, double value) = 0;
  virtual void node(std::string_view name, NodeId value) = 0;
  virtual void flag(std::string_view name, bool value) = 0;
  virtual void none(std::string_view name) = 0;
  /// Nodes in a region, with their labels.
  virtual void nodes(std::string_view name, std::span<const NodeInRegion> values) = 0;
};

struct QuestionOptions {
  QueryConfig query;
  RayOptions ray;     ///< `max_range` holds for distances, too
  double step = 0.0;  ///< m, of `unknown`; 0: by resolution
};

/// Questions in numbers, answered field by field.
class MapQuestions {
 public:
  MapQuestions(std::shared_ptr<const NodeSource> map, const QuestionOptions& options)
      : map_(std::move(map)), options_(options), query_(map_, options.query) {}

  /// @throws std::invalid_argument if the numbers make no question of this kind.
  void ask(const QuestionForm& form, std::span<const double> numbers, AnswerSink& answer) const;

 private:
  void askPoint(const Eigen::Vector3d& p, AnswerSink& answer) const;
  void askRay(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, AnswerSink& answer) const;
  void askDistance(const Eigen::Vector3d& p, AnswerSink& answer) const;
  void tellCollision(std::optional<NodeId> node, AnswerSink& answer) const;
  void tellNode(std::optional<NodeId> node, AnswerSink& answer) const;

  std::shared_ptr<const NodeSource> map_;
  QuestionOptions options_;
  HierarchyQuery query_;
};

}  // namespace hoctomap
