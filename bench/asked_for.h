/// Which of a benchmark's scenes its arguments ask for.
#pragma once

#include <string>

namespace flank::internal::bench {

/// Those whose name contains one of the arguments; all of them without arguments.
inline bool asked_for(const std::string& name, int argc, char** argv) {
  for (int k = 1; k < argc; ++k)
    if (name.find(argv[k]) != std::string::npos) return true;
  return argc < 2;
}

}  // namespace flank::internal::bench
