// SPDX-License-Identifier: BSD-3-Clause
#include "QuestionBatch.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <iostream>
#include <stdexcept>
#include <system_error>

#include "AnswerText.h"
#include "NumberList.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

namespace {

/// Lines of a file or of standard input, as soon as they are there.
class LineReader {
 public:
  explicit LineReader(const std::string& file) : name_(file == "-" ? "standard input" : file) {
    if (file == "-") return;
    descriptor_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0) refuse();
  }
  ~LineReader() {
    if (descriptor_ > STDIN_FILENO) ::close(descriptor_);
  }
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

  [[nodiscard]] const std::string& name() const { return name_; }

  /// Calls `take(line)` for every line that came next; false at the end.
  template <class Take>
  bool readSome(const Take& take) {
    const std::size_t kept = buffer_.size();
    buffer_.resize(kept + kChunk);
    const ssize_t got = ::read(descriptor_, buffer_.data() + kept, kChunk);
    if (got < 0 && errno != EINTR) refuse();
    buffer_.resize(kept + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    std::string_view rest = buffer_;
    for (auto end = rest.find('\n', kept); end != std::string_view::npos; end = rest.find('\n')) {
      take(rest.substr(0, end));
      rest.remove_prefix(end + 1);
    }
    if (got == 0 && !rest.empty()) {
      take(rest);
      rest = {};
    }
    if (rest.size() > kLongestLine) throw InputError(name_ + ": has a line of more than a megabyte");
    buffer_.erase(0, buffer_.size() - rest.size());
    return got != 0;
  }

 private:
  static constexpr std::size_t kChunk = 1U << 18U;
  static constexpr std::size_t kLongestLine = 1U << 20U;

  [[noreturn]] void refuse() const {
    throw InputError(name_ + ": cannot be read: " + std::generic_category().message(errno));
  }

  std::string name_;
  std::string buffer_;
  int descriptor_ = STDIN_FILENO;
};

bool beginsWithNumber(std::string_view line) {
  try {
    static_cast<void>(numberList(line.substr(0, line.find(','))));
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

/// The names of so many numbers of a question.
std::string namesOf(const QuestionForm& form, std::size_t count) {
  std::string names;
  for (const char c : form.numbers) {
    if (c == ',' && --count == 0) break;
    if (c != '[' && c != ']') names += c;
  }
  return names;
}

/// The answers to the lines so far, as text.
class Answers {
 public:
  Answers(const MapQuestions& questions, const QuestionForm& form, bool json)
      : questions_(questions), form_(form), json_(json) {}

  /// @throws std::invalid_argument if the line is no question.
  void take(std::string_view line) {
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    if (line.find_first_not_of(" \t") == std::string_view::npos) return;
    if (is_first_ && !beginsWithNumber(line)) return begin(line);
    readNumbers(line, numbers_);
    if (is_first_) begin(namesOf(form_, numbers_.size()));
    if (columns_ == 0) columns_ = numbers_.size();
    if (numbers_.size() != columns_) {
      throw std::invalid_argument(std::to_string(numbers_.size()) + " numbers, the lines before have " +
                                  std::to_string(columns_));
    }
    if (json_) {
      JsonAnswer answer(form_.name, numbers_);
      questions_.ask(form_, numbers_, answer);
      text_ += (asked_++ == 0 ? "\n" : ",\n") + answer.result();
      return;
    }
    const std::size_t before = text_.size();
    text_ += line;
    CsvAnswer answer(text_);
    try {
      questions_.ask(form_, numbers_, answer);
    } catch (const std::invalid_argument&) {
      text_.resize(before);
      throw;
    }
    text_ += '\n';
  }

  void end() {
    if (is_first_) begin(namesOf(form_, form_.counts.front()));
    if (json_) text_ += "\n]\n";
  }

  void print() {
    std::cout << text_ << std::flush;
    text_.clear();
    if (!std::cout) throw FileError("standard output: cannot be written");
  }

 private:
  void begin(std::string_view names) {
    is_first_ = false;
    if (json_) {
      text_ += '[';
    } else {
      text_.append(names).append(",").append(form_.columns).append("\n");
    }
  }

  const MapQuestions& questions_;
  const QuestionForm& form_;
  bool json_;
  bool is_first_ = true;
  std::size_t asked_ = 0;
  std::size_t columns_ = 0;
  std::vector<double> numbers_;
  std::string text_;
};

}  // namespace

void answerBatch(const MapQuestions& questions, const QuestionForm& form, const std::string& file,
                 bool json) {
  LineReader lines(file);
  Answers answers(questions, form, json);
  std::size_t number = 0;
  const auto take = [&](std::string_view line) {
    ++number;
    try {
      answers.take(line);
    } catch (const std::invalid_argument& e) {
      answers.print();
      throw InputError(lines.name() + " line " + std::to_string(number) + ": " + e.what());
    }
  };
  while (lines.readSome(take)) answers.print();
  answers.end();
  answers.print();
}

}  // namespace hoctomap
