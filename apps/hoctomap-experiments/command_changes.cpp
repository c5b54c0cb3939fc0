// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <numbers>

#include "Command.h"
#include "changes/ChangeRun.h"
#include "changes/Reliability.h"
#include "hoctomap/io/CsvText.h"
#include "measuring/Figures.h"

namespace hoctomap {

namespace {

struct CommandOptions {
  std::string output;
  std::optional<std::string> config;
  std::vector<std::string> assignments;
  int scripts = 4;
  int first_seed = 1;
  int width = 640;
  bool quick = false;
};

/// The results of one kind of script, or of all.
struct Summary {
  int scripts = 0;
  ChangeCounts counts;
  std::vector<MotionError> motions;
  std::vector<ExistenceCheck> existence;

  void add(const ChangeResult& result) {
    ++scripts;
    counts += result.counts;
    motions.insert(motions.end(), result.motions.begin(), result.motions.end());
    existence.insert(existence.end(), result.existence.begin(), result.existence.end());
  }
};

constexpr double kDegrees = 180.0 / std::numbers::pi;

std::string summaryRow(const std::string& name, const Summary& summary) {
  double shift = 0.0;
  double turn = 0.0;
  for (const MotionError& error : summary.motions) {
    shift = std::max(shift, error.shift);
    turn = std::max(turn, error.turn);
  }
  std::string row =
      "| " + name + " | " + std::to_string(summary.scripts) + " | " + std::to_string(summary.counts.right) +
      " | " + std::to_string(summary.counts.false_alarms) + " | " + std::to_string(summary.counts.missed) +
      " | " + numberText(summary.counts.precision(), 3) + " | " + numberText(summary.counts.recall(), 3) +
      " | ";
  if (!summary.motions.empty()) {
    row += numberText(1e3 * shift, 2) + " mm, " + numberText(kDegrees * turn, 2) + " deg";
  }
  return row + " |\n";
}

std::string csvRow(const ChangeResult& result) {
  return result.name + "," + std::to_string(result.counts.right) + "," +
         std::to_string(result.counts.false_alarms) + "," + std::to_string(result.counts.missed) + "\n";
}

std::string motionRow(const std::string& script, const MotionError& error) {
  return script + "," + error.solid + "," + numberText(error.shift, 6) + "," +
         numberText(kDegrees * error.turn, 6) + "\n";
}

int changes(CommandOptions options) {
  if (options.quick) {
    options.scripts = 1;
    options.width = 320;
  }
  const Settings settings =
      loadSettings(options.config ? std::optional<std::filesystem::path>(*options.config) : std::nullopt,
                   options.assignments);
  std::filesystem::create_directories(options.output);
  std::string table =
      "| change | scripts | right | false | missed | precision | recall | largest error of a motion |\n"
      "|---|---|---|---|---|---|---|---|\n";
  std::string csv = "script,right,false,missed\n";
  std::string motions = "script,solid,shift_m,turn_deg\n";
  Summary all;
  for (int kind = 0; kind < kScriptKinds; ++kind) {
    Summary of_kind;
    for (int k = 0; k < options.scripts; ++k) {
      const auto seed = static_cast<std::uint64_t>(options.first_seed + k);
      const auto script = makeChangeScript(static_cast<ScriptKind>(kind), seed, options.width);
      const ChangeResult result = runChangeScript(script, settings);
      for (const std::string& mistake : result.mistakes) std::cerr << mistake << std::endl;
      for (const MotionError& error : result.motions) motions += motionRow(result.name, error);
      csv += csvRow(result);
      of_kind.add(result);
      all.add(result);
    }
    table += summaryRow(toString(static_cast<ScriptKind>(kind)), of_kind);
  }
  table += summaryRow("all", all);
  const Reliability reliability = reliabilityOf(all.existence);
  const std::string text = table + "\n" + reliabilityMarkdown(reliability);
  const std::filesystem::path folder(options.output);
  drawReliability(reliability, folder);
  writeTextFile(folder / "changes.csv", csv);
  writeTextFile(folder / "motions.csv", motions);
  writeTextFile(folder / "changes.md", text);
  std::cout << text << std::flush;
  return 0;
}

}  // namespace

void addChangesCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<CommandOptions>();
  CLI::App* command = app.add_subcommand(
      "changes", "Section III-D on simulated tables: what comes, goes, moves, and how sure the map is of it");
  command->add_option("-o,--output", options->output, "folder for CSV, tables and the plot")
      ->type_name("DIR")
      ->required();
  command->add_option("-c,--config", options->config, "configuration")->type_name("INI");
  command->add_option("--set", options->assignments, "section.key=value")->type_name("ASSIGNMENT");
  command->add_option("--scripts", options->scripts, "random scripts of each kind of change")
      ->type_name("N")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--first-seed", options->first_seed, "of the scripts of each kind")
      ->type_name("N")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_flag("--quick", options->quick, "one script of each kind, small images");
  command->footer("\nExample:\n  hoctomap-experiments changes -o out/changes\n");
  command->callback([options, &action] { action = [options] { return changes(*options); }; });
}

}  // namespace hoctomap
