// Faces that wrap round an edge, and faces that could not be read, in the table.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "flank/inspect.h"
#include "flank/inspect/inspect_text.h"
#include "geom/skins.h"
#include "io/part_files.h"

namespace flank::internal {
namespace {

Part skin_and_hole() {
  Part part;
  part.file = "blade.step";
  for (int k = 0; k < 2; ++k) {
    part.faces.push_back(testing::elliptic_skin(40.0, 4.0, 30.0));
    part.surface_types.emplace_back("B-spline");
  }
  part.faces[1] = Face();
  part.faces[0].id = "F1", part.faces[1].id = "F2";
  part.left_out[1] = "blade.step, face F2: for a reason";
  part.repairs.push_back(part.left_out[1]);
  return part;
}

TEST(InspectPieces, AreListedBelowTheirFace) {
  const InspectReport report = inspect(skin_and_hole());
  ASSERT_EQ(report.rows.size(), 2u);
  const InspectRow& whole = report.rows[0];
  ASSERT_EQ(whole.pieces.size(), 4u);
  double sum = 0.0;
  std::string kinds;
  for (const InspectRow& piece : whole.pieces) sum += piece.area_mm2, kinds += piece.id + " " + piece.type + " ";
  EXPECT_EQ(kinds, "F1a side F1b side F1c edge F1d edge ");
  EXPECT_NEAR(sum, whole.area_mm2, 1e-6 * sum);
  const std::string table = to_table(report);
  EXPECT_NE(table.find("2 faces"), std::string::npos) << "pieces are not counted";
  EXPECT_LT(table.find("F1c   edge"), table.find("F2"));
  const nlohmann::json json = nlohmann::json::parse(inspect_to_json(report));
  EXPECT_EQ(json.at("faces").size(), 2u);
  EXPECT_EQ(json.at("faces")[0].at("pieces")[1].at("id"), "F1b");
  EXPECT_FALSE(json.at("faces")[1].contains("pieces"));
}

TEST(InspectPieces, WhatWasNotReadIsSaidWithItsReason) {
  const std::string table = to_table(inspect(skin_and_hole()));
  EXPECT_NE(table.find("F2    not read   blade.step, face F2: for a reason"), std::string::npos);
  EXPECT_NE(table.find("- blade.step, face F2: for a reason"), std::string::npos);
}

void expect_two_sides(const std::string& file) {
  const InspectReport report = inspect(read_part(file));
  ASSERT_EQ(report.rows.size(), 1u);
  const std::vector<InspectRow>& pieces = report.rows[0].pieces;
  ASSERT_EQ(pieces.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(pieces[k].type, k < 2 ? "side" : "edge");
    const double share = pieces[k].area_mm2 / report.rows[0].area_mm2;
    EXPECT_TRUE(k < 2 ? share > 0.4 : share < 0.1) << pieces[k].id << " " << share;
  }
}

TEST(InspectPieces, OfRealSkins) {
  FLANK_REAL_PART(compressor, "zoo/clarkyeah_blade.igs");
  expect_two_sides(compressor);
  FLANK_REAL_PART(propeller, "zoo/occt_bug26264_blade.brep");
  expect_two_sides(propeller);
}

}  // namespace
}  // namespace flank::internal
