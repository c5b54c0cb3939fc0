// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <memory>

#include "Command.h"
#include "Completion.h"
#include "Manual.h"
#include "hoctomap/io/AtomicFile.h"

namespace hoctomap {

void addDocumentationCommand(CLI::App& app, Action& action) {
  auto folder = std::make_shared<std::string>();
  CLI::App* command = addCommand(app, "documentation",
                                 "Write manual pages, and the completion for bash, as they are installed",
                                 {"hoctomap documentation share"});
  command->group("");  // hidden: for who builds packages
  command->add_option("folder", *folder, "folder for man1/ and completions/; it is made")
      ->type_name("DIR")
      ->required();
  command->callback([folder, &app, &action] {
    action = [folder, &app] {
      const std::filesystem::path root(*folder);
      std::filesystem::create_directories(root / "man1");
      std::filesystem::create_directories(root / "completions");
      for (const auto& [name, text] : manualPages(app, HOCTOMAP_VERSION))
        replaceFile(root / "man1" / name, text);
      replaceFile(root / "completions" / app.get_name(), bashCompletion(app));
      return 0;
    };
  });
}

}  // namespace hoctomap
