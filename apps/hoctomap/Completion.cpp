// SPDX-License-Identifier: BSD-3-Clause
#include "Completion.h"

#include <functional>
#include <sstream>

#include "Manual.h"

namespace hoctomap {

namespace {

/// `-c --config`
std::vector<std::string> spellings(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const auto& name : option.get_snames()) names.push_back("-" + name);
  for (const auto& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

/// The words of a fixed choice: CLI11 names them in the type, as `{bt->0,ot->1}` or `{world,node}`.
std::vector<std::string> choicesOf(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{');
  const std::size_t end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos) return {};
  std::vector<std::string> words;
  std::istringstream inside(type.substr(begin + 1, end - begin - 1));
  for (std::string word; std::getline(inside, word, ',');) words.push_back(word.substr(0, word.find("->")));
  return words;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

/// Visits every command with its path: `` for the program, `/edit`, `/edit/move`.
void forEachCommand(const CLI::App& app, const std::string& path,
                    const std::function<void(const CLI::App&, const std::string&)>& visit) {
  visit(app, path);
  for (const CLI::App* command : shownCommands(app))
    forEachCommand(*command, path + "/" + command->get_name(), visit);
}

std::string valueCases(const CLI::App& command, const std::string& path) {
  std::string text;
  std::vector<std::string> files;
  for (const CLI::Option* option : shownOptions(command)) {
    if (option->get_positional() || option->get_items_expected_max() == 0) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : spellings(*option)) patterns.push_back("'" + path + " " + name + "'");
    const std::vector<std::string> choices = choicesOf(*option);
    if (choices.empty())
      files.insert(files.end(), patterns.begin(), patterns.end());
    else
      text += "    " + joined(patterns, "|") + ") words='" + joined(choices, " ") + "' ;;\n";
  }
  if (!files.empty()) text += "    " + joined(files, "|") + ") return ;;\n";
  return text;
}

}  // namespace

std::string bashCompletion(const CLI::App& program) {
  const std::string& name = program.get_name();
  std::string paths;    // what word leads from one command to the next
  std::string values;   // what may follow an option
  std::string options;  // options and commands of a command
  forEachCommand(program, "", [&](const CLI::App& command, const std::string& path) {
    if (!path.empty()) paths += (paths.empty() ? "" : "|") + path;
    values += valueCases(command, path);
    std::vector<std::string> dashed;
    for (const CLI::Option* option : shownOptions(command))
      for (const std::string& spelling : spellings(*option)) dashed.push_back(spelling);
    std::vector<std::string> commands;
    for (const CLI::App* sub : shownCommands(command)) commands.push_back(sub->get_name());
    options += "    '" + path + "') options='" + joined(dashed, " ") + "' commands='" +
               joined(commands, " ") + "' ;;\n";
  });
  return "# Completion of " + name + " for bash. Made by the program itself: hoctomap documentation DIR\n_" +
         name +
         "() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} path= words= options= commands= i\n"
         "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
         "    case $path/${COMP_WORDS[i]} in\n      " +
         paths +
         ") path=$path/${COMP_WORDS[i]} ;;\n    esac\n  done\n"
         "  COMPREPLY=()\n"
         "  # Without words, as after an option that takes a value of any kind, bash completes file names.\n"
         "  case \"$path ${COMP_WORDS[COMP_CWORD-1]}\" in\n" +
         values +
         "  esac\n"
         "  case $path in\n" +
         options +
         "  esac\n"
         "  if [[ -z $words ]]; then\n"
         "    if [[ $current == -* ]]; then words=$options; else words=$commands; fi\n"
         "  fi\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
         "}\n"
         "complete -o default -F _" +
         name + " " + name + "\n";
}

}  // namespace hoctomap
