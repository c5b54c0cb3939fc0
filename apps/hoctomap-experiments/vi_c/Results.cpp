// SPDX-License-Identifier: BSD-3-Clause
#include "vi_c/Results.h"

#include <algorithm>
#include <functional>
#include <locale>
#include <sstream>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/CsvText.h"
#include "measuring/DrawPlot.h"
#include "measuring/Figures.h"
#include "vi_c/Statistics.h"

namespace hoctomap {

namespace {

using Trials = std::vector<const Trial*>;

std::vector<std::string> scenesOf(const std::vector<Trial>& trials) {
  std::vector<std::string> scenes;
  for (const Trial& t : trials)
    if (std::find(scenes.begin(), scenes.end(), t.scene) == scenes.end()) scenes.push_back(t.scene);
  return scenes;
}

Trials select(const std::vector<Trial>& trials, const std::string& scene, ViewMethod method) {
  Trials chosen;
  for (const Trial& t : trials)
    if (t.scene == scene && t.method == method) chosen.push_back(&t);
  return chosen;
}

std::string fixed(double value, int digits) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::fixed;
  out.precision(digits);
  out << value;
  return out.str();
}

/// `97.3 ± 1.2`
std::string interval(const std::vector<double>& values, double scale, int digits) {
  if (values.empty()) return "";
  const MeanWithInterval mean = meanOf(values);
  return fixed(scale * mean.mean, digits) + " ± " + fixed(scale * mean.half_width, digits);
}

/// Coverage of each table after its k-th view, of all trials.
std::vector<double> coverageAfter(const Trials& trials, int views) {
  std::vector<double> values;
  for (const Trial* t : trials)
    for (std::size_t table = 0; table < t->tables.size(); ++table)
      values.push_back(t->tableCoverage(table, views));
  return values;
}

/// The median with `never` for those that do not get there.
std::string medianViews(const Trials& trials, double share) {
  std::vector<double> views;
  for (const Trial* t : trials)
    for (std::size_t table = 0; table < t->tables.size(); ++table)
      views.push_back(t->viewsUntil(table, share).value_or(1000));
  const double middle = median(views);
  return middle >= 500 ? "never" : numberText(middle, 3);
}

/// Of what the trials have when they reach a coverage, and how many do not.
std::string whenReached(const Trials& trials, double share, double TrialView::*what, int digits) {
  std::vector<double> values;
  std::size_t never = 0;
  for (const Trial* t : trials) {
    const TrialView* view = t->firstWith(share);
    if (view == nullptr)
      ++never;
    else
      values.push_back(view->*what);
  }
  std::string text = interval(values, 1.0, digits);
  if (never > 0) text += (text.empty() ? "" : ", ") + std::string("never: ") + std::to_string(never);
  return text;
}

std::vector<double> each(const Trials& trials, const std::function<double(const Trial&)>& value) {
  std::vector<double> values;
  for (const Trial* t : trials) values.push_back(value(*t));
  return values;
}

std::string coverageRow(const std::string& scene, ViewMethod method, const Trials& trials) {
  std::string row = "| " + scene + " | " + toString(method) + " | ";
  for (const int views : {3, 4, 5, 8}) row += interval(coverageAfter(trials, views), 100.0, 1) + " | ";
  row +=
      medianViews(trials, 0.90) + "/" + medianViews(trials, 0.95) + "/" + medianViews(trials, 0.98) + " | ";
  row += whenReached(trials, 0.95, &TrialView::travel, 1) + " | ";
  return row + whenReached(trials, 0.95, &TrialView::seconds, 0) + " |\n";
}

struct Correlations {
  std::optional<double> pooled;
  std::vector<double> within;  ///< of each step
  std::optional<double> entropy;
};

Correlations correlationsOf(const Trials& trials) {
  std::vector<double> gains;
  std::vector<double> cells;
  std::vector<double> taken;
  std::vector<double> drops;
  Correlations c;
  for (const Trial* t : trials) {
    for (const auto& step : t->checks) {
      std::vector<double> g;
      std::vector<double> n;
      for (const GainCheck& check : step) {
        g.push_back(check.gain);
        n.push_back(check.cells);
      }
      if (const auto rho = rankCorrelation(g, n)) c.within.push_back(*rho);
      gains.insert(gains.end(), g.begin(), g.end());
      cells.insert(cells.end(), n.begin(), n.end());
    }
    for (const auto& [gain, drop] : t->entropy_drops) {
      taken.push_back(gain);
      drops.push_back(drop);
    }
  }
  c.pooled = rankCorrelation(gains, cells);
  c.entropy = rankCorrelation(taken, drops);
  return c;
}

std::string endRow(const std::string& scene, ViewMethod method, const Trials& trials) {
  const Correlations c = correlationsOf(trials);
  const auto text = [](const std::optional<double>& value) {
    return value ? fixed(*value, 2) : std::string();
  };
  const auto views = each(trials, [](const Trial& t) {
    return static_cast<double>(t.views.size() - 1) / static_cast<double>(t.tables.size());
  });
  const auto end = each(trials, [](const Trial& t) { return t.views.back().coverage; });
  const auto ended =
      std::count_if(trials.begin(), trials.end(), [](const Trial* t) { return t->ended_by_itself; });
  const auto useless =
      std::count_if(trials.begin(), trials.end(), [](const Trial* t) { return t->lastTripWasUseless(); });
  const std::string of = " of " + std::to_string(trials.size());
  return "| " + scene + " | " + toString(method) + " | " + std::to_string(ended) + of + " | " +
         interval(views, 1.0, 1) + " | " + interval(end, 100.0, 1) + " | " +
         fixed(100.0 * *std::min_element(end.begin(), end.end()), 1) + " | " + std::to_string(useless) + of +
         " | " + interval(each(trials, [](const Trial& t) { return t.views.back().travel; }), 1.0, 1) +
         " | " + text(c.pooled) + " | " + (c.within.empty() ? "" : fixed(meanOf(c.within).mean, 2)) + " | " +
         text(c.entropy) + " |\n";
}

/// What a trial has covered when it has driven so far.
double coverageAt(const Trial& trial, double travel) {
  double coverage = 0.0;
  for (const TrialView& v : trial.views)
    if (v.travel <= travel) coverage = v.coverage;
  return coverage;
}

std::string curve(const Trials& trials, bool by_travel) {
  std::string rows;
  const double end = by_travel ? 16.0 : 8.0;
  for (double x = 0.0; x <= end; x += by_travel ? 0.5 : 1.0) {
    std::vector<double> values;
    if (by_travel)
      values = each(trials, [x](const Trial& t) { return coverageAt(t, x); });
    else
      values = coverageAfter(trials, static_cast<int>(x));
    const MeanWithInterval mean = meanOf(values);
    rows += numberText(x) + " " + numberText(100.0 * mean.mean, 6) + " " +
            numberText(100.0 * mean.half_width, 6) + "\n";
  }
  return rows;
}

std::string plotCommands(const std::vector<Trial>& trials, bool by_travel) {
  static const char* const kColours[kViewMethods] = {"#0072b2", "#cc79a7", "#999999", "#d55e00", "#009e73"};
  const auto scenes = scenesOf(trials);
  std::string text =
      "set multiplot layout 1," + std::to_string(scenes.size()) +
      "\nset grid lt 1 lc rgb '#d8d8d8'\nset yrange [60:100]\nset key bottom right\nset xlabel '" +
      (by_travel ? "travel [m]" : "views of a table") + "'\n";
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    std::string plot;
    for (int m = 0; m < kViewMethods; ++m) {
      const auto method = static_cast<ViewMethod>(m);
      const Trials chosen = select(trials, scenes[s], method);
      if (chosen.empty()) continue;
      const std::string name = "$s" + std::to_string(s) + "m" + std::to_string(m);
      text += name + " << EOD\n" + curve(chosen, by_travel) + "EOD\n";
      plot += (plot.empty() ? "plot " : ", \\\n  ") + name +
              " using 1:2:3 with yerrorlines lw 1.5 pt 7 ps 0.6 lc rgb '" + kColours[m] + "' " +
              (s == 0 ? "title '" + toString(method) + "'" : "notitle");
    }
    text += "set title '" + scenes[s] + "' noenhanced\n" +
            (s == 0 ? "set ylabel 'coverage [%]'\n" : std::string("unset ylabel\n")) + plot + "\n";
  }
  return text + "unset multiplot\n";
}

}  // namespace

std::string viewsCsv(const std::vector<Trial>& trials) {
  std::string csv = "scene,method,seed,view,table,travel_m,seconds,coverage,coverage_by_table\n";
  for (const Trial& t : trials) {
    for (std::size_t i = 0; i < t.views.size(); ++i) {
      const TrialView& v = t.views[i];
      csv += t.scene + "," + toString(t.method) + "," + std::to_string(t.seed) + "," + std::to_string(i) +
             "," + (v.table ? t.tables[*v.table] : "");
      for (const double number : {v.travel, v.seconds, v.coverage}) appendNumber(csv, number);
      std::string tables;
      for (const double c : v.table_coverage) tables += (tables.empty() ? "" : " ") + numberText(c, 6);
      csv += "," + tables + "\n";
    }
  }
  return csv;
}

std::string stepsCsv(const std::vector<Trial>& trials) {
  std::string csv =
      "scene,method,seed,step,kind,best_gain,chosen_gain,cost_s,entropy_bits,unknown_in_boxes\n";
  for (const Trial& t : trials) {
    for (std::size_t i = 0; i < t.steps.size(); ++i) {
      const TrialStep& step = t.steps[i];
      csv += t.scene + "," + toString(t.method) + "," + std::to_string(t.seed) + "," + std::to_string(i) +
             "," + toString(step.kind);
      for (const double number : {step.best_gain, step.chosen_gain, step.cost, step.entropy})
        appendNumber(csv, number);
      csv += "," + std::to_string(step.unknown_in_boxes) + "\n";
    }
  }
  return csv;
}

std::string trialsCsv(const std::vector<Trial>& trials) {
  std::string csv =
      "scene,method,seed,ended_by_itself,views,travel_m,coverage,useless_last_trip,gain_correlation\n";
  for (const Trial& t : trials) {
    csv += t.scene + "," + toString(t.method) + "," + std::to_string(t.seed) + "," +
           (t.ended_by_itself ? "1" : "0") + "," + std::to_string(t.views.size() - 1);
    appendNumber(csv, t.views.back().travel);
    appendNumber(csv, t.views.back().coverage);
    csv += t.lastTripWasUseless() ? ",1" : ",0";
    const auto pooled = correlationsOf({&t}).pooled;
    csv += pooled ? "," + fixed(*pooled, 4) + "\n" : ",\n";
  }
  return csv;
}

std::string viCMarkdown(const std::vector<Trial>& trials) {
  std::string text =
      "| scene | method | coverage after 3 views of a table | 4 | 5 | 8 | median views to 90/95/98 % | m to "
      "95 % | s to "
      "95 % |\n|---|---|---|---|---|---|---|---|---|\n";
  std::string ends =
      "\n| scene | method | ended by itself | views of a table | coverage at the end | worst | useless last "
      "trip | m in "
      "all | gain and cells, pooled | within a step | gain and entropy "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const std::string& scene : scenesOf(trials)) {
    for (int m = 0; m < kViewMethods; ++m) {
      const auto method = static_cast<ViewMethod>(m);
      const Trials chosen = select(trials, scene, method);
      if (chosen.empty()) continue;
      text += coverageRow(scene, method, chosen);
      if (method == ViewMethod::recommended || method == ViewMethod::paper)
        ends += endRow(scene, method, chosen);
    }
  }
  return text + ends;
}

void drawViC(const std::vector<Trial>& trials, const std::filesystem::path& folder) {
  const std::string width =
      numberText(340.0 * static_cast<double>(std::max<std::size_t>(1, scenesOf(trials).size())));
  for (const bool by_travel : {false, true}) {
    drawPlot(
        folder / (by_travel ? "coverage_travel.png" : "coverage_views.png"),
        "set terminal pngcairo font 'sans,10' size " + width + ",400\n" + plotCommands(trials, by_travel));
  }
}

}  // namespace hoctomap
