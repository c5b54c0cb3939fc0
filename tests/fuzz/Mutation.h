// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>
#include <string>

namespace hoctomap::fuzz {

/// A few random changes: bytes, bits, counts, pieces cut out and repeated.
std::string mutated(std::string text, std::mt19937_64& random);

}  // namespace hoctomap::fuzz
