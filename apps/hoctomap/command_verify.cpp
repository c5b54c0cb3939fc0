// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "Command.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/MapCheck.h"

namespace hoctomap {

namespace {

struct VerifyOptions {
  std::string directory;
  bool json = false;
};

std::string asJson(const MapCheck& check) {
  nlohmann::ordered_json damage = nlohmann::ordered_json::array();
  for (const Damage& d : check.damage) damage.push_back({{"path", d.path}, {"what", d.what}});
  const nlohmann::ordered_json json{{"whole", check.damage.empty()}, {"nodes", check.nodes},
                                    {"states", check.states},        {"files", check.files},
                                    {"bytes", check.bytes},          {"damage", damage},
                                    {"foreign", check.foreign}};
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string asText(const MapCheck& check) {
  std::string text;
  for (const Damage& d : check.damage)
    text += "damaged  " + escapedText(d.path) + "  " + escapedText(d.what) + "\n";
  for (const std::string& name : check.foreign)
    text += "foreign  " + escapedText(name) + "  no file of a map; left alone\n";
  text += "whole    " + std::to_string(check.files) + " files, " + std::to_string(check.bytes) + " bytes; " +
          std::to_string(check.nodes) + " nodes, " + std::to_string(check.states - 1) + " snapshots\n";
  return text;
}

int verify(const VerifyOptions& options) {
  const MapCheck check = checkMap(options.directory);
  std::cout << (options.json ? asJson(check) : asText(check)) << std::flush;
  if (check.damage.empty()) return 0;
  throw MapError(options.directory + ": " + std::to_string(check.damage.size()) +
                 " of its files are damaged");
}

}  // namespace

void addVerifyCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<VerifyOptions>();
  CLI::App* command = addCommand(app, "verify", "Check every file of a map, and the structure of its tree",
                                 {"hoctomap verify map", "hoctomap verify map --json"});
  command->add_option("map", options->directory, "the map directory")->type_name("DIR")->required();
  command->add_flag("--json", options->json, "for programs");
  command->callback([options, &action] { action = [options] { return verify(*options); }; });
}

}  // namespace hoctomap
