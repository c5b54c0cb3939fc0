// SPDX-License-Identifier: BSD-3-Clause
#include "changes/Reliability.h"

#include <algorithm>

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

}  // namespace hoctomap
