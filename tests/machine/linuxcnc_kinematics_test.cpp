// Our kinematics against LinuxCNC's own modules, which a program beside the clients' tests loads; skipped where they are missing.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <numbers>
#include <vector>

#include "flank/base/random.h"
#include "flank/machine/kinematics.h"
#include "flank/machine/model/machine_file.h"

#ifdef FLANK_LINUXCNC_KINEMATICS

namespace flank::internal {
namespace {

constexpr double kAgreement = 1e-9, kToolLength = 60.0, kDegrees = 180.0 / std::numbers::pi;
constexpr int kRows = 2000;

struct Trunnion {
  std::string machine, module, letters, pins;
};

class LinuxCncKinematics : public ::testing::TestWithParam<Trunnion> {};

/// Joints in the order of the letters, mm and degrees, through the module: X Y Z A B C.
std::vector<std::array<double, 6>> through(const Trunnion& t, const std::vector<std::array<double, 5>>& joints) {
  namespace fs = std::filesystem;
  const fs::path in = fs::path(::testing::TempDir()) / (t.module + ".joints"), out = in.string() + ".poses";
  {
    std::ofstream file(in);
    file << std::setprecision(17);
    for (const auto& row : joints)
      file << row[0] << ' ' << row[1] << ' ' << row[2] << ' ' << row[3] << ' ' << row[4] << '\n';
  }
  const std::string command = std::string(FLANK_LINUXCNC_KINEMATICS) + " /usr/lib/linuxcnc/modules/" + t.module +
                              ".so " + t.letters + " - forward " + t.pins + " tool-offset=60 < " + in.string() + " > " +
                              out.string();
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  std::ifstream file(out);
  std::vector<std::array<double, 6>> rows;
  for (std::array<double, 6> r{}; file >> r[0] >> r[1] >> r[2] >> r[3] >> r[4] >> r[5];) rows.push_back(r);
  fs::remove(in);
  fs::remove(out);
  return rows;
}

TEST_P(LinuxCncKinematics, AgreeWithOurs) {
  const Trunnion& t = GetParam();
  if (!std::filesystem::exists("/usr/lib/linuxcnc/modules/" + t.module + ".so")) GTEST_SKIP() << "no LinuxCNC here";
  const Machine machine = read_machine(t.machine);
  const Kinematics kinematics(machine, kToolLength);
  Random random(5);
  std::vector<JointValues> ours;
  std::vector<std::array<double, 5>> theirs;
  for (int i = 0; i < kRows; ++i) {
    JointValues q{};
    std::array<double, 5> row{};
    for (std::size_t j = 0; j < machine.joints.size(); ++j) {
      const Joint& joint = machine.joints[j];
      const bool rotary = joint.kind == JointKind::kRotary;
      const double value = rotary ? random.uniform(-110.0, 110.0) : random.uniform(-400.0, 400.0);
      q[j] = rotary ? value / kDegrees : value;
      row[t.letters.find(joint.name)] = value;
    }
    ours.push_back(q);
    theirs.push_back(row);
  }
  const auto poses = through(t, theirs);
  ASSERT_EQ(poses.size(), ours.size());
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const Vec3 point = kinematics.forward(ours[i]).tip;
    // The tool's length is in the world's Z of LinuxCNC.
    ASSERT_LE((point - Vec3(poses[i][0], poses[i][1], poses[i][2] - kToolLength)).norm(), kAgreement) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Trunnions, LinuxCncKinematics,
    ::testing::Values(Trunnion{"linuxcnc-xyzac-trt", "xyzac-trt-kins", "XYZAC", "y-offset=20 z-offset=10"},
                      Trunnion{"linuxcnc-xyzbc-trt", "xyzbc-trt-kins", "XYZBC", "x-offset=20 z-offset=10"}),
    [](const auto& test) { return test.param.letters; });

}  // namespace
}  // namespace flank::internal

#endif
