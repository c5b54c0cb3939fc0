// SPDX-License-Identifier: BSD-3-Clause
#include "performance/Comparison.h"

#include <algorithm>
#include <utility>

#include "hoctomap/geometry/Errors.h"
#include "measuring/OwnProcess.h"
#include "performance/Machine.h"

namespace hoctomap {

namespace {

constexpr double kMega = 1e6;
constexpr std::uint64_t kBoxScans = 4;  // scans for boxes, for each scan compared as a whole

const char* const kPlainStock = "stock, allocator of the C library";

double medianOf(const std::vector<Figures>& runs, const std::string& figure) {
  std::vector<double> values;
  for (const Figures& run : runs) values.push_back(run.number(figure));
  return median(values);
}

std::string millimetres(double metres) {
  return numberText(1e3 * metres, 4) + " mm";
}

std::string secondsText(double seconds) {
  return numberText(seconds, 3) + " s";
}

std::string megabytes(double bytes) {
  return numberText(bytes / kMega, 3) + " MB";
}

std::string secondsAndRatio(double seconds, double ours) {
  return secondsText(seconds) + " (" + numberText(seconds / ours, 3) + "x)";
}

bool areEqual(const std::vector<Figures>& a, const std::vector<Figures>& b) {
  return a.front().text("ot_sha256") == b.front().text("ot_sha256");
}

std::string yesOrNo(bool equal) {
  return equal ? "yes" : "NO";
}

}  // namespace

Comparison::Comparison(PerformanceOptions options, Say say)
    : options_(std::move(options)), say_(std::move(say)), csv_("measurement,variant,repeat,figure,value\n") {}

void Comparison::run(const std::function<void(const TableRow&)>& done) {
  done(wholeScans(0.01, 80));
  done(wholeScans(0.005, 80));
  done(objectBoxes(0.002, 60));
  done(objectBoxes(0.001, 90));
  for (const TableRow& row : againstMonolithic()) done(row);
  done(simulatedMemory());
  done(finestObjects());
  done(twoThreads());
  done(wholeBuild());
  done(segmentation());
  done(manyNodes());
  done(peakOfScan());
}

Task Comparison::task(const std::string& name, const std::string& variant) const {
  Task task;
  task.name = name;
  task.variant = variant;
  task.scans.log = options_.log;
  task.scans.every = std::max<std::uint64_t>(1, options_.scans_of_log / options_.scans);
  task.scans.max_scans = options_.scans;
  return task;
}

Task Comparison::mapping(const std::filesystem::path& log, double object_resolution) const {
  Task task;
  task.name = "mapping";
  task.scans.log = log;
  task.overrides.push_back("label.object.resolution=" + numberText(object_resolution));
  return task;
}

void Comparison::record(const std::string& name, const std::string& variant, int repeat,
                        const Figures& figures) {
  for (const auto& [figure, value] : figures.all()) {
    csv_ += name + "," + variant + "," + std::to_string(repeat) + "," + figure + "," + value + "\n";
  }
}

Comparison::Runs Comparison::interleaved(const std::string& name, const Variants& variants, int repeats) {
  say_("measuring: " + name);
  Runs runs;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    for (const auto& [variant, task] : variants) {
      runs[variant].push_back(*measureApart(task));  // without limits there is always a result
      record(name, variant, repeat, runs[variant].back());
    }
  }
  return runs;
}

TableRow Comparison::wholeScans(double resolution, double goal) {
  Task stock = task("whole", "stock");
  Task ours = task("whole", "ours");
  stock.resolution = ours.resolution = resolution * options_.coarsening;
  Task plain = stock;
  plain.plain_allocator = true;
  const std::string name = "whole scan, unbounded, " + millimetres(stock.resolution);
  const Runs runs =
      interleaved(name, {{kPlainStock, plain}, {"stock", stock}, {"ours", ours}}, options_.repeats);
  const double plain_s = medianOf(runs.at(kPlainStock), "user_s");
  const double stock_s = medianOf(runs.at("stock"), "user_s");
  const double ours_s = medianOf(runs.at("ours"), "user_s");
  const bool equal =
      areEqual(runs.at(kPlainStock), runs.at("ours")) && areEqual(runs.at("stock"), runs.at("ours"));
  return {name + ", user CPU of " + std::to_string(options_.scans) + " scans",
          secondsText(ours_s),
          "insertPointCloud " + secondsText(plain_s) + "; " + secondsAndRatio(stock_s, ours_s) +
              " with our allocator",
          plain_s / ours_s,
          "x",
          goal,
          true,
          yesOrNo(equal)};
}

TableRow Comparison::objectBoxes(double resolution, double goal) {
  Task ours = task("boxes", "ours");
  ours.resolution = resolution * options_.coarsening;
  // Objects are a small part of a scan: more scans for the same time.
  ours.scans.max_scans = kBoxScans * options_.scans;
  ours.scans.every = std::max<std::uint64_t>(1, options_.scans_of_log / *ours.scans.max_scans);
  Task filtering = ours;
  filtering.variant = "filtering";
  Task stock = ours;
  stock.variant = "stock";
  stock.plain_allocator = true;
  const std::string name = "objects in their boxes, " + millimetres(ours.resolution);
  const Runs runs =
      interleaved(name, {{kPlainStock, stock}, {"filtering", filtering}, {"ours", ours}}, options_.repeats);
  const double stock_s = medianOf(runs.at(kPlainStock), "user_s");
  const double filtering_s = medianOf(runs.at("filtering"), "user_s");
  const double ours_s = medianOf(runs.at("ours"), "user_s");
  const bool equal =
      areEqual(runs.at("filtering"), runs.at("ours")) && areEqual(runs.at(kPlainStock), runs.at("ours"));
  return {name + ", user CPU of " + runs.at("ours").front().text("updates") + " updates",
          secondsText(ours_s),
          "computeUpdate, filter, updateNode " + secondsText(stock_s) + "; " +
              secondsAndRatio(filtering_s, ours_s) + " with keys filtered along the beams and our allocator",
          stock_s / ours_s,
          "x",
          goal,
          true,
          yesOrNo(equal)};
}

std::vector<TableRow> Comparison::againstMonolithic() {
  const double resolution = 0.004 * options_.coarsening;
  Task stock = task("whole", "stock");
  stock.resolution = resolution;
  stock.scans.max_scans = 1;
  Task ours = mapping(options_.log, resolution);
  ours.scans = stock.scans;
  const std::string name = "hierarchy with objects at " + millimetres(resolution) + " against one map at " +
                           millimetres(resolution);
  const Runs runs = interleaved(name, {{"stock", stock}, {"ours", ours}}, options_.repeats);
  const double stock_s = medianOf(runs.at("stock"), "cpu_s");
  const double ours_s = medianOf(runs.at("ours"), "update_cpu_s");
  const double stock_bytes = runs.at("stock").front().number("map_bytes");
  const double ours_bytes = runs.at("ours").front().number("map_bytes");
  return {{name + ", CPU of the update, one scan", secondsText(ours_s),
           "insertPointCloud " + secondsText(stock_s), stock_s / ours_s, "x", 500, true, ""},
          {name + ", map memory, one scan", megabytes(ours_bytes), megabytes(stock_bytes),
           stock_bytes / ours_bytes, "x", 30, true, ""}};
}

TableRow Comparison::simulatedMemory() {
  const double resolution = 0.004 * options_.coarsening;
  const std::string name = "map memory, simulated set (all scans), " + millimetres(resolution);
  const Task hierarchy = mapping(options_.simulated, resolution);
  Task single = mapping(options_.simulated, resolution);
  single.overrides = {"mapping.monolithic=true", "label.background.resolution=" + numberText(resolution)};
  const Runs runs = interleaved(name, {{"hierarchy", hierarchy}, {"monolithic", single}}, 1);
  const double ours = runs.at("hierarchy").front().number("map_bytes");
  const double one = runs.at("monolithic").front().number("map_bytes");
  return {name, megabytes(ours), "one map " + megabytes(one), one / ours, "x", 100, true, ""};
}

TableRow Comparison::finestObjects() {
  const std::string name = "build with objects at 1 mm, peak memory";
  say_("measuring: " + name);
  const auto map = options_.output / "map_1mm";
  const Figures run =
      runApart(findHoctomap(), {"build", "-q", "-i", options_.log.string(), "-o", map.string(), "--overwrite",
                                "--set", "label.object.resolution=0.001"});
  record(name, "ours", 0, run);
  return {name + ", " + std::to_string(options_.scans_of_log) + " scans",
          secondsText(run.number("wall_s")) + " wall",
          "",
          1e-9 * run.number("max_rss_bytes"),
          " GB",
          2,
          false,
          ""};
}

TableRow Comparison::twoThreads() {
  const std::string name = "2 threads over 1, update of many nodes";
  Task one = mapping(options_.many, 0.001);
  Task two = one;
  two.threads = 2;
  const Runs runs = interleaved(name, {{"1", one}, {"2", two}}, options_.repeats);
  const double one_s = medianOf(runs.at("1"), "update_wall_s");
  const double two_s = medianOf(runs.at("2"), "update_wall_s");
  return {name + " (" + runs.at("1").front().text("nodes") + "), wall",
          secondsText(two_s),
          "1 thread " + secondsText(one_s),
          one_s / two_s,
          "x",
          1.6,
          true,
          ""};
}

TableRow Comparison::wholeBuild() {
  const std::string name = "build as a whole, objects at 2 mm, 2 threads";
  say_("measuring: " + name);
  // What the start, the first pass over the log and the scene take is the same for one scan.
  const auto map = (options_.output / "map_2mm").string();
  const std::vector<std::string> all{"build",       "-q",        "-i", options_.log.string(), "-o", map,
                                     "--overwrite", "--threads", "2"};
  std::vector<std::string> one = all;
  one.insert(one.end(), {"--max-scans", "1"});
  std::vector<double> one_s;
  std::vector<double> all_s;
  for (int repeat = 0; repeat < options_.repeats; ++repeat) {
    const Figures first = runApart(findHoctomap(), one);
    const Figures whole = runApart(findHoctomap(), all);
    record(name, "one scan", repeat, first);
    record(name, "all scans", repeat, whole);
    one_s.push_back(first.number("wall_s"));
    all_s.push_back(whole.number("wall_s"));
  }
  const double more = std::max(median(all_s) - median(one_s), 1e-3);
  return {name + ": scans after the first, with commits",
          secondsText(median(all_s)) + " wall for " + std::to_string(options_.scans_of_log) + " scans, " +
              secondsText(median(one_s)) + " for one",
          "",
          static_cast<double>(options_.scans_of_log - 1) / more,
          " scans/s",
          10,
          true,
          ""};
}

TableRow Comparison::segmentation() {
  const std::string name = "segmentation, CPU of a scan of 300,000 points";
  const Runs runs = interleaved(name, {{"ours", mapping(options_.log, 0.002)}}, options_.repeats);
  const auto& ours = runs.at("ours");
  const double seconds = medianOf(ours, "segment_cpu_s") / ours.front().number("points") * 3e5;
  return {
      name,  numberText(ours.front().number("points") / ours.front().number("scans"), 6) + " points a scan",
      "",    1e3 * seconds,
      " ms", 60,
      false, ""};
}

TableRow Comparison::manyNodes() {
  const std::string name =
      "update of a scan with " + std::to_string(options_.far_nodes) + " nodes elsewhere, over 10, CPU";
  Task few = mapping(options_.log, 0.002);
  few.warm_up = 2;
  few.far_nodes = 10;
  Task many = few;
  many.far_nodes = options_.far_nodes;
  const Runs runs = interleaved(name, {{"few", few}, {"many", many}}, options_.repeats);
  const double scans = runs.at("few").front().number("scans");
  const double few_s = medianOf(runs.at("few"), "cpu_s") / scans;
  const double many_s = medianOf(runs.at("many"), "cpu_s") / scans;
  return {name,
          numberText(1e3 * many_s, 3) + " ms a scan",
          "10 nodes " + numberText(1e3 * few_s, 3) + " ms",
          many_s / few_s,
          "x",
          1.2,
          false,
          ""};
}

TableRow Comparison::peakOfScan() {
  const std::string name =
      "peak memory of one scan at " + millimetres(0.005 * options_.coarsening) + ", above that before it";
  Task ours = task("whole", "ours");
  Task stock = task("whole", "stock");
  ours.resolution = stock.resolution = 0.005 * options_.coarsening;
  ours.scans.max_scans = stock.scans.max_scans = 1;
  const Runs runs = interleaved(name, {{"ours", ours}, {"stock", stock}}, 1);
  const double bytes = runs.at("ours").front().number("peak_bytes");
  const double stock_bytes = runs.at("stock").front().number("peak_bytes");
  return {name,
          "map itself " + megabytes(runs.at("ours").front().number("map_bytes")),
          "stock " + megabytes(stock_bytes),
          bytes / kMega,
          " MB",
          100,
          false,
          ""};
}

std::string Comparison::bounds() {
  const Figures bandwidth = interleaved("machine", {{"", task("machine", "")}}, 1).at("").front();
  std::string text = describeMachine(bandwidth);
  for (const double resolution : {0.01, 0.005}) {
    Task cells = task("cells", "");
    Task ours = task("whole", "ours");
    cells.resolution = ours.resolution = resolution * options_.coarsening;
    const std::string name = "whole scans at " + millimetres(ours.resolution);
    const Runs runs = interleaved("bound of " + name, {{"cells", cells}, {"ours", ours}}, 1);
    text += describeBound(name, runs.at("cells").front(), runs.at("ours").front(), bandwidth);
  }
  return text;
}

}  // namespace hoctomap
