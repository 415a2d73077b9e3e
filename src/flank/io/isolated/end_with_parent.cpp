#include "flank/io/isolated/end_with_parent.h"

#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string>

namespace flank::internal {

void end_with_parent_if_asked() {
  const char* asked = std::getenv(kEndsWithVariable);
  if (asked == nullptr) return;
  const std::string parent = asked;
  ::unsetenv(kEndsWithVariable);
  (void)::prctl(PR_SET_PDEATHSIG, SIGKILL);
  // Between its start and that line the parent may have ended, and nobody would tell.
  if (std::to_string(::getppid()) != parent) ::raise(SIGKILL);
}

}  // namespace flank::internal
