// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace hoctomap {

/// A page that is being made: named blocks of data for the script in it.
class Page {
 public:
  /// @throws FileError if the program was built without the page
  explicit Page(std::string_view title);

  /// Adds a block: deflated, in base64. The script reads it by its name.
  void add(std::string_view name, std::string_view bytes);
  void addJson(std::string_view name, const nlohmann::ordered_json& json);

  [[nodiscard]] std::string html() &&;

 private:
  std::string html_;
};

}  // namespace hoctomap
