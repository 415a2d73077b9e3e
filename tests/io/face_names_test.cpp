#include "flank/io/face_names.h"

#include <gtest/gtest.h>

#include "geom/skins.h"
#include "io/part_files.h"

namespace flank::internal {
namespace {

/// A plate, a closed skin, and two more plates.
Part four_faces() {
  Part part;
  part.file = "part.step";
  for (int k = 1; k <= 4; ++k) {
    Face face = k == 2 ? testing::elliptic_skin(40.0, 4.0, 30.0)
                       : testing::drawn_skin([](double f) { return Vec3(20.0 * f, 0.0, 0.0); }, 10.0, 0.0, 8);
    face.id = "F" + std::to_string(k);
    part.faces.push_back(face);
    part.surface_types.emplace_back(k == 2 ? "skin" : "plate");
  }
  return part;
}

std::string refused(const Part& part, const std::string& list) {
  try {
    (void)parse_face_list(part, list);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(FaceNames, Parts) {
  EXPECT_EQ(parse_face_name("F12").number, 12);
  EXPECT_EQ(parse_face_name("f12B").piece, "b");
  for (const char* wrong : {"", "F", "12", "F0", "F-1", "Fa", "F1a2", "F1 ", "F99999999999"})
    EXPECT_EQ(parse_face_name(wrong).number, 0) << wrong;
  EXPECT_EQ(piece_name(0), "a");
  EXPECT_EQ(piece_name(25), "z");
  EXPECT_EQ(piece_name(26), "aa");
}

TEST(FaceNames, ListsAndRanges) {
  const Part part = four_faces();
  using Faces = std::vector<int>;
  EXPECT_EQ(parse_face_list(part, "F1"), Faces{0});
  EXPECT_EQ(parse_face_list(part, " f4 , F1 "), (Faces{3, 0}));
  EXPECT_EQ(parse_face_list(part, "F2-F4"), (Faces{1, 2, 3}));
  EXPECT_EQ(parse_face_list(part, "F4,F1-F2"), (Faces{3, 0, 1}));
  EXPECT_EQ(parse_face_list(part, "F3-F3"), Faces{2});
  for (const char* wrong : {"", "F5", "F0", "F1,", "F3-F2", "F3-", "-F3", "F1-F5", "1-2", "F1-F2-F3"})
    EXPECT_NE(refused(part, wrong).find("the part has F1 to F4"), std::string::npos) << wrong;
  EXPECT_NE(refused(part, "F1-F3,F2").find("named twice"), std::string::npos);
}

TEST(FaceNames, SolidsStandForTheirFaces) {
  Part part = four_faces();
  using Faces = std::vector<int>;
  EXPECT_NE(refused(part, "S1").find("the file has no solids"), std::string::npos);
  part.solids = 3;
  for (const int k : {0, 1, 2}) {
    Face& face = part.faces[static_cast<std::size_t>(k)];
    face.of_solid = true, face.solid = k;
  }
  EXPECT_EQ(parse_face_list(part, "S2"), Faces{1});
  EXPECT_EQ(parse_face_list(part, "s2-S3"), (Faces{1, 2}));
  EXPECT_EQ(parse_face_list(part, "S1,F4"), (Faces{0, 3})) << "F4 is of a sheet";
  for (const char* wrong : {"S0", "S4", "S2-", "S3-S2", "S2-F3", "S1a", "S2-S4"})
    EXPECT_NE(refused(part, wrong).find("the part has S1 to S3"), std::string::npos) << wrong;
  part.left_out[1] = "for a reason";
  EXPECT_EQ(parse_face_list(part, "S1-S2"), Faces{0});
  EXPECT_EQ(parse_faces(part, "S1-S2", Unread::kTaken), (Faces{0, 1}));
  EXPECT_EQ(parse_faces(part, "F2-F3", Unread::kTaken), (Faces{1, 2}));
  EXPECT_EQ(refused(part, "F2-F3"), "for a reason");
}

TEST(FaceNames, PiecesTakeThePlaceOfTheirFace) {
  Part part = four_faces();
  EXPECT_NE(refused(part, "F2a").find("no piece"), std::string::npos) << "not split yet";
  part.left_out[3] = "part.step, face F4: for a reason";
  split_faces(part, "F1,F2b");
  ASSERT_EQ(part.faces.size(), 7u);
  std::string ids;
  for (int k = 0; k < part.face_count(); ++k) ids += part.face_id(k) + " ";
  EXPECT_EQ(ids, "F1 F2a F2b F2c F2d F3 F4 ");
  EXPECT_EQ(part.surface_types[4], "skin");
  EXPECT_EQ(part.surface_types[5], "plate");
  using Faces = std::vector<int>;
  EXPECT_EQ(parse_face_list(part, "F2b,F2a"), (Faces{2, 1}));
  EXPECT_EQ(parse_face_list(part, "F2"), (Faces{1, 2, 3, 4})) << "the whole face is all its pieces";
  EXPECT_EQ(parse_face_list(part, "F1-F2"), (Faces{0, 1, 2, 3, 4}));
  EXPECT_NE(refused(part, "F2e").find("no piece"), std::string::npos);
  EXPECT_EQ(refused(part, "F3-F4"), "part.step, face F4: for a reason") << "one that was left out is asked for";
}

TEST(FaceNames, AFaceThatWrapsRoundNothingHasNoPieces) {
  Part part = four_faces();
  EXPECT_THROW(split_faces(part, "F1a"), InputError);
  split_faces(part, "F9a");
  EXPECT_EQ(part.faces.size(), 4u) << "that there is no such face is said when the list is read";
}

}  // namespace
}  // namespace flank::internal
