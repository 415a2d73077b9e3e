#include "flank/redesign/run_redesign.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "flank/error.h"
#include "flank/example/example_write.h"
#include "rotor37_file.h"
#include "sanitized.h"
#include "shared_data.h"
#include "temporary_folder.h"

namespace flank::internal {
namespace {

class RedesignOf : public TemporaryFolder {
 protected:
  RedesignOf() : TemporaryFolder("redesign") {}

  [[nodiscard]] std::string output() const { return (root_ / "new").string(); }

  [[nodiscard]] Redesign made(RedesignJob job) const {
    Redesign redesign = run_redesign(job, output(), {});
    write_redesign(redesign, output());
    return redesign;
  }

  /// A fit of the new face with the tool that the redesign found, on its own and from a start of its own. `beside`: of other solids only
  /// these are left out, and the tool keeps out of the rest while it plans.
  [[nodiscard]] VerifyReport fitted_again(const Redesign& redesign, double tolerance_mm,
                                          const std::optional<std::string>& beside = {}) const {
    FitJob job;
    job.part.file = (root_ / "new" / "redesigned.step").string();
    job.part.faces = redesign.new_ids.front();
    job.tool.spec = (root_ / "new" / "tool.json").string();
    job.tolerance_mm = tolerance_mm;
    job.strips = 1;
    job.avoid = beside.has_value();
    job.obstacles.ignore_faces = beside.value_or("S1-S" + std::to_string(redesign.checked.solids));
    return run_fit(job).verify;
  }
};

RedesignJob job_of(const std::string& file, const std::string& faces) {
  RedesignJob job;
  job.part.file = file;
  job.part.faces = faces;
  return job;
}

/// The new part is a valid solid, its tool leaves it exactly, and another fit with that tool finds that again.
void expect_closed_loop(const Redesign& redesign, const VerifyReport& again, double diagonal_mm) {
  EXPECT_TRUE(redesign.solid_valid()) << redesign_text(redesign);
  EXPECT_TRUE(redesign.met()) << redesign_text(redesign);
  EXPECT_LT(redesign.exact.overcut_mm, 1e-6 * diagonal_mm);
  EXPECT_LT(again.rms_mm, 1e-6 * diagonal_mm);
  EXPECT_GT(again.coverage, 0.999);
}

TEST_F(RedesignOf, TheRotorBladeIsASolidThatItsToolLeavesExactly) {
  if (kSanitized) GTEST_SKIP() << "a whole fit, a redesign and a fit of what came out";
  RedesignJob job = job_of(test::rotor37_file("rotor37"), "F1");
  job.heights = "20,80";
  const Redesign redesign = made(job);
  const double size = redesign.result.diagonal_mm;
  expect_closed_loop(redesign, fitted_again(redesign, 5e-5 * size), size);
  ASSERT_EQ(redesign.faces.size(), 1u);
  const FaceTables& face = redesign.faces.front();
  EXPECT_LT(face.rms_mm, 0.06);
  EXPECT_TRUE(face.thickness.known);
  ASSERT_EQ(face.sections.size(), 2u);
  EXPECT_GT(face.sections.front().points.size(), 60u);
  EXPECT_GT(face.sections.front().chord_mm, 50.0);
  const nlohmann::json json = nlohmann::json::parse(content("new/redesign.json"));
  EXPECT_EQ(json["schema"], "openflank/redesign/1");
  EXPECT_FALSE(content("new/deviation.csv").empty());
}

TEST_F(RedesignOf, TheImpellersBladeLosesNoneOfItsSolids) {
  if (kSanitized) GTEST_SKIP() << "a whole fit, a redesign and a fit of what came out";
  FLANK_REAL_PART(file, "kj66_impeller.step");
  RedesignJob job = job_of(file, "F1");
  job.ignore_faces = "S2-S11";
  const Redesign redesign = made(job);
  EXPECT_EQ(redesign.checked.solids, 11);
  const double size = redesign.result.diagonal_mm;
  expect_closed_loop(redesign, fitted_again(redesign, 5e-5 * size), size);
  EXPECT_LT(std::max(redesign.faces.front().highest_mm, -redesign.faces.front().lowest_mm), 0.01);
  // The faces beside it, which are trimmed to it, do not hold the tool off.
  const VerifyReport beside = fitted_again(redesign, 5e-5 * size, "S2-S11");
  EXPECT_LT(beside.rms_mm, 1e-6 * size);
  EXPECT_LT(beside.gouge_mm, 5e-5 * size);
  EXPECT_GT(beside.coverage, 0.999);
}

/// The tool that a fit finds ends before this blade's border with its tip: that is lengthened until it does not.
TEST_F(RedesignOf, ATipThatEndsAtTheBorderIsLengthened) {
  if (kSanitized) GTEST_SKIP() << "a whole fit, a redesign and a fit of what came out";
  FLANK_REAL_PART(file, "zoo/hecc_main_blade.step");
  const Redesign redesign = made(job_of(file, "F3"));
  const double size = redesign.result.diagonal_mm;
  expect_closed_loop(redesign, fitted_again(redesign, 5e-5 * size), size);
}

TEST_F(RedesignOf, AMeshAndFacesThatAreJoinedAreRefused) {
  const std::string mesh = (root_ / "plane.stl").string();
  std::ofstream(mesh)
      << "solid p\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 10 0 0\nvertex 0 10 0\nendloop\nendfacet\n"
         "facet normal 0 0 1\nouter loop\nvertex 10 0 0\nvertex 10 10 0\nvertex 0 10 0\nendloop\nendfacet\nendsolid "
         "p\n";
  RedesignJob job = job_of(mesh, "F1");
  job.part.unit = "mm";
  EXPECT_THROW((void)run_redesign(job, output(), {}), InputError);
  job = job_of(test::rotor37_file("rotor37"), "F1");
  job.heights = "10,200";
  EXPECT_THROW((void)run_redesign(job, output(), {}), UsageError);
  job.heights = "50";
  job.weight = "le";
  EXPECT_THROW((void)run_redesign(job, output(), {}), UsageError);
  EXPECT_FALSE(std::filesystem::exists(output()));
}

}  // namespace
}  // namespace flank::internal
