/// NASA Rotor 37 as files: real shapes for tests, on every machine.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

#include "flank/example.h"
#include "flank/example/example_write.h"

namespace flank::internal::test {

/// A file of the generated "rotor37" (6 faces) or "rotor37-blisk" (16 faces), made once per process and removed at its
/// end.
inline std::string rotor37_file(const std::string& name) {
  struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("flank_rotor37-" + std::to_string(::getpid()));
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() { std::filesystem::remove_all(path); }
  };
  static const Folder folder;
  const std::string file = (folder.path / (name + ".step")).string();
  if (!std::filesystem::exists(file)) write_example(make_example(name), file);
  return file;
}

}  // namespace flank::internal::test
