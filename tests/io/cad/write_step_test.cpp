// The text of a STEP file: its head, its objects with their names, the same bytes each time.
#include "flank/io/cad/write_step.h"

#include <gtest/gtest.h>

#include "flank/error.h"
#include "flank/io/text/read_bytes.h"
#include "flank/io/text/step_syntax.h"
#include "io/cad_shapes.h"

namespace flank::internal {
namespace {

std::vector<std::string> product_names(const std::string& text) {
  std::vector<std::string> names;
  for (std::size_t at = text.find("PRODUCT('"); at != std::string::npos; at = text.find("PRODUCT('", at + 1)) {
    const std::size_t begin = at + 9;
    names.push_back(text.substr(begin, text.find('\'', begin) - begin));
  }
  return names;
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

std::vector<NamedFaces> two_objects() {
  return {{"target", {test::plane_face("F1", 10.0, 4.0), test::quarter_cylinder("F2", 5.0, 12.0)}},
          {"strip 1", {test::plane_face("F1", 3.0, 4.0, 7.0)}}};
}

TEST(WriteStepText, HeadSaysUnitsSchemaAndTitleAndNoDate) {
  const std::string text = faces_to_step("a part", two_objects());
  EXPECT_EQ(text.rfind("ISO-10303-21;", 0), 0u);
  EXPECT_NE(text.find("END-ISO-10303-21;"), std::string::npos);
  EXPECT_NE(text.find("FILE_NAME('a part','1970-01-01T00:00:00'"), std::string::npos);
  EXPECT_NE(text.find("'OpenFlank'"), std::string::npos);
  EXPECT_NE(text.find("AUTOMOTIVE_DESIGN"), std::string::npos);
  EXPECT_NE(text.find("SI_UNIT(.MILLI.,.METRE.)"), std::string::npos);
  EXPECT_TRUE(undefined_step_references(text).empty());
}

TEST(WriteStepText, EveryObjectIsAProductOfItsName) {
  EXPECT_EQ(product_names(faces_to_step("t", two_objects())), (std::vector<std::string>{"target", "strip 1"}));
  EXPECT_EQ(product_names(faces_to_step("t", {{"alone", {test::plane_face("F1", 1.0, 1.0)}}})),
            std::vector<std::string>{"alone"});
}

TEST(WriteStepText, ManyFacesOfAnObjectAreStillOneProduct) {
  std::vector<Face> faces;
  for (int k = 0; k < 9; ++k) faces.push_back(test::plane_face("F1", 10.0, 4.0, k));
  const std::string text = faces_to_step("t", {{"all", faces}});
  EXPECT_EQ(product_names(text), std::vector<std::string>{"all"});
  EXPECT_EQ(count(text, "ADVANCED_FACE("), 9u);
}

TEST(WriteStepText, WhatWasWrittenBeforeLeavesNoTrace) {
  const std::string first = faces_to_step("t", two_objects());
  (void)faces_to_step("other", {{"something else", {test::quarter_cylinder("F1", 2.0, 2.0)}}});
  EXPECT_TRUE(first == faces_to_step("t", two_objects()));
}

TEST(WriteStepText, ObjectsAreReadBackInTheirOrder) {
  const testing_io::Scratch scratch;
  const Part part = read_part(scratch.write("a.step", faces_to_step("t", two_objects())));
  ASSERT_EQ(part.faces.size(), 3u);
  EXPECT_NEAR(testing_io::area_of(part.faces[0]), 40.0, 1e-9);
  EXPECT_NEAR(testing_io::area_of(part.faces[1]), 0.5 * std::numbers::pi * 60.0, 0.02);
  EXPECT_NEAR(testing_io::area_of(part.faces[2]), 12.0, 1e-9);
  ASSERT_EQ(part.repairs.size(), 1u);
  EXPECT_NE(part.repairs.front().find("loose faces"), std::string::npos) << part.repairs.front();
}

TEST(WriteStepText, NamesWithQuotesDoNotEndTheirText) {
  const testing_io::Scratch scratch;
  const std::string text = faces_to_step("it's", {{"o'clock #99", {test::plane_face("F1", 10.0, 4.0)}}});
  EXPECT_TRUE(undefined_step_references(text).empty());
  EXPECT_EQ(read_part(scratch.write("a.step", text)).faces.size(), 1u);
}

TEST(WriteStepText, AFileThatCannotBeWrittenIsRefusedAndLeavesNothing) {
  const testing_io::Scratch scratch;
  EXPECT_THROW(write_step(scratch.path("none/a.step"), {test::plane_face("F1", 1.0, 1.0)}), InputError);
  write_step(scratch.path("b.step"), {test::plane_face("F1", 1.0, 1.0)});
  EXPECT_EQ(product_names(read_bytes(scratch.path("b.step"))), std::vector<std::string>{"b"}) << "named by its file";
  EXPECT_EQ(std::distance(testing_io::fs::directory_iterator(scratch.path("")), {}), 1);
}

}  // namespace
}  // namespace flank::internal
