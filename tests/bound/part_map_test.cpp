#include "flank/bound/part_map.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "rotor37_file.h"

namespace flank::internal {
namespace {

TEST(PartMap, TellsWhatIsProvedOfEveryFace) {
  BoundJob job;
  job.part.file = test::rotor37_file("rotor37");
  job.tool.spec = "cylinder:radius=5";
  job.tool.axis_length_mm = 30.0;
  job.tolerance_mm = 0.05;
  job.points = 6;
  job.gap = 1.0;
  job.map = true;
  const PartMap map = run_part_map(job, {});
  EXPECT_TRUE(map.complete);
  ASSERT_EQ(map.faces.size(), 6u);
  for (const MappedFace& face : map.faces) {
    EXPECT_NE(face.kind, MappedKind::kNotExamined) << face.id;
    EXPECT_GE(face.points, 1) << face.id;
    EXPECT_GE(face.least_passes, 1) << face.id;
  }
  const nlohmann::json json = nlohmann::json::parse(map_json(map));
  EXPECT_EQ(json["schema"], "openflank/bound-map/1");
  EXPECT_EQ(json["faces"].size(), 6u);
  EXPECT_NE(map_text(map).find("6 faces"), std::string::npos) << map_text(map);
}

TEST(PartMap, OfAStoppedRunNamesWhatWasNotExamined) {
  BoundJob job;
  job.part.file = test::rotor37_file("rotor37");
  job.tool.spec = "cylinder:radius=5";
  job.tool.axis_length_mm = 30.0;
  Progress progress;
  progress.cancelled = [] { return true; };
  const PartMap map = run_part_map(job, progress);
  EXPECT_FALSE(map.complete);
  EXPECT_EQ(map.faces.front().kind, MappedKind::kNotExamined);
}

}  // namespace
}  // namespace flank::internal
