/// Messages of the library in the words of the command line.
#pragma once

#include <map>
#include <string>

#include "flank/error.h"

namespace flank::cli {

/// The message with the field that it is about, and those in backquotes, called by their options if `flags` knows them.
[[nodiscard]] std::string in_flags(const Error& error, const std::map<std::string, std::string>& flags);

}  // namespace flank::cli
