// Loaded into LinuxCNC's realtime program (LD_PRELOAD), it lets the simulated servo periods pass FLANK_TIMES as fast as the clock: the
// program sleeps until the absolute time at which its next period begins, and here it wakes up early. Planner and kinematics see nothing of
// that, as they count periods. Everything else keeps the clock's time.
#define _GNU_SOURCE
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

static double seconds(const struct timespec* t) { return (double)t->tv_sec + 1e-9 * (double)t->tv_nsec; }

int clock_nanosleep(clockid_t clock, int flags, const struct timespec* request, struct timespec* remain) {
  static double times = 0.0, first_request, first_now;
  struct timespec now, until = *request;
  if (flags == TIMER_ABSTIME && strcmp(program_invocation_short_name, "rtapi_app") == 0) {
    clock_gettime(clock, &now);
    if (times == 0.0) {
      const char* word = getenv("FLANK_TIMES");
      times = word ? atof(word) : 1.0;
      first_request = seconds(request), first_now = seconds(&now);
    }
    const double wake = first_now + (seconds(request) - first_request) / times;
    if (wake <= seconds(&now)) return 0;
    until.tv_sec = (time_t)wake, until.tv_nsec = (long)(1e9 * (wake - (double)until.tv_sec));
  }
  return syscall(SYS_clock_nanosleep, clock, flags, &until, remain) == 0 ? 0 : errno;
}
