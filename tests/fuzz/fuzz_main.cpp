// One program a target: libFuzzer calls this with what it makes up (FLANK_FUZZ of cmake/options.cmake).
#include <cstddef>
#include <cstdint>

#include "fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const flank::fuzz::Target target = flank::fuzz::targets().at(FLANK_FUZZ_TARGET);
  target({reinterpret_cast<const char*>(bytes), size});
  return 0;
}
