// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>

#include "AnswerText.h"
#include "AtScan.h"
#include "Command.h"
#include "NumberList.h"
#include "QuestionBatch.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/OpenMap.h"

namespace hoctomap {

namespace {

struct QueryOptions {
  std::string map;
  std::map<std::string_view, std::string> asked;  ///< by kind; one of them, unless there is a batch
  std::string batch;
  std::string kind = "point";
  QuestionOptions how;
  bool json = false;
  AtScan at_scan;
};

const QuestionForm& formOf(std::string_view name) {
  const auto& forms = questionForms();
  return *std::find_if(forms.begin(), forms.end(), [&](const auto& form) { return form.name == name; });
}

/// One question of the command line.
std::string answerText(const MapQuestions& questions, const QuestionForm& form, const std::string& asked,
                       bool json) {
  try {
    const std::vector<double> numbers = numberList(asked);
    if (json) {
      JsonAnswer answer(form.name, numbers);
      questions.ask(form, numbers, answer);
      return answer.result() + "\n";
    }
    TextAnswer answer;
    questions.ask(form, numbers, answer);
    return answer.result();
  } catch (const std::invalid_argument& e) {
    throw ConfigError("--" + std::string(form.name) + " " + escapedText(asked, 100) + ": " + e.what());
  }
}

int query(const QueryOptions& options) {
  if (options.asked.size() + (options.batch.empty() ? 0 : 1) != 1) {
    throw ConfigError(
        "query wants one question: --point, --ray, --box, --sphere, --distance, --unknown, "
        "--objects or --batch FILE");
  }
  const auto map = std::make_shared<const OpenMap>(options.map, options.at_scan);
  noteOlderState(options.map, map->scans(), options.at_scan);
  const MapQuestions questions(map, options.how);
  if (!options.batch.empty()) {
    answerBatch(questions, formOf(options.kind), options.batch, options.json);
    return 0;
  }
  const auto& [name, asked] = *options.asked.begin();
  std::cout << answerText(questions, formOf(name), asked, options.json) << std::flush;
  return 0;
}

}  // namespace

void addQueryCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<QueryOptions>();
  CLI::App* command = addCommand(
      app, "query", "Ask a map: what is at a point, along a ray, in a box, how far is the next surface",
      {"hoctomap query map --point 0.4,0.1,0.75",
       "hoctomap query map --ray 0,0,1.5,1,0,-0.7 --ignore-unknown",
       "hoctomap query map --box 0.4,0,0.8,0.1,0.1,0.2,30 --json",
       "hoctomap query map --batch points.csv > answers.csv"});
  command->add_option("map", options->map, "map directory")->type_name("DIR")->required();
  std::vector<std::string> kinds;
  for (const QuestionForm& form : questionForms()) {
    std::string numbers(form.numbers);
    std::transform(numbers.begin(), numbers.end(), numbers.begin(),
                   [](char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); });
    command
        ->add_option_function<std::string>(
            "--" + std::string(form.name),
            [options, name = form.name](const std::string& value) { options->asked[name] = value; },
            std::string(form.what))
        ->type_name(numbers);
    kinds.emplace_back(form.name);
  }
  auto* batch =
      command
          ->add_option("--batch", options->batch,
                       "a CSV file of questions, one a line, `-` for standard input; answers as CSV")
          ->type_name("FILE");
  command->add_option("--kind", options->kind, "of the questions in the batch (default: point)")
      ->check(CLI::IsMember(kinds))
      ->needs(batch)
      ->type_name("KIND");
  command->add_flag("--ignore-unknown", options->how.ray.ignore_unknown,
                    "rays go on through what is unknown, instead of ending there");
  command->add_option("--max-range", options->how.ray.max_range, "of rays and distances, m")
      ->check(CLI::NonNegativeNumber)
      ->type_name("M");
  command->add_option("--step", options->how.step, "of --unknown: edge of the cells that are looked at, m")
      ->check(CLI::PositiveNumber)
      ->type_name("M");
  command
      ->add_option("--min-existence", options->how.query.min_existence,
                   "leave out nodes that are less likely to exist")
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("P");
  command->add_flag("--json", options->json, "for programs");
  addAtScan(*command, options->at_scan);
  command->callback([options, &action] { action = [options] { return query(*options); }; });
}

}  // namespace hoctomap
