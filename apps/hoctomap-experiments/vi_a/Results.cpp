// SPDX-License-Identifier: BSD-3-Clause
#include "vi_a/Results.h"

#include <algorithm>
#include <functional>

namespace hoctomap {

namespace {

using Choose = std::function<const std::optional<Figure>&(const Point&)>;

const std::optional<Figure>& seconds(const Point& point) {
  return point.seconds;
}
const std::optional<Figure>& bytes(const Point& point) {
  return point.bytes;
}

bool isPredicted(const Figure& figure) {
  return figure.origin == Origin::part || figure.origin == Origin::law;
}

std::string cell(const std::optional<Figure>& figure, double scale) {
  if (!figure) return "-";
  return (isPredicted(*figure) ? "~" : "") + numberText(scale * figure->value, 3);
}

std::string ratio(const std::optional<Figure>& of, const std::optional<Figure>& over) {
  if (!of || !over) return "-";
  return (isPredicted(*of) || isPredicted(*over) ? "~" : "") + numberText(of->value / over->value, 3) + "x";
}

void appendTable(std::string& text, const ViAResults& results, const std::string& title, const Choose& choose,
                 double scale) {
  text += "| " + title +
          " | resolution | hierarchy | monolithic, our engine | monolithic, stock | stock / hierarchy | "
          "ours monolithic / hierarchy |\n|---|---|---|---|---|---|---|\n";
  for (const std::string& set : results.sets()) {
    for (const double mm : results.resolutionsMm()) {
      const Point* points[] = {results.find(set, mm, MapMethod::hierarchy),
                               results.find(set, mm, MapMethod::monolithic),
                               results.find(set, mm, MapMethod::stock)};
      if (std::any_of(std::begin(points), std::end(points), [](auto* p) { return p == nullptr; })) continue;
      const auto &hierarchy = choose(*points[0]), &ours = choose(*points[1]), &stock = choose(*points[2]);
      text += "| " + set + " | " + numberText(mm, 3) + " mm | " + cell(hierarchy, scale) + " | " +
              cell(ours, scale) + " | " + cell(stock, scale) + " | " + ratio(stock, hierarchy) + " | " +
              ratio(ours, hierarchy) + " |\n";
    }
  }
}

void appendFigure(std::string& text, const std::optional<Figure>& figure) {
  text += figure ? "," + numberText(figure->value) + "," + nameOf(figure->origin) : ",,";
}

}  // namespace

std::string nameOf(MapMethod method) {
  switch (method) {
    case MapMethod::hierarchy:
      return "hierarchy";
    case MapMethod::monolithic:
      return "monolithic";
    case MapMethod::stock:
      return "stock";
  }
  return {};
}

std::string nameOf(Origin origin) {
  switch (origin) {
    case Origin::measured:
      return "measured";
    case Origin::equal_map:
      return "equal_map";
    case Origin::part:
      return "predicted_from_part";
    case Origin::law:
      return "predicted_by_law";
  }
  return {};
}

const Point* ViAResults::find(const std::string& set, double resolution_mm, MapMethod method) const {
  const auto found = std::find_if(points.begin(), points.end(), [&](const Point& p) {
    return p.set == set && p.resolution_mm == resolution_mm && p.method == method;
  });
  return found == points.end() ? nullptr : &*found;
}

std::vector<std::string> ViAResults::sets() const {
  std::vector<std::string> names;
  for (const Point& point : points) {
    if (std::find(names.begin(), names.end(), point.set) == names.end()) names.push_back(point.set);
  }
  return names;
}

std::vector<double> ViAResults::resolutionsMm() const {
  std::vector<double> values;
  for (const Point& point : points) values.push_back(point.resolution_mm);
  std::sort(values.begin(), values.end(), std::greater<>());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::string pointsCsv(const ViAResults& results) {
  std::string text = "set,resolution_mm,method,seconds,seconds_origin,spread,bytes,bytes_origin,runs\n";
  for (const Point& point : results.points) {
    text += point.set + "," + numberText(point.resolution_mm) + "," + nameOf(point.method);
    appendFigure(text, point.seconds);
    text += "," + numberText(point.spread, 3);
    appendFigure(text, point.bytes);
    text += "," + std::to_string(point.runs) + "\n";
  }
  return text;
}

std::string checksCsv(const ViAResults& results) {
  std::string text = "set,resolution_mm,method,quantity,way,predicted,measured,ratio\n";
  for (const PredictionCheck& check : results.checks) {
    text += check.set + "," + numberText(check.resolution_mm) + "," + nameOf(check.method) + "," +
            check.quantity + "," + nameOf(check.way) + "," + numberText(check.predicted) + "," +
            numberText(check.measured) + "," + numberText(check.predicted / check.measured, 3) + "\n";
  }
  return text;
}

std::string checksMarkdown(const ViAResults& results) {
  std::string text =
      "| set | resolution | map | quantity | way | predicted | measured | ratio "
      "|\n|---|---|---|---|---|---|---|---|\n";
  for (const PredictionCheck& check : results.checks) {
    const double scale = check.quantity == "bytes" ? 1e-6 : 1.0;
    const char* unit = check.quantity == "bytes" ? " MB" : " s";
    text += "| " + check.set + " | " + numberText(check.resolution_mm, 3) + " mm | " + nameOf(check.method) +
            " | " + check.quantity + " | " + nameOf(check.way) + " | " +
            numberText(scale * check.predicted, 3) + unit + " | " + numberText(scale * check.measured, 3) +
            unit + " | " + numberText(check.predicted / check.measured, 3) + " |\n";
  }
  return text;
}

std::string markdownTables(const ViAResults& results) {
  std::string text;
  appendTable(text, results, "memory, MB", bytes, 1e-6);
  text += "\n";
  appendTable(text, results, "CPU seconds", seconds, 1.0);
  return text;
}

}  // namespace hoctomap
