// SPDX-License-Identifier: BSD-3-Clause
#include "vi_a/Runs.h"

#include <algorithm>
#include <map>
#include <utility>

#include "measuring/OwnProcess.h"
#include "vi_a/Prediction.h"

namespace hoctomap {

namespace {

/// For the guard: growth of a map from one resolution to the next, at least; and what the heap takes for a
/// byte of OctoMap's memoryUsage().
constexpr double kLeastGrowth = 8.0;
constexpr double kHeapOverhead = 2.0;

class ViARun {
 public:
  ViARun(const ViAOptions& options, const KnownRuns& known,
         const std::function<void(const std::string&)>& say,
         const std::function<void(const std::string&)>& runs_csv)
      : options_(options), known_(known), say_(say), runs_csv_(runs_csv) {}

  void add(const ScanSet& set) {
    for (const double mm : options_.resolutions_mm) addResolution(set, mm);
    predict(set);
    check(set);
  }

  [[nodiscard]] ViAResults results() && { return std::move(results_); }

 private:
  void addResolution(const ScanSet& set, double mm) {
    std::vector<MapMethod> methods{MapMethod::hierarchy};
    const bool fits = monolithicFits(set, mm);
    if (mm >= options_.monolithic_to_mm && fits) methods.push_back(MapMethod::monolithic);
    if (mm >= options_.stock_to_mm && fits) methods.push_back(MapMethod::stock);
    // Interleaved, so that a machine that is busy for a while is busy for all.
    std::vector<std::vector<Figures>> runs(methods.size());
    for (int repeat = 0; repeat < options_.repeats; ++repeat) {
      for (std::size_t i = 0; i < methods.size(); ++i) {
        if (methods[i] == MapMethod::stock && repeat >= options_.stock_repeats) continue;
        const Task task = taskOf(set, mm, methods[i]);
        if (auto figures = run(set, mm, methods[i], task, repeat)) runs[i].push_back(std::move(*figures));
      }
    }
    for (const MapMethod method : {MapMethod::hierarchy, MapMethod::monolithic, MapMethod::stock}) {
      Point point{set.name, mm, method, {}, 0.0, {}, 0, {}};
      const auto found = std::find(methods.begin(), methods.end(), method);
      if (found != methods.end()) fill(point, runs[static_cast<std::size_t>(found - methods.begin())]);
      results_.points.push_back(std::move(point));
    }
    compareMaps(set, mm);
    runPartOfStock(set, mm, fits);
  }

  [[nodiscard]] Task taskOf(const ScanSet& set, double mm, MapMethod method) const {
    Task task;
    task.scans.log = set.log;
    task.config = options_.config;
    task.resolution = 1e-3 * mm;
    if (method == MapMethod::stock) {
      task.name = "whole";
      task.variant = "stock";
    } else {
      task.name = "mapping";
      const std::string label = method == MapMethod::hierarchy ? "object" : "background";
      task.overrides.push_back("label." + label + ".resolution=" + numberText(1e-3 * mm));
      if (method == MapMethod::monolithic) task.overrides.emplace_back("mapping.monolithic=true");
    }
    // The address space is more than the memory in use; what the limit must prevent is swapping.
    task.limits.memory_bytes = availableMemory();
    return task;
  }

  std::optional<Figures> run(const ScanSet& set, double mm, MapMethod method, const Task& task, int repeat) {
    const std::size_t scans = (set.scans - task.scans.start + task.scans.every - 1) / task.scans.every;
    const std::string key = set.name + "," + numberText(mm) + "," + nameOf(method) + "," +
                            std::to_string(scans) + "," + std::to_string(repeat);
    const auto known = known_.find(key);
    const auto figures = known != known_.end() ? std::optional(known->second) : measureApart(task);
    if (!figures) {
      say_(key + ": does not fit in memory");
      return figures;
    }
    points_of_set_[set.name] = std::max(points_of_set_[set.name], figures->number("points"));
    if (known != known_.end()) return figures;
    say_(key + ": " + numberText(figures->number("cpu_s"), 3) + " s, " +
         numberText(1e-6 * figures->number("map_bytes"), 3) + " MB");
    runs_csv_(runsCsvLine(key, *figures));
    return figures;
  }

  static void fill(Point& point, const std::vector<Figures>& runs) {
    if (runs.empty()) return;
    std::vector<double> seconds;
    for (const Figures& run : runs) seconds.push_back(run.number("cpu_s"));
    const double middle = median(seconds);
    const auto [least, most] = std::minmax_element(seconds.begin(), seconds.end());
    point.seconds = Figure{middle, Origin::measured};
    point.spread = (*most - *least) / middle;
    point.bytes = Figure{runs.front().number("map_bytes"), Origin::measured};
    point.runs = runs.size();
    if (runs.front().contains("ot_sha256")) point.ot_sha256 = runs.front().text("ot_sha256");
  }

  void compareMaps(const ScanSet& set, double mm) {
    const Point& ours = at(set, mm, MapMethod::monolithic);
    const Point& stock = at(set, mm, MapMethod::stock);
    if (ours.runs == 0 || stock.runs == 0) return;
    ++(ours.ot_sha256 == stock.ot_sha256 ? results_.equal_maps : results_.unequal_maps);
  }

  /// Stock on some scans, evenly spread: where all would take too long, and at the finest resolution of all
  /// scans, to check what the part predicts.
  void runPartOfStock(const ScanSet& set, double mm, bool fits) {
    const bool is_check = mm == finestOfStock();
    if (!fits || mm < options_.stock_part_to_mm || (mm >= options_.stock_to_mm && !is_check)) return;
    Task task = taskOf(set, mm, MapMethod::stock);
    task.scans.every = (set.scans + options_.stock_part_scans - 1) / options_.stock_part_scans;
    task.scans.start = task.scans.every / 2;
    if (is_check && task.scans.every == 1) return;  // the part would be the whole
    const auto figures = run(set, mm, MapMethod::stock, task, 0);
    if (!figures) return;
    const double all =
        predictAll(figures->number("cpu_s"), static_cast<std::size_t>(figures->number("points")),
                   static_cast<std::size_t>(points_of_set_[set.name]));
    Point& stock = at(set, mm, MapMethod::stock);
    if (stock.seconds) {
      results_.checks.push_back(
          {set.name, mm, MapMethod::stock, "seconds", Origin::part, all, stock.seconds->value});
    } else {
      stock.seconds = Figure{all, Origin::part};
    }
  }

  [[nodiscard]] double finestOfStock() const {
    double finest = options_.resolutions_mm.front();
    for (const double mm : options_.resolutions_mm) {
      if (mm >= options_.stock_to_mm) finest = mm;
    }
    return finest;
  }

  [[nodiscard]] bool monolithicFits(const ScanSet& set, double mm) const {
    const Point* twice = results_.find(set.name, 2.0 * mm, MapMethod::monolithic);
    const Point* four_times = results_.find(set.name, 4.0 * mm, MapMethod::monolithic);
    if (twice == nullptr) return true;  // the first one
    if (!twice->bytes) return false;
    double growth = kLeastGrowth;
    if (four_times != nullptr) growth = std::max(growth, twice->bytes->value / four_times->bytes->value);
    return kHeapOverhead * growth * twice->bytes->value < 0.5 * static_cast<double>(availableMemory());
  }

  /// Fills in what was not measured: the map of stock is ours, byte for byte; the rest by the law.
  void predict(const ScanSet& set) {
    for (const double mm : options_.resolutions_mm) {
      for (const MapMethod method : {MapMethod::monolithic, MapMethod::stock}) {
        Point& point = at(set, mm, method);
        if (method == MapMethod::stock && !point.bytes) {
          point.bytes = at(set, mm, MapMethod::monolithic).bytes;
          if (point.bytes && point.bytes->origin == Origin::measured) point.bytes->origin = Origin::equal_map;
        }
        if (!point.bytes) point.bytes = byLaw(set, mm, method, &Point::bytes);
        if (!point.seconds) point.seconds = byLaw(set, mm, method, &Point::seconds);
      }
    }
  }

  /// The law at the finest resolution at which there is something to compare it with.
  void check(const ScanSet& set) {
    for (const MapMethod method : {MapMethod::monolithic, MapMethod::stock}) {
      checkLaw(set, method, "bytes", &Point::bytes);
      checkLaw(set, method, "seconds", &Point::seconds);
    }
  }

  void checkLaw(const ScanSet& set, MapMethod method, const std::string& quantity,
                std::optional<Figure> Point::*member) {
    for (auto mm = options_.resolutions_mm.rbegin(); mm != options_.resolutions_mm.rend(); ++mm) {
      const auto& known = at(set, *mm, method).*member;
      if (!known || known->origin == Origin::law || known->origin == Origin::equal_map) continue;
      if (const auto law = byLaw(set, *mm, method, member)) {
        results_.checks.push_back({set.name, *mm, method, quantity, Origin::law, law->value, known->value});
      }
      return;
    }
  }

  [[nodiscard]] std::optional<Figure> byLaw(const ScanSet& set, double mm, MapMethod method,
                                            std::optional<Figure> Point::*member) const {
    const Point* twice = results_.find(set.name, 2.0 * mm, method);
    const Point* four_times = results_.find(set.name, 4.0 * mm, method);
    if (twice == nullptr || four_times == nullptr) return std::nullopt;
    if (!(twice->*member) || !(four_times->*member)) return std::nullopt;
    return Figure{predictFiner((four_times->*member)->value, (twice->*member)->value), Origin::law};
  }

  [[nodiscard]] Point& at(const ScanSet& set, double mm, MapMethod method) {
    return *std::find_if(results_.points.begin(), results_.points.end(), [&](const Point& p) {
      return p.set == set.name && p.resolution_mm == mm && p.method == method;
    });
  }

  const ViAOptions& options_;
  const KnownRuns& known_;
  const std::function<void(const std::string&)>& say_;
  const std::function<void(const std::string&)>& runs_csv_;
  std::map<std::string, double> points_of_set_;
  ViAResults results_;
};

}  // namespace

ViAResults runViA(const ViAOptions& options, const std::vector<ScanSet>& sets, const KnownRuns& known,
                  const std::function<void(const std::string&)>& say,
                  const std::function<void(const std::string&)>& runs_csv) {
  ViARun run(options, known, say, runs_csv);
  for (const ScanSet& set : sets) run.add(set);
  return std::move(run).results();
}

}  // namespace hoctomap
