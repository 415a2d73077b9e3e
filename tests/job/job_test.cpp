// The table of fields as values, for programs that offer jobs to their own users.
#include "flank/job.h"

#include <gtest/gtest.h>

#include "flank/error.h"
#include "flank/job/field_text.h"
#include "flank/job/fields.h"
#include "job/random_jobs.h"

namespace flank::internal {
namespace {

template <class Job>
class JobFields : public ::testing::Test {};
using AllJobs = ::testing::Types<FitJob, CoverJob, TrochoidJob, VerifyJob, PostJob>;
TYPED_TEST_SUITE(JobFields, AllJobs);

TYPED_TEST(JobFields, ARandomJobIsSetFieldByField) {
  Random random(23);
  for (int k = 0; k < 50; ++k) {
    const TypeParam job = jobs::random_job<TypeParam>(random);
    TypeParam built;
    visit_fields(job, [&](const FieldInfo& info, const auto& value) {
      const std::vector<std::string> words = field_words(info, value);
      if (!words.empty()) set_field(built, field_name(info), words);
    });
    EXPECT_EQ(built, job);
  }
}

TYPED_TEST(JobFields, DefaultsOfTheTableMakeTheDefaultJob) {
  const std::string command(command_name(TypeParam{}));
  TypeParam built;
  for (const JobField& field : job_fields(command)) {
    EXPECT_FALSE(field.help.empty()) << field.name;
    EXPECT_FALSE(field.needed && field.usual) << field.name;
    if (field.usual) set_field(built, field.name, {*field.usual});
  }
  EXPECT_EQ(built, TypeParam{});
}

TEST(JobFieldTable, KindsAreThoseOfTheMembers) {
  const auto kind = [](const std::string& name) {
    for (const JobField& field : job_fields("fit"))
      if (field.name == name) return field.kind;
    throw std::runtime_error("no field " + name);
  };
  EXPECT_EQ(kind("part"), FieldKind::kText);
  EXPECT_EQ(kind("fixtures"), FieldKind::kTexts);
  EXPECT_EQ(kind("tolerance_mm"), FieldKind::kNumber);
  EXPECT_EQ(kind("axis_length_mm"), FieldKind::kNumber);
  EXPECT_EQ(kind("strips"), FieldKind::kAutoOrCount);
  EXPECT_EQ(kind("side"), FieldKind::kSign);
  EXPECT_EQ(kind("avoid"), FieldKind::kSwitch);
}

TEST(JobFieldTable, RefusesWhatIsNoFieldAndWhatIsNoValue) {
  FitJob job;
  try {
    set_field(job, "tolerence_mm", {"0.1"});
    ADD_FAILURE() << "accepted";
  } catch (const UsageError& e) {
    EXPECT_EQ(e.field(), "tolerence_mm");
    EXPECT_NE(std::string(e.what()).find("is not a field of fit; did you mean tolerance_mm; expected part, "),
              std::string::npos)
        << e.what();
  }
  EXPECT_THROW(set_field(job, "tolerance_mm", {"wide"}), UsageError);
  EXPECT_THROW(set_field(job, "tolerance_mm", {}), UsageError);
  EXPECT_THROW(set_field(job, "tolerance_mm", {"0.1", "0.2"}), UsageError);
  EXPECT_THROW((void)job_fields("sing"), UsageError);
  set_field(job, "fixtures", {"a.stl", "b.stl"});
  EXPECT_EQ(job.obstacles.fixtures.size(), 2u);
}

}  // namespace
}  // namespace flank::internal
