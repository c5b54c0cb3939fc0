// SPDX-License-Identifier: BSD-3-Clause
#include "Mutation.h"

#include <algorithm>
#include <cstddef>

namespace hoctomap::fuzz {

std::string mutated(std::string text, std::mt19937_64& random) {
  const auto below = [&](std::size_t end) { return static_cast<std::size_t>(random() % end); };
  for (std::size_t changes = 1 + below(4); changes > 0 && !text.empty(); --changes) {
    const std::size_t at = below(text.size());
    switch (below(5)) {
      case 0:
        text[at] = static_cast<char>(random());
        break;
      case 1:
        text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
        break;
      case 2:  // counts and lengths
        for (std::size_t i = at; i < std::min(at + 4, text.size()); ++i) text[i] = '\xff';
        break;
      case 3:
        text.erase(at, 1 + below(40));
        break;
      default: {
        const std::string piece = text.substr(at, 1 + below(200));
        text.insert(below(text.size()), piece);
      }
    }
  }
  return text;
}

}  // namespace hoctomap::fuzz
