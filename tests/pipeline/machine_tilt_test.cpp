// How far a machine tilts a part follows from the ranges of its rotary joints.
#include "flank/pipeline/folder/machine_tilt.h"

#include <gtest/gtest.h>

#include "flank/base/atomic_file.h"
#include "flank/error.h"
#include "flank/io/text/json_input.h"
#include "flank/machine/model/machine_file.h"
#include "temporary_folder.h"

namespace flank::internal {
namespace {

class MachineTilt : public TemporaryFolder {
 protected:
  MachineTilt() : TemporaryFolder("machine_tilt") {}
};

TEST_F(MachineTilt, IsThatOfTheTiltingJoint) {
  EXPECT_NEAR(machine_tilt_deg("linuxcnc-xyzac-trt"), 120.0, 1e-6) << "A from -120 to 120, C all round";
  std::string text = read_file(machine_file("linuxcnc-xyzac-trt"));
  const std::string range = "[-120.0, 120.0]";
  text.replace(text.find(range), range.size(), "[-30.0, 75.0]");
  const std::string file = (root_ / "small.toml").string();
  write_file(file, text);
  EXPECT_NEAR(machine_tilt_deg(file), 75.0, 1e-6);
  EXPECT_THROW((void)machine_tilt_deg("none-such"), Error);
}

}  // namespace
}  // namespace flank::internal
