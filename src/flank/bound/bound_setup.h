/// What every bound begins with: the part, its targets, and the faces that must not be entered.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "flank/job/bound_job.h"
#include "flank/setup/setup.h"
#include "flank/setup/targets.h"

namespace flank::internal {

struct BoundSetup {
  Setup setup;
  std::vector<TargetGroup> groups;
  std::unique_ptr<Target> others;  ///< that must not be entered, as surfaces; null: none

  /// In the order that bounds ask for.
  [[nodiscard]] std::vector<const Target*> avoided() const {
    return others ? std::vector<const Target*>{others.get()} : std::vector<const Target*>{};
  }
};

/// Throws UsageError and InputError. `notes` as of read_setup.
[[nodiscard]] BoundSetup read_bound_setup(const BoundJob& job, std::vector<std::string>& notes);

/// Writes two files of a bound into the folder, which is made if there is none. Throws InputError, also for what the job reads.
void write_bound_files(const BoundJob& job, const std::string& folder, const std::string& json,
                       const std::string& text);

}  // namespace flank::internal
