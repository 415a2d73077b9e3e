// Loaded before the C library: the call number $FLANK_FAULT_AT of those that change a disk fails, or the process is killed
// there. $FLANK_FAULT_HOW: a number is the errno of that call; "always NUMBER": of it and of all later ones; "kill":
// before the call; "half": after half of a write. The calls are counted on descriptor $FLANK_FAULT_COUNT.
// $FLANK_FAULT_ALLOCATION: instead, the allocation of this number fails, and allocations are counted.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdlib>
#include <cstring>

namespace {

int calls = 0;
std::atomic<int> allocations{0};

long setting(const char* name) {
  const char* text = std::getenv(name);
  return text == nullptr ? 0 : std::atol(text);
}

/// 0: go on. Otherwise errno is set.
bool fails() {
  const long at = setting("FLANK_FAULT_AT");
  const char* how = std::getenv("FLANK_FAULT_HOW");
  ++calls;
  if (how == nullptr || at == 0 || calls < at) return false;
  const bool always = std::strncmp(how, "always ", 7) == 0;
  if (calls > at && !always) return false;
  if (how[0] == 'k' || how[0] == 'h') {
    ::kill(::getpid(), SIGKILL);
    ::pause();
  }
  errno = std::atoi(how + (always ? 7 : 0));
  return true;
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

/// Says how many calls there were.
struct Count {
  ~Count() {
    const auto file = static_cast<int>(setting("FLANK_FAULT_COUNT"));
    if (file <= 0) return;
    if (std::getenv("FLANK_FAULT_ALLOCATION") != nullptr) calls = allocations;
    const auto real = next<ssize_t (*)(int, const void*, std::size_t)>("write");
    (void)!real(file, &calls, sizeof calls);
  }
} count;

}  // namespace

// The sanitizers have allocators of their own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FLANK_FAULT_ALLOCATIONS
#endif

extern "C" {

#ifdef FLANK_FAULT_ALLOCATIONS
void* __libc_malloc(std::size_t size);                     // NOLINT: the names that the C library gives its own
void* __libc_calloc(std::size_t count, std::size_t size);  // NOLINT
void* __libc_realloc(void* block, std::size_t size);       // NOLINT

static bool allocation_fails() {
  static const long at = setting("FLANK_FAULT_ALLOCATION");
  if (++allocations != at || at == 0) return false;
  errno = ENOMEM;
  return true;
}

void* malloc(std::size_t size) { return allocation_fails() ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t count, std::size_t size) { return allocation_fails() ? nullptr : __libc_calloc(count, size); }
void* realloc(void* block, std::size_t size) { return allocation_fails() ? nullptr : __libc_realloc(block, size); }
#endif

ssize_t write(int file, const void* bytes, std::size_t size) {
  const auto real = next<ssize_t (*)(int, const void*, std::size_t)>("write");
  const char* how = std::getenv("FLANK_FAULT_HOW");
  if (how != nullptr && how[0] == 'h' && calls + 1 == setting("FLANK_FAULT_AT")) (void)!real(file, bytes, size / 2);
  return fails() ? -1 : real(file, bytes, size);
}

int open(const char* name, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const auto mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  if ((flags & O_CREAT) != 0 && fails()) return -1;
  return next<int (*)(const char*, int, ...)>("open")(name, flags, mode);
}

int fsync(int file) { return fails() ? -1 : next<int (*)(int)>("fsync")(file); }
int rename(const char* from, const char* to) {
  return fails() ? -1 : next<int (*)(const char*, const char*)>("rename")(from, to);
}
int mkdir(const char* name, mode_t mode) {
  return fails() ? -1 : next<int (*)(const char*, mode_t)>("mkdir")(name, mode);
}
int unlink(const char* name) { return fails() ? -1 : next<int (*)(const char*)>("unlink")(name); }
int rmdir(const char* name) { return fails() ? -1 : next<int (*)(const char*)>("rmdir")(name); }

}  // extern "C"
