/// An example as files (example.h has the same for users).
#pragma once

#include <string>
#include <vector>

#include "flank/example.h"

namespace flank::internal {

/// As write_example of example.h.
std::vector<std::string> write_example_files(const Example& example, const std::string& file);
/// As example_json.
[[nodiscard]] std::string example_files_json(const Example& example, const std::vector<std::string>& files);

}  // namespace flank::internal
