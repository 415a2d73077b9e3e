#include "flank/base/assert.h"

#include <cstdio>
#include <cstdlib>

namespace flank::internal {

void assertion_failed(const char* condition, const char* file, int line, const char* function) {
  std::fprintf(stderr, "%s:%d: in %s: the assertion failed: %s\n", file, line, function, condition);
  std::abort();
}

}  // namespace flank::internal
