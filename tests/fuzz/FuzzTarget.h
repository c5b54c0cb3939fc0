// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// What each target of this folder defines. A target is one reader of foreign bytes; linked with libFuzzer it
/// is a fuzzer, linked with replay.cpp a plain program that reads a corpus.
namespace hoctomap::fuzz {

/// Inputs that the reader accepts, to begin with.
std::vector<std::string> seeds();

/// Reads `bytes`. An error of this project (hoctomap::Error) is as good an end as none; whatever else
/// happens, an exception, a signal, a sanitizer's complaint or a broken promise (`require`), is a finding.
void read(std::string_view bytes);

/// Ends the program with a message unless `holds`.
void require(bool holds, const char* promise);

}  // namespace hoctomap::fuzz
