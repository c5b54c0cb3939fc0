// SPDX-License-Identifier: BSD-3-Clause
#include "AnswerText.h"

#include "TextTable.h"
#include "hoctomap/io/CsvText.h"
#include "hoctomap/io/EscapedText.h"

namespace hoctomap {

namespace {

std::string line(std::string_view name, const std::string& value) {
  constexpr std::size_t kWidth = 15;
  std::string text(name);
  text.resize(kWidth, ' ');
  return text + value + "\n";
}

}  // namespace

void TextAnswer::text(std::string_view name, std::string_view value) {
  result_ += line(name, escapedText(value));
}
void TextAnswer::number(std::string_view name, double value) {
  result_ += line(name, fixedText(value, 4));
}
void TextAnswer::node(std::string_view name, NodeId value) {
  result_ += line(name, std::to_string(value.value));
}
void TextAnswer::flag(std::string_view name, bool value) {
  result_ += line(name, value ? "yes" : "no");
}
void TextAnswer::nodes(std::string_view, std::span<const NodeInRegion> values) {
  if (values.empty()) {
    result_ += "no table or object in it\n";
    return;
  }
  TextTable table({"node", "label", "existence", "share"});
  for (const NodeInRegion& found : values) {
    table.add({std::to_string(found.node.value), escapedText(found.label.name), fixedText(found.existence, 3),
               fixedText(found.share, 3)});
  }
  result_ += table.text();
}

void CsvAnswer::text(std::string_view, std::string_view value) {
  rows_ += ',';
  rows_ += csvField(value);
}
void CsvAnswer::number(std::string_view, double value) {
  appendNumber(rows_, value);
}
void CsvAnswer::node(std::string_view, NodeId value) {
  rows_ += ',';
  rows_ += std::to_string(value.value);
}
void CsvAnswer::flag(std::string_view, bool value) {
  rows_ += value ? ",1" : ",0";
}
void CsvAnswer::nodes(std::string_view, std::span<const NodeInRegion> values) {
  rows_ += ',';
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) rows_ += ' ';
    rows_ += std::to_string(values[i].node.value) + ":" + fixedText(values[i].share, 4);
  }
}

JsonAnswer::JsonAnswer(std::string_view kind, std::span<const double> question) {
  object_["question"] = kind;
  object_["numbers"] = std::vector<double>(question.begin(), question.end());
}
void JsonAnswer::text(std::string_view name, std::string_view value) {
  object_[std::string(name)] = value;
}
void JsonAnswer::number(std::string_view name, double value) {
  object_[std::string(name)] = value;
}
void JsonAnswer::node(std::string_view name, NodeId value) {
  object_[std::string(name)] = value.value;
}
void JsonAnswer::flag(std::string_view name, bool value) {
  object_[std::string(name)] = value;
}
void JsonAnswer::none(std::string_view name) {
  object_[std::string(name)] = nullptr;
}
void JsonAnswer::nodes(std::string_view name, std::span<const NodeInRegion> values) {
  auto list = nlohmann::ordered_json::array();
  for (const NodeInRegion& found : values) {
    list.push_back({{"node", found.node.value},
                    {"label", found.label.name},
                    {"existence", found.existence},
                    {"share", found.share}});
  }
  object_[std::string(name)] = std::move(list);
}
std::string JsonAnswer::result() const {
  return object_.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace hoctomap
