// SPDX-License-Identifier: BSD-3-Clause
#include "Score.h"

#include <algorithm>
#include <limits>
#include <map>

namespace hoctomap {
namespace {

constexpr int kNear = 4;  // pixels by which each part is grown; what then touches is one

std::size_t at(const GreyImage& image, int u, int v) {
  return static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(u);
}

std::vector<std::uint8_t> grown(const GreyImage& truth, int object) {
  std::vector<std::uint8_t> mask(truth.values.size(), 0);
  for (int v = 0; v < truth.height; ++v) {
    for (int u = 0; u < truth.width; ++u) {
      if (truth.values[at(truth, u, v)] / 10 != object) continue;
      for (int y = std::max(0, v - kNear); y <= std::min(truth.height - 1, v + kNear); ++y) {
        const auto row = mask.begin() + static_cast<std::ptrdiff_t>(at(truth, 0, y));
        std::fill(row + std::max(0, u - kNear), row + std::min(truth.width - 1, u + kNear) + 1, 1);
      }
    }
  }
  return mask;
}

/// Replaces the ones of a mask by numbers from `next` on, one for each 8-connected part; returns the number
/// after the last.
std::uint16_t numberParts(const GreyImage& size, std::uint16_t next, std::vector<std::uint8_t> mask,
                          std::vector<std::uint16_t>& number) {
  number.assign(mask.size(), 0);
  for (std::size_t seed = 0; seed < mask.size(); ++seed) {
    if (!mask[seed]) continue;
    std::vector<std::size_t> stack{seed};
    mask[seed] = 0;
    while (!stack.empty()) {
      const auto i = stack.back();
      stack.pop_back();
      number[i] = next;
      const int u = static_cast<int>(i) % size.width;
      const int v = static_cast<int>(i) / size.width;
      for (int y = std::max(0, v - 1); y <= std::min(size.height - 1, v + 1); ++y) {
        for (int x = std::max(0, u - 1); x <= std::min(size.width - 1, u + 1); ++x) {
          if (!mask[at(size, x, y)]) continue;
          mask[at(size, x, y)] = 0;
          stack.push_back(at(size, x, y));
        }
      }
    }
    ++next;
  }
  return next;
}

/// The assignment of columns to rows with the largest sum (Hungarian method with potentials); of every row
/// the column, or -1.
std::vector<int> assign(const std::vector<std::vector<double>>& gain) {
  const std::size_t rows = gain.size();
  const std::size_t columns = rows == 0 ? 0 : gain.front().size();
  const std::size_t n = std::max(rows, columns);
  const auto cost = [&](std::size_t r, std::size_t c) { return r < rows && c < columns ? -gain[r][c] : 0.0; };
  std::vector<double> of_row(n + 1, 0.0);
  std::vector<double> of_column(n + 1, 0.0);
  std::vector<std::size_t> row_of(n + 1, 0);  // 1-based; column 0 is the start of the path
  for (std::size_t r = 1; r <= n; ++r) {
    row_of[0] = r;
    std::vector<double> least(n + 1, std::numeric_limits<double>::infinity());
    std::vector<std::size_t> from(n + 1, 0);
    std::vector<bool> used(n + 1, false);
    std::size_t column = 0;
    do {
      used[column] = true;
      const std::size_t row = row_of[column];
      double delta = std::numeric_limits<double>::infinity();
      std::size_t next = 0;
      for (std::size_t c = 1; c <= n; ++c) {
        if (used[c]) continue;
        const double reduced = cost(row - 1, c - 1) - of_row[row] - of_column[c];
        if (reduced < least[c]) {
          least[c] = reduced;
          from[c] = column;
        }
        if (least[c] < delta) {
          delta = least[c];
          next = c;
        }
      }
      for (std::size_t c = 0; c <= n; ++c) {
        if (used[c]) {
          of_row[row_of[c]] += delta;
          of_column[c] -= delta;
        } else {
          least[c] -= delta;
        }
      }
      column = next;
    } while (row_of[column] != 0);
    for (; column != 0; column = from[column]) row_of[column] = row_of[from[column]];
  }
  std::vector<int> column_of(rows, -1);
  for (std::size_t c = 1; c <= columns; ++c) {
    if (row_of[c] <= rows) column_of[row_of[c] - 1] = static_cast<int>(c - 1);
  }
  return column_of;
}

}  // namespace

SegmentationScore& SegmentationScore::operator+=(const SegmentationScore& other) {
  precision += other.precision;
  recall += other.recall;
  f += other.f;
  share75 += other.share75;
  found += other.found;
  objects += other.objects;
  return *this;
}

GreyImage joinedTruth(const GreyImage& truth) {
  GreyImage joined = truth;
  for (auto& value : joined.values) value = value == 0 ? 0 : 1;
  std::uint16_t next = 2;
  const int last =
      truth.values.empty() ? 0 : *std::max_element(truth.values.begin(), truth.values.end()) / 10;
  for (int object = 2; object <= last; ++object) {
    std::vector<std::uint16_t> number;
    next = numberParts(truth, next, grown(truth, object), number);
    for (std::size_t i = 0; i < number.size(); ++i) {
      if (truth.values[i] / 10 == object) joined.values[i] = number[i];
    }
  }
  return joined;
}

SegmentationScore scoreSegmentation(const GreyImage& found, const GreyImage& joined) {
  std::map<std::uint16_t, double> of_found;
  std::map<std::uint16_t, double> of_true;
  std::map<std::pair<std::uint16_t, std::uint16_t>, double> shared;
  for (std::size_t i = 0; i < joined.values.size(); ++i) {
    const auto t = joined.values[i];
    const auto p = t == 0 ? std::uint16_t{0} : found.values[i];
    if (t >= 2) of_true[t] += 1.0;
    if (p >= 100) of_found[p] += 1.0;
    if (t >= 2 && p >= 100) shared[{p, t}] += 1.0;
  }
  SegmentationScore score;
  score.found = static_cast<double>(of_found.size());
  score.objects = static_cast<double>(of_true.size());
  if (of_found.empty() || of_true.empty()) return score;

  std::vector<std::vector<double>> f;
  std::vector<std::vector<double>> pixels;
  double all_found = 0.0;
  double all_true = 0.0;
  for (const auto& [t, n] : of_true) all_true += n;
  for (const auto& [p, n] : of_found) {
    all_found += n;
    auto& row = f.emplace_back();
    auto& pixel_row = pixels.emplace_back();
    for (const auto& [t, m] : of_true) {
      const auto both = shared.find({p, t});
      pixel_row.push_back(both == shared.end() ? 0.0 : both->second);
      row.push_back(2.0 * pixel_row.back() / (n + m));
    }
  }
  double matched = 0.0;
  double good = 0.0;
  const auto match = assign(f);
  for (std::size_t r = 0; r < match.size(); ++r) {
    if (match[r] < 0) continue;
    matched += pixels[r][static_cast<std::size_t>(match[r])];
    good += f[r][static_cast<std::size_t>(match[r])] >= 0.75 ? 1.0 : 0.0;
  }
  score.precision = matched / all_found;
  score.recall = matched / all_true;
  if (matched > 0.0) score.f = 2.0 * score.precision * score.recall / (score.precision + score.recall);
  score.share75 = good / score.objects;
  return score;
}

}  // namespace hoctomap
