// Faces whose borders meet are one target.
#include "flank/setup/targets.h"

#include <gtest/gtest.h>

#include "cover/cover_targets.h"
#include "flank/io/face_groups.h"
#include "flank/setup/wrapped_note.h"
#include "geom/skins.h"

namespace flank::internal {
namespace {

/// Three plates side by side, of which the middle one is missing at first, and one elsewhere.
internal::Setup plates() {
  internal::Setup setup;
  for (const double x : {0.0, 40.0, 20.0, 200.0}) {
    setup.part.faces.push_back(testing::flat_face(x, x + 20.0, 0.0, 30.0, 0.0));
    setup.part.faces.back().id = "F" + std::to_string(setup.part.faces.size());
  }
  return setup;
}

std::vector<std::string> groups_of(const std::vector<int>& targets) {
  internal::Setup setup = plates();
  setup.targets = targets;
  std::vector<std::string> names;
  for (const TargetGroup& group : make_targets(setup)) names.push_back(group.faces);
  return names;
}

TEST(MakeTargets, FacesThatMeetAreOneTarget) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(groups_of({0}), Names{"F1"});
  EXPECT_EQ(groups_of({0, 1}), (Names{"F1", "F2"}));
  EXPECT_EQ(groups_of({0, 2}), Names{"F1,F3"});
  EXPECT_EQ(groups_of({0, 1, 2}), Names{"F1,F2,F3"}) << "by way of the third";
  EXPECT_EQ(groups_of({0, 1, 2, 3}), (Names{"F1,F2,F3", "F4"}));
  EXPECT_EQ(groups_of({3, 2, 0}), (Names{"F4", "F3,F1"}));
}

TEST(MakeTargets, AreasAreThoseOfTheFaces) {
  internal::Setup setup = plates();
  setup.targets = {0, 2, 3};
  const std::vector<TargetGroup> groups = make_targets(setup);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_NEAR(groups[0].target->area(), 1200.0, 1.0);
  EXPECT_NEAR(groups[1].target->area(), 600.0, 0.5);
}

TEST(MakeTargets, PiecesOfASkinAreTargetsOfTheirOwn) {
  internal::Setup setup = plates();
  setup.part.faces[1] = testing::elliptic_skin(40.0, 4.0, 30.0);
  setup.part.faces[1].id = "F2";
  setup.part.surface_types.assign(setup.part.faces.size(), "B-spline");
  split_two_sided(setup.part, "F2,F4");
  setup.targets = parse_face_list(setup.part, "F2,F4");
  ASSERT_GT(setup.targets.size(), 3u);
  EXPECT_EQ(make_targets(setup).size(), setup.targets.size());
  EXPECT_EQ(wrapped_note(setup.part, {0}), "");
  const std::string note = wrapped_note(setup.part, setup.targets);
  for (const char* said : {"F2 goes round an edge and is machined in pieces", "F2a, F2b, F2c"})
    EXPECT_NE(note.find(said), std::string::npos) << said << " in " << note;
}

}  // namespace
}  // namespace flank::internal
