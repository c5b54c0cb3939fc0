// SPDX-License-Identifier: BSD-3-Clause
#include "Manual.h"

#include <sstream>

namespace hoctomap {

namespace {

/// Text that roff shows as it is.
std::string plain(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else if ((c == '.' || c == '\'') && (result.empty() || result.back() == '\n'))
      result += std::string("\\&") + c;
    else
      result += c;
  }
  return result;
}

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// `-c,--config` and `INI REQUIRED`, as `--help` shows them.
void writeOption(std::ostream& page, const CLI::Option& option) {
  const CLI::Formatter formatter;
  std::string names = formatter.make_option_name(&option, option.get_positional());
  for (std::size_t comma = names.find(','); comma != std::string::npos; comma = names.find(',', comma + 2))
    names.replace(comma, 1, ", ");
  page << ".TP\n\\fB" << plain(names) << "\\fR" << plain(formatter.make_option_opts(&option)) << "\n"
       << plain(option.get_description()) << "\n";
}

void writeOptions(std::ostream& page, const CLI::App& app, const std::string& section) {
  page << section << "\n";
  for (const bool positional : {true, false}) {
    for (const CLI::Option* option : shownOptions(app)) {
      if (option->get_positional() == positional) writeOption(page, *option);
    }
  }
}

/// The footer of a command is `Examples:` and lines that begin with two blanks.
void writeExamples(std::ostream& page, const CLI::App& app) {
  std::istringstream footer(app.get_footer());
  bool begun = false;
  for (std::string line; std::getline(footer, line);) {
    if (!line.starts_with("  ")) continue;
    if (!begun) page << ".SH EXAMPLES\n.nf\n";
    begun = true;
    page << plain(line.substr(2)) << "\n";
  }
  if (begun) page << ".fi\n";
}

std::string header(const std::string& name, const std::string& version) {
  return ".\\\" Made by the program itself: hoctomap documentation DIR\n.TH " + upper(plain(name)) +
         " 1 \"\" \"hoctomap " + version + "\" \"hoctomap manual\"\n";
}

std::string commandPage(const CLI::App& program, const CLI::App& command, const std::string& version) {
  const std::string name = program.get_name() + "-" + command.get_name();
  std::ostringstream page;
  page << header(name, version) << ".SH NAME\n"
       << plain(name) << " \\- " << plain(command.get_description()) << "\n.SH SYNOPSIS\n.B "
       << plain(program.get_name() + " " + command.get_name()) << "\n[\\fIOPTIONS\\fR]";
  for (const CLI::Option* option : shownOptions(command))
    if (option->get_positional()) page << " \\fI" << plain(option->get_name(true)) << "\\fR";
  if (!shownCommands(command).empty()) page << " \\fISUBCOMMAND\\fR ...";
  page << "\n";
  writeOptions(page, command, ".SH OPTIONS");
  for (const CLI::App* part : shownCommands(command)) {
    writeOptions(page, *part,
                 ".SH SUBCOMMAND " + upper(plain(part->get_name())) + "\n" + plain(part->get_description()));
    // Without a footer of its own a command has that of the one above it.
    if (part->get_footer() != command.get_footer()) writeExamples(page, *part);
  }
  writeExamples(page, command);
  page << ".SH EXIT STATUS\nSee\n.BR " << program.get_name() << " (1).\n.SH SEE ALSO\n.BR "
       << program.get_name() << " (1)\n";
  return page.str();
}

std::string programPage(const CLI::App& program, const std::string& version) {
  const std::string& name = program.get_name();
  std::ostringstream page;
  page << header(name, version) << ".SH NAME\n"
       << plain(name) << " \\- hierarchies of octree maps from recorded 3D measurements\n.SH SYNOPSIS\n.B "
       << plain(name) << "\n\\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n.SH DESCRIPTION\n"
       << plain(program.get_description()) << "\n.SH COMMANDS\n";
  for (const CLI::App* command : shownCommands(program))
    page << ".TP\n.BR " << plain(name + "-" + command->get_name()) << " (1)\n"
         << plain(command->get_description()) << "\n";
  writeOptions(page, program, ".SH OPTIONS");
  page << ".SH EXIT STATUS\n";
  std::istringstream footer(program.get_footer());
  for (std::string line; std::getline(footer, line);) {
    if (line.starts_with("Exit codes: ")) page << plain(line.substr(12)) << "\n";
  }
  return page.str();
}

}  // namespace

std::vector<const CLI::App*> shownCommands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::vector<const CLI::Option*> shownOptions(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

std::map<std::string, std::string> manualPages(const CLI::App& program, const std::string& version) {
  std::map<std::string, std::string> pages;
  pages[program.get_name() + ".1"] = programPage(program, version);
  for (const CLI::App* command : shownCommands(program))
    pages[program.get_name() + "-" + command->get_name() + ".1"] = commandPage(program, *command, version);
  return pages;
}

}  // namespace hoctomap
