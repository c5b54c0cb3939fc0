// SPDX-License-Identifier: BSD-3-Clause
#include "changes/Reliability.h"

#include <algorithm>

#include "measuring/DrawPlot.h"
#include "measuring/Figures.h"

namespace hoctomap {

Reliability reliabilityOf(std::span<const ExistenceCheck> checks) {
  Reliability r;
  if (checks.empty()) return r;
  const auto all = static_cast<double>(checks.size());
  double existing = 0.0;
  for (const ExistenceCheck& check : checks) {
    const double truth = check.exists ? 1.0 : 0.0;
    const auto bin =
        std::min<std::size_t>(r.bins.size() - 1, static_cast<std::size_t>(check.probability * 10.0));
    ++r.bins[bin].count;
    r.bins[bin].mean_probability += check.probability;
    r.bins[bin].share_existing += truth;
    r.brier += (check.probability - truth) * (check.probability - truth) / all;
    existing += truth / all;
  }
  for (auto& bin : r.bins) {
    const auto count = static_cast<double>(std::max<std::size_t>(1, bin.count));
    bin.mean_probability /= count;
    bin.share_existing /= count;
  }
  r.brier_constant = existing * (1.0 - existing);
  return r;
}

std::string reliabilityMarkdown(const Reliability& reliability) {
  const auto text = [](double value) { return numberText(value, 3); };
  std::string table = "| probability | entries | mean probability | share that exists |\n|---|---|---|---|\n";
  for (std::size_t i = 0; i < reliability.bins.size(); ++i) {
    const auto& bin = reliability.bins[i];
    if (bin.count == 0) continue;
    table += "| " + text(0.1 * static_cast<double>(i)) + " - " + text(0.1 * static_cast<double>(i + 1)) +
             " | " + std::to_string(bin.count) + " | " + text(bin.mean_probability) + " | " +
             text(bin.share_existing) + " |\n";
  }
  return table + "\nBrier score " + text(reliability.brier) +
         " (always the mean: " + text(reliability.brier_constant) + ")\n";
}

void drawReliability(const Reliability& reliability, const std::filesystem::path& folder) {
  std::string data = "$BINS << EOD\n";
  for (const auto& bin : reliability.bins) {
    if (bin.count == 0) continue;
    data += numberText(bin.mean_probability) + " " + numberText(bin.share_existing) + " " +
            std::to_string(bin.count) + "\n";
  }
  drawPlot(folder / "reliability.png",
           "set terminal pngcairo font 'sans,10' size 460,400\n" + data +
               "EOD\nset key off\nset size square\nset grid lt 1 lc rgb '#d8d8d8'\n"
               "set xlabel 'probability of existence, mean of the entries'\n"
               "set ylabel 'share of the entries whose object is there'\n"
               "set xrange [0:1.05]\nset yrange [-0.05:1.1]\n"
               "plot x with lines lc rgb '#a0a0a0', \\\n"
               "  $BINS using 1:2 with points pt 7 ps 1.5 lc rgb '#0072b2', \\\n"
               "  $BINS using 1:2:3 with labels offset -0.5,1.2 right\n");
}

}  // namespace hoctomap
