// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace hoctomap {

/// Opens a text file of an input. @param what for messages: "pose file"
/// @throws InputError naming it if it is missing, no regular file, or cannot be opened.
[[nodiscard]] std::ifstream openText(const std::filesystem::path& file, const std::string& what);

/// Gives the lines of a text and their numbers, from 1, to `take`, save those that are empty or begin with
/// `#` or `%`.
/// @param name stands for the text in messages
/// @throws InputError as `take` does, with name and line number before its text; also if a line is longer
///         than 4096 bytes or the text cannot be read.
void forEachLine(std::istream& in, const std::string& name,
                 const std::function<void(std::string_view, std::size_t)>& take);

/// The words of a line: what stands between blanks, tabs and carriage returns.
[[nodiscard]] std::vector<std::string_view> wordsOf(std::string_view line);

/// The same in any locale. @throws InputError for decimal commas and what is no finite number.
[[nodiscard]] double numberFrom(std::string_view word);

/// All words of a line as numbers. @throws InputError as numberFrom()
[[nodiscard]] std::vector<double> numbersFrom(std::string_view line);

}  // namespace hoctomap
