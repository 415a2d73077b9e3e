/// Messages of the library in the words of the command line.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "flank/error.h"

namespace flank::cli {

/// The message with the field that it is about, and those in backquotes, called by their options if `flags` knows them.
[[nodiscard]] std::string in_flags(const Error& error, const std::map<std::string, std::string>& flags);

/// "; did you mean --tolerance?" of the known word that is nearest to `word`; empty if none is near: at most a third of its letters
/// are missing, too many, wrong or with their neighbour in the wrong order, or it begins with the word.
[[nodiscard]] std::string did_you_mean(const std::string& word, const std::vector<std::string>& known);

}  // namespace flank::cli
