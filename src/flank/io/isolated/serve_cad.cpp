#include "flank/io/isolated/serve_cad.h"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <csignal>
#include <new>
#include <string>
#include <string_view>

#include "flank/error.h"
#include "flank/io/cad/read_cad.h"
#include "flank/io/isolated/part_bytes.h"
#include "flank/io/isolated/reader_message.h"

namespace flank::internal {
namespace {

double number(std::string_view word) {
  double value = 0.0;
  (void)std::from_chars(word.data(), word.data() + word.size(), value);
  return value;
}

void limit(decltype(RLIMIT_CPU) what, double most) {
  rlimit value{};
  if (::getrlimit(what, &value) != 0) return;
  const auto asked = static_cast<rlim_t>(std::ceil(most));
  if (value.rlim_max == RLIM_INFINITY || asked < value.rlim_max) value.rlim_cur = asked;
  (void)::setrlimit(what, &value);
}

void set_limits(double seconds, double bytes) {
  // Ctrl-C is for the parent to answer; without a parent there is nothing to do.
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGXCPU, SIG_DFL);
  (void)::prctl(PR_SET_PDEATHSIG, SIGKILL);
  // It may have ended before that line: then nobody holds the other end of the pipe.
  pollfd pipe{kReaderPipe, 0, 0};
  if (::poll(&pipe, 1, 0) > 0 && (pipe.revents & POLLERR) != 0) ::_exit(1);
  limit(RLIMIT_CORE, 0.0);
  limit(RLIMIT_CPU, seconds);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  // The sanitizers reserve terabytes of addresses.
  limit(RLIMIT_AS, bytes);
#else
  (void)bytes;
#endif
}

/// false: nobody listens any more.
bool send(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(kReaderPipe, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

bool send(char kind, std::string_view bytes) { return send({&kind, 1}) && send(bytes); }

}  // namespace

int serve_cad(int count, const char* const* words) {
  if (count != 5) return 2;
  const std::string file = words[0], format = words[1], unit = words[2];
  set_limits(number(words[3]), number(words[4]));
  bool sent = false;
  try {
    const Part part = read_cad(file, format, unit.empty() ? std::nullopt : std::optional(unit));
    sent = send(kReaderPart, encode_part(part));
  } catch (const std::bad_alloc&) {
    sent = send(kReaderMemory, {});
  } catch (const InputError& error) {
    sent = send(kReaderRefuses, error.what());
  } catch (const std::exception& error) {
    sent = send(kReaderFault, error.what());
  }
  // Nothing of the kernel is taken down: what a damaged file left there could crash or hang only now.
  ::_exit(sent ? 0 : 1);
}

}  // namespace flank::internal
