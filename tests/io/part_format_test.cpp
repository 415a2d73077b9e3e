#include "flank/io/part_format.h"

#include <gtest/gtest.h>

#include "flank/error.h"
#include "flank/io/mesh/read_stl.h"
#include "flank/io/text/read_bytes.h"
#include "flank/io/text/step_syntax.h"
#include "flank/part.h"
#include "io/part_files.h"

namespace flank::internal {
namespace {

std::string iges_line(const std::string& text, char section) {
  std::string line = text;
  line.resize(72, ' ');
  return line + section + "      1\n";
}

std::string binary_stl(std::uint32_t count, std::size_t facets) {
  std::string bytes(84 + 50 * facets, '\0');
  bytes[80] = static_cast<char>(count);
  return bytes;
}

const std::string kStep = "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n";
const std::string kIges = iges_line("part", 'S') + iges_line("1H,,1H;", 'G') + iges_line("S      1G      1", 'T');
const std::string kPly = "ply\nformat ascii 1.0\nend_header\n";
const std::string kTextStl = "solid a\nfacet normal 0 0 1\nendsolid\n";
const std::string kObj = "# made elsewhere\n\nmtllib a.mtl\no a\nv 0 0 0\n";
const std::string kBrep = "\nCASCADE Topology V1, (c) Matra-Datavision\n";

std::string refusal(const std::string& file, const std::string& content) {
  try {
    return "read as " + std::string(sniff_format(file, content).name);
  } catch (const InputError& e) {
    return e.what();
  }
}

TEST(SniffFormat, IsWhatTheContentIsWhateverTheNamesCase) {
  const std::vector<std::tuple<std::string, std::string, std::string>> files = {
      {"a.step", kStep, "STEP"},
      {"a.STP", kStep, "STEP"},
      {"a.p21", "\xEF\xBB\xBF " + kStep, "STEP"},
      {"a.iges", kIges, "IGES"},
      {"a.Igs", kIges, "IGES"},
      {"a.brep", kBrep, "BREP"},
      {"a.brp", "DBRep_DrawableShape\n", "BREP"},
      {"a.ply", kPly, "PLY"},
      {"a.ply", "ply\r\nformat", "PLY"},
      {"a.stl", kTextStl, "STL"},
      {"a.stl", binary_stl(2, 2), "STL"},
      {"a.obj", kObj, "OBJ"},
      {"dir.step/a.obj", kObj, "OBJ"}};
  for (const auto& [file, content, format] : files) EXPECT_EQ(refusal(file, content), "read as " + format) << file;
}

TEST(SniffFormat, ANameThatSaysSomethingElseIsRefusedWithBothNamed) {
  EXPECT_EQ(refusal("a.stl", kStep), "a.stl: the name says STL but the content is STEP; rename it to match");
  EXPECT_EQ(refusal("a.step", kObj), "a.step: the name says STEP but the content is OBJ; rename it to match");
  EXPECT_EQ(refusal("a.igs", kPly), "a.igs: the name says IGES but the content is PLY; rename it to match");
}

TEST(SniffFormat, ANameThatIsNotReadIsRefusedWithWhatIs) {
  for (const char* file : {"a.3mf", "a", ".step", "a.step.gz"}) {
    const std::string message = refusal(file, kStep);
    EXPECT_EQ(message.rfind(std::string(file) + ": the extension \"", 0), 0u) << message;
    for (const char* format : {"STEP", "IGES", "BREP", "STL", "OBJ", "PLY"})
      EXPECT_NE(message.find(format), std::string::npos) << message;
  }
}

TEST(SniffFormat, ContentThatIsNothingIsRefused) {
  for (const char* file : {"a.step", "a.iges", "a.brep", "a.obj", "a.ply"})
    EXPECT_NE(refusal(file, "Dear reader,\nthis is a letter.\n").find("the content is not"), std::string::npos) << file;
  EXPECT_EQ(refusal("a.stl", binary_stl(3, 2)), "read as STL") << "its reader can say what is wrong with the size";
  EXPECT_NE(refusal("a.obj", "v 0 0 0\n").find("read as"), std::string::npos);
  EXPECT_NE(refusal("a.obj", "vertices 3\nv 0 0 0\n").find("not OBJ"), std::string::npos) << "no word of the format";
  EXPECT_NE(refusal("a.obj", "f 1 2 3\n").find("not OBJ"), std::string::npos) << "no vertex";
}

TEST(SniffFormat, FilesThatLackTheirEndAreTruncated) {
  EXPECT_NE(refusal("a.step", kStep.substr(0, kStep.size() - 10)).find("truncated"), std::string::npos);
  EXPECT_EQ(refusal("a.step", kStep + "\n\n  \n"), "read as STEP");
  const std::string lost = kIges.substr(0, kIges.size() - 81);
  EXPECT_NE(refusal("a.iges", lost).find("T in column 73"), std::string::npos) << refusal("a.iges", lost);
  EXPECT_EQ(refusal("a.iges", kIges + "\r\n\n"), "read as IGES");
}

TEST(PartFormats, AreNamedInMessagesByTheirRows) {
  EXPECT_EQ(part_formats(), "STEP, IGES, BREP, STL, OBJ or PLY");
  EXPECT_EQ(accepted_part_files(),
            "STEP (.step .stp .p21), IGES (.iges .igs), BREP (.brep .brp), STL (.stl), OBJ (.obj) or PLY (.ply)");
  EXPECT_TRUE(is_mesh_file("a.STL"));
  EXPECT_FALSE(is_mesh_file("a.step"));
  EXPECT_FALSE(is_mesh_file("a"));
}

TEST(IsBinaryStl, OnlyBySize) {
  EXPECT_TRUE(is_binary_stl(binary_stl(0, 0)));
  EXPECT_TRUE(is_binary_stl(binary_stl(7, 7)));
  EXPECT_FALSE(is_binary_stl(binary_stl(7, 6)));
  EXPECT_FALSE(is_binary_stl(binary_stl(7, 7) + "x"));
  EXPECT_FALSE(is_binary_stl(std::string(83, '\0')));
  EXPECT_FALSE(is_binary_stl(""));
}

TEST(ReadBytes, IsTheWholeFileOrARefusal) {
  const testing_io::Scratch scratch;
  const std::string bytes("a\0b\r\n\xff", 6);
  EXPECT_EQ(read_bytes(scratch.write("a.stl", bytes)), bytes);
  for (const auto& [file, why] :
       {std::pair(scratch.path("none.stl"), "no such file"), std::pair(scratch.path(""), "is a folder"),
        std::pair(scratch.write("empty.stl", ""), "is empty"),
        std::pair(std::string(5000, 'x') + ".stl", "no such file")}) {
    try {
      (void)read_bytes(file);
      ADD_FAILURE() << file;
    } catch (const InputError& e) {
      EXPECT_EQ(std::string(e.what()).rfind(file + ": " + why, 0), 0u) << e.what();
    }
  }
}

TEST(LostReferences, AreThoseUsedAndNotDefined) {
  using Ids = std::vector<long>;
  EXPECT_EQ(undefined_step_references("DATA;\n#1=A(#2);\n#2=B();"), Ids());
  EXPECT_EQ(undefined_step_references("DATA;\n#1 \n = A(#2,#30,#4);\n#4=B(#30);"), (Ids{2, 30}));
  EXPECT_EQ(undefined_step_references("#9=X(#8);\nDATA;\n#1=A();"), Ids()) << "the head has no entities";
  EXPECT_EQ(undefined_step_references("no data section, #5"), Ids());
  EXPECT_EQ(undefined_step_references("DATA;\n#1=A('it''s #7',#2);"), Ids{2}) << "text is not looked into";
}

TEST(LostReferences, CommentsAreNotLookedInto) {
  using Ids = std::vector<long>;
  // An apostrophe in a comment once turned every text after it inside out.
  EXPECT_EQ(undefined_step_references("DATA;\n/* the part's #5 */\n#1=A('hole #9',#2);\n#2=B();"), Ids());
  EXPECT_EQ(undefined_step_references("DATA;\n#1=A('/*',#3);\n#2=B('*/');"), Ids{3}) << "none begins in a text";
  EXPECT_EQ(undefined_step_references("DATA;\n#1=A(#4); /* without an end #6"), Ids{4});
}

TEST(LostReferences, NumbersTooLongForAnyFileAreStillLost) {
  const std::vector<long> lost = undefined_step_references("DATA;\n#1=A(#99999999999999999999999999,#2);\n#2=B();");
  ASSERT_EQ(lost.size(), 1u);
  EXPECT_GT(lost[0], 1'000'000'000L);
}

}  // namespace
}  // namespace flank::internal
