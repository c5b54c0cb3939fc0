// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "MapQuestions.h"

namespace hoctomap {

/// For people: a line a field; what does not apply has none.
class TextAnswer final : public AnswerSink {
 public:
  void text(std::string_view name, std::string_view value) override;
  void number(std::string_view name, double value) override;
  void node(std::string_view name, NodeId value) override;
  void flag(std::string_view name, bool value) override;
  void none(std::string_view) override {}
  void nodes(std::string_view name, std::span<const NodeInRegion> values) override;
  [[nodiscard]] const std::string& result() const { return result_; }

 private:
  std::string result_;
};

/// The end of a CSV row: `,` and a field each; what does not apply is empty.
class CsvAnswer final : public AnswerSink {
 public:
  explicit CsvAnswer(std::string& rows) : rows_(rows) {}
  void text(std::string_view name, std::string_view value) override;
  void number(std::string_view name, double value) override;
  void node(std::string_view name, NodeId value) override;
  void flag(std::string_view name, bool value) override;
  void none(std::string_view) override { rows_ += ','; }
  /// One field: `3:0.52 4:1`, id and share.
  void nodes(std::string_view name, std::span<const NodeInRegion> values) override;

 private:
  std::string& rows_;
};

/// Members of an object; what does not apply is null.
class JsonAnswer final : public AnswerSink {
 public:
  /// @param question  begins the object
  JsonAnswer(std::string_view kind, std::span<const double> question);
  void text(std::string_view name, std::string_view value) override;
  void number(std::string_view name, double value) override;
  void node(std::string_view name, NodeId value) override;
  void flag(std::string_view name, bool value) override;
  void none(std::string_view name) override;
  void nodes(std::string_view name, std::span<const NodeInRegion> values) override;
  [[nodiscard]] std::string result() const;

 private:
  nlohmann::ordered_json object_;
};

}  // namespace hoctomap
