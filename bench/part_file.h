// Where the benchmarks find the parts that are not examples.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "flank/error.h"
#include "flank/example.h"
#include "flank/example/example_write.h"

namespace flank::internal::bench {

/// File of a part of the folder FLANK_DATA. If it is not there, Rotor 37 is generated in the folder `scratch`: the same
/// shapes, face by face.
inline std::string part_file(const std::string& name, const std::filesystem::path& scratch) {
  const char* data = std::getenv("FLANK_DATA");
  const std::string file = std::string(data ? data : FLANK_SOURCE_DIR "/../shared/data") + "/" + name;
  if (std::filesystem::exists(file)) return file;
  for (const auto& [known, example] :
       {std::pair("r37_blade.step", "rotor37"), std::pair("r37_blisk_sector_2blades.step", "rotor37-blisk")})
    if (name == known) return write_example(make_example(example), (scratch / name).string()).front();
  throw InputError(file + " is not there (set FLANK_DATA)");
}

}  // namespace flank::internal::bench
