#include "flank/threads.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <memory>
#include <thread>

#include "flank/base/assert.h"

namespace flank {
namespace {

// oneTBB limits its threads for as long as an object of its own lives: this one, for the whole process.
std::unique_ptr<tbb::global_control>& control() {
  static std::unique_ptr<tbb::global_control> instance;
  return instance;
}

int& count_setting() {
  static int count = 0;
  return count;
}

}  // namespace

void set_thread_count(int threads) {
  FLANK_ASSERT(threads >= 0);
  const int hardware = std::max(1u, std::thread::hardware_concurrency());
  count_setting() = threads > 0 ? threads : hardware;
  control() = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(count_setting()));
}

int thread_count() {
  if (count_setting() == 0) set_thread_count(0);
  return count_setting();
}

}  // namespace flank
