// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <memory>

#include "Command.h"
#include "measuring/Tasks.h"

namespace hoctomap {

void addMeasureCommand(CLI::App& app, Action& action) {
  auto task = std::make_shared<Task>();
  CLI::App* command = app.add_subcommand(
      "measure", "One measurement in this process: `name value` a line. The other commands call it");
  command->add_option("task", task->name, "whole, cells, boxes, mapping, machine")->required();
  command->add_option("--variant", task->variant, "whole: stock, ours; boxes: stock, filtering, ours");
  command->add_option("--log", task->scans.log, "rawlog with poses")->type_name("LOG");
  command->add_option("--start", task->scans.start, "number of the first scan")->type_name("N");
  command->add_option("--every", task->scans.every, "use every N-th scan")->type_name("N");
  command->add_option("--max-scans", task->scans.max_scans, "use N scans")->type_name("N");
  command->add_option("-c,--config", task->config, "configuration (default: built in)")->type_name("INI");
  command->add_option("--set", task->overrides, "override a setting; may be repeated")
      ->type_name("section.key=value")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--resolution", task->resolution, "of the map (whole), of the objects (boxes)")
      ->type_name("M");
  command->add_option("--threads", task->threads, "whole, boxes, mapping: threads")->type_name("N");
  command->add_option("--far-nodes", task->far_nodes, "mapping: nodes that are there, out of view")
      ->type_name("N");
  command->add_option("--warm-up", task->warm_up, "mapping: first scans, not measured")->type_name("N");
  command->add_option("--limit-memory", task->limits.memory_bytes, "address space; 0: no limit")
      ->type_name("BYTES");
  command->add_option("--limit-cpu", task->limits.cpu_seconds, "CPU time; 0: no limit")->type_name("SECONDS");
  command->callback([task, &action] {
    action = [task] {
      std::cout << measure(*task).lines() << std::flush;
      return 0;
    };
  });
}

}  // namespace hoctomap
