// One program for all targets: libFuzzer calls it with what it makes up, and it fuzzes the reader that it is called by, fuzz_NAME.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "fuzz/targets.h"

namespace {
flank::fuzz::Target target;
}

extern "C" int LLVMFuzzerInitialize(int*, char*** arguments) {
  const std::string program = std::filesystem::path((*arguments)[0]).filename().string();
  const std::string name = program.substr(program.find('_') + 1);
  const auto found = flank::fuzz::targets().find(name);
  if (found == flank::fuzz::targets().end()) {
    std::cerr << program << ": no reader is called " << name << "\n";
    std::exit(2);
  }
  target = found->second;
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  target({reinterpret_cast<const char*>(bytes), size});
  return 0;
}
