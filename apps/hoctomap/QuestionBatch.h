// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "MapQuestions.h"

namespace hoctomap {

/// Answers the questions of a CSV file, one a line (`-`: of standard input), on standard output: each line as
/// it came and the columns of its answer, or with `json` an array of objects. A first line that does not
/// begin with a number names the columns. Empty lines are passed over. Answers come as the lines do, so that
/// a program may ask through a pipe.
/// @throws InputError naming file and line; what comes before that line has been answered.
///         FileError if standard output cannot be written.
void answerBatch(const MapQuestions& questions, const QuestionForm& form, const std::string& file, bool json);

}  // namespace hoctomap
