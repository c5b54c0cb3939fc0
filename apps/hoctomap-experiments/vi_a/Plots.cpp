// SPDX-License-Identifier: BSD-3-Clause
#include "vi_a/Plots.h"

#include <algorithm>
#include <utility>

#include "hoctomap/io/CsvText.h"
#include "measuring/DrawPlot.h"

namespace hoctomap {

namespace {

struct Series {
  MapMethod method;
  std::string title;
  std::string colour;
  int filled;  ///< gnuplot's point type for what was measured
  int open;    ///< and for what was predicted
};

std::vector<Series> seriesOf(Quantity quantity) {
  const Series hierarchy{MapMethod::hierarchy, "hierarchy", "#0072b2", 7, 6};
  if (quantity == Quantity::memory) {
    return {hierarchy, {MapMethod::stock, "monolithic: stock and ours, same bytes", "#d55e00", 5, 4}};
  }
  return {hierarchy,
          {MapMethod::monolithic, "monolithic, our engine", "#009e73", 9, 8},
          {MapMethod::stock, "monolithic, stock OctoMap", "#d55e00", 5, 4}};
}

const std::optional<Figure>& figureOf(const Point& point, Quantity quantity) {
  return quantity == Quantity::memory ? point.bytes : point.seconds;
}

/// `$NAME << EOD`: resolution in mm, value, 1 if predicted.
std::string dataBlock(const ViAResults& results, const std::string& set, MapMethod method, Quantity quantity,
                      const std::string& name) {
  std::string text = "$" + name + " << EOD\n";
  for (const double mm : results.resolutionsMm()) {
    const Point* point = results.find(set, mm, method);
    if (point == nullptr || !figureOf(*point, quantity)) continue;
    const Figure& figure = *figureOf(*point, quantity);
    const bool predicted = figure.origin == Origin::part || figure.origin == Origin::law;
    text += numberText(mm) + " " +
            numberText(quantity == Quantity::memory ? 1e-6 * figure.value : figure.value) +
            (predicted ? " 1\n" : " 0\n");
  }
  return text + "EOD\n";
}

std::string panel(const ViAResults& results, const std::string& set, Quantity quantity) {
  std::string data;
  std::string plot;
  for (const Series& series : seriesOf(quantity)) {
    const std::string name = nameOf(series.method);
    data += dataBlock(results, set, series.method, quantity, name);
    const std::string colour = " lc rgb '" + series.colour + "'";
    plot += std::string(plot.empty() ? "plot " : ", \\\n  ") + "$" + name + " using 1:2 with lines lw 2" +
            colour + " notitle, \\\n  $" + name + " using 1:($3 == 0 ? $2 : NaN) with points ps 1.2 pt " +
            std::to_string(series.filled) + colour + " title '" + series.title + "', \\\n  $" + name +
            " using 1:($3 == 1 ? $2 : NaN) with points ps 1.2 lw 2 pt " + std::to_string(series.open) +
            colour + " notitle";
  }
  std::string title = set;
  for (char& c : title) {
    if (c == '_') c = ' ';
  }
  return data + "set title '" + title + "'\n" + plot + "\n";
}

/// The same range for all panels, whole decades.
std::string range(const ViAResults& results, Quantity quantity) {
  double least = 1e300;
  double most = 0.0;
  for (const Point& point : results.points) {
    if (!figureOf(point, quantity)) continue;
    least = std::min(least, figureOf(point, quantity)->value);
    most = std::max(most, figureOf(point, quantity)->value);
  }
  const double scale = quantity == Quantity::memory ? 1e-6 : 1.0;
  return "set yrange [10**floor(log10(" + numberText(scale * least) + ")):10**ceil(log10(" +
         numberText(scale * most) + "))]\n";
}

double widthOf(const ViAResults& results) {
  return 90.0 + 320.0 * static_cast<double>(results.sets().size());
}

/// One line below all panels: a key of gnuplot's must fit into a panel.
std::string legend(Quantity quantity, double width) {
  std::string text;
  double x = 40.0;
  int number = 0;
  const auto add = [&](const std::string& title, const std::string& symbol) {
    text += "set label " + std::to_string(++number) + " '" + title + "' at screen " +
            numberText(x / width, 4) + ",0.05 left offset 1,0 point ps 1.2 lw 2 pt " + symbol + "\n";
    x += 40.0 + 7.0 * static_cast<double>(title.size());
  };
  for (const Series& series : seriesOf(quantity)) {
    add(series.title, std::to_string(series.filled) + " lc rgb '" + series.colour + "'");
  }
  add("open: predicted", "4 lc rgb '#606060'");
  return text;
}

}  // namespace

std::string plotCommands(const ViAResults& results, Quantity quantity) {
  const auto sets = results.sets();
  const double width = widthOf(results);
  std::string text =
      "set multiplot layout 1," + std::to_string(sets.size()) + " margins " + numberText(75.0 / width, 4) +
      "," + numberText(1.0 - 10.0 / width, 4) + ",0.26,0.90 spacing " + numberText(30.0 / width, 4) +
      "\nset logscale x 2\nset logscale y 10\nset format y '10^{%T}'\n"
      "set grid xtics ytics lt 1 lc rgb '#d8d8d8'\nset key off\n"
      "set xlabel 'resolution of objects [mm]'\nset xtics (1,2,4,8,16,32,64,128)\nset xrange [" +
      numberText(results.resolutionsMm().back() / 1.3) + ":" +
      numberText(results.resolutionsMm().front() * 1.3) + "]\n" + range(results, quantity) +
      legend(quantity, width);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const std::string what =
        quantity == Quantity::memory ? "memory of the map [MB]" : "CPU time, all scans [s]";
    text += i == 0 ? "set ylabel '" + what + "'\n" : "unset ylabel\nset format y ''\nunset label\n";
    text += panel(results, sets[i], quantity);
  }
  return text + "unset multiplot\n";
}

void drawPlots(const ViAResults& results, const std::filesystem::path& folder) {
  for (const auto& [name, quantity] :
       {std::pair{"fig4_memory", Quantity::memory}, std::pair{"fig5_runtime", Quantity::runtime}}) {
    const std::string rest =
        " size " + numberText(widthOf(results)) + ",400\n" + plotCommands(results, quantity);
    const std::string what = "# Open symbols and ~: predicted, see docs/reproduction.md\nset terminal ";
    const std::string base = (folder / name).string();
    drawPlot(base + ".svg", what + "svg background '#ffffff' font 'sans,13'" + rest);
    drawPlot(base + ".png", what + "pngcairo font 'sans,10'" + rest);
  }
}

}  // namespace hoctomap
