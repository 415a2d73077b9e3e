/// The options of `flank studio`, in the command and in the program that it becomes.
#pragma once

#include <CLI/App.hpp>
#include <memory>

#include "flank/studio/studio.h"

namespace flank::cli {

struct StudioWords {
  internal::StudioOptions studio;
  bool open = true;  ///< the page, in a browser
};

/// Adds `studio` to the parser.
[[nodiscard]] CLI::App* add_studio_words(CLI::App& parser, const std::shared_ptr<StudioWords>& words);

}  // namespace flank::cli
