#include "flank/wheel.h"

#include "flank/wheel/plan_file.h"
#include "flank/wheel/run_wheel.h"

namespace flank {

std::string mill_wheel(const WheelRequest& request, const Progress& progress) {
  return internal::plan_json(internal::run_wheel(request, progress));
}

}  // namespace flank
