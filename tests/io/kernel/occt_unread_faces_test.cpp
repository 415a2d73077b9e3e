// Faces that are in a file and of which the CAD kernel makes nothing keep their numbers, and say so.
#include "flank/io/kernel/occt_unread_faces.h"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_Transform.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <gp_Trsf.hxx>

#include "io/kernel_files.h"

namespace flank::internal {
namespace {

using testing_io::bored_block;
using testing_io::iges_text;
using testing_io::places_of;
using testing_io::reference_at;
using testing_io::Scratch;
using testing_io::step_text;

Part read_as(const std::string& name, const std::string& text) {
  const Scratch scratch;
  return read_part(scratch.write(name, text));
}

std::string replaced(std::string text, std::size_t at, const std::string& old, const std::string& by) {
  EXPECT_EQ(text.compare(at, old.size(), old), 0) << text.substr(at, 40);
  return text.replace(at, old.size(), by);
}

/// The damaged file has the faces of the sound one under their numbers, but for those in `unread`. What has become of the surface of a lost
/// face may stand behind them.
void expect_the_others(const Part& sound, const Part& damaged, const std::vector<int>& unread) {
  ASSERT_GE(damaged.face_count(), sound.face_count());
  for (int k = 0; k < sound.face_count(); ++k) {
    const bool lost = std::find(unread.begin(), unread.end(), k) != unread.end();
    EXPECT_EQ(damaged.is_left_out(k), lost) << damaged.face_id(k);
    EXPECT_EQ(damaged.face_id(k), sound.face_id(k));
    const auto at = static_cast<std::size_t>(k);
    if (lost) continue;
    EXPECT_EQ(damaged.faces[at].surface.poles, sound.faces[at].surface.poles) << damaged.face_id(k);
  }
}

/// What can be wrong with a face of a STEP file, each as an edit of the text at "ADVANCED_FACE".
struct StepDamage {
  const char* what;
  std::string (*edit)(const std::string& text, std::size_t face);
};

const std::vector<StepDamage> kStepDamages = {
    {"its surface is a border",
     [](const std::string& text, std::size_t face) {
       // #1 = ADVANCED_FACE('',(#border, ...),#surface,.T.): the surface follows the list.
       const std::size_t list = text.find("),#", face) + 2;
       return replaced(text, list, reference_at(text, list, 0), reference_at(text, face, 0));
     }},
    {"its surface is a number",
     [](const std::string& text, std::size_t face) {
       const std::size_t list = text.find("),#", face) + 2;
       return replaced(text, list, reference_at(text, list, 0), "7");
     }},
    {"it is a word that nobody knows",
     [](const std::string& text, std::size_t face) { return replaced(text, face, "ADVANCED_FACE", "ADVANCED_PHASE"); }},
};

TEST(UnreadFaces, OfStepKeepTheirNumbers) {
  const std::string text = step_text(bored_block());
  const Part sound = read_as("block.step", text);
  ASSERT_EQ(sound.face_count(), 7);
  ASSERT_TRUE(sound.left_out.empty());
  const std::vector<std::size_t> faces = places_of(text, "ADVANCED_FACE");
  ASSERT_EQ(faces.size(), 7u);
  for (const StepDamage& damage : kStepDamages) {
    for (int k = 0; k < 7; ++k) {
      SCOPED_TRACE(damage.what + std::string(", F") + std::to_string(k + 1));
      const Part damaged = read_as("block.step", damage.edit(text, faces[static_cast<std::size_t>(k)]));
      expect_the_others(sound, damaged, {k});
      if (damaged.left_out.count(k) > 0) {
        EXPECT_NE(damaged.left_out.at(k).find("face " + sound.face_id(k)), std::string::npos) << damaged.left_out.at(k);
        EXPECT_TRUE(testing_io::tells(damaged, damaged.left_out.at(k)));
      }
    }
  }
}

TEST(UnreadFaces, AreThoseOfWhichAPartIsNotThere) {
  const std::string text = step_text(bored_block());
  const Part sound = read_as("block.step", text);
  // A border that names an edge of another one is torn; the kernel would go straight across.
  const std::vector<std::size_t> loops = places_of(text, "EDGE_LOOP");
  const std::string stranger = reference_at(text, loops[2], 2);
  std::string torn = text;
  torn.replace(torn.find('#', loops[0]), reference_at(text, loops[0], 0).size(), stranger);
  const Part damaged = read_as("block.step", torn);
  ASSERT_EQ(damaged.face_count(), sound.face_count());
  EXPECT_TRUE(damaged.is_left_out(0));
  EXPECT_NE(damaged.left_out.at(0).find("do not meet"), std::string::npos) << damaged.left_out.at(0);
  const std::string first = reference_at(text, loops[0], 0);
  std::string twice = text;
  twice.insert(twice.find('#', loops[0]), first + ",");
  EXPECT_TRUE(read_as("block.step", twice).is_left_out(0));
}

/// All numbers of the text in another spelling.
std::string spelled(const std::string& text,
                    std::string (*other)(const std::string& mantissa, const std::string& exponent)) {
  std::string out;
  std::size_t at = text.find("DATA;");
  out = text.substr(0, at);
  const std::string of_numbers = "+-.0123456789E";
  while (at < text.size()) {
    const bool begins =
        (text[at - 1] == '(' || text[at - 1] == ',') && of_numbers.find(text[at]) < 13 && text[at] != '.';
    std::size_t end = at + 1;
    while (begins && of_numbers.find(text[end]) != std::string::npos) ++end;
    const std::string word = text.substr(at, end - at);
    const std::size_t e = word.find('E');
    const bool real = begins && word.find('.') != std::string::npos;
    out += real ? other(word.substr(0, e), e == std::string::npos ? "0" : word.substr(e + 1)) : word;
    at = end;
  }
  return out;
}

TEST(SpelledNumbers, OfStepAreTheSamePart) {
  const std::string text = step_text(bored_block());
  const Part sound = read_as("block.step", text);
  for (const auto other : {+[](const std::string&m, const std::string&e) { return m + "e" + e; },
                           +[](const std::string&m, const std::string&e) { return m + "D" + e; },
                           +[](const std::string&m, const std::string&e) { return m + "d" + e; },
                           +[](const std::string&m, const std::string&e) { return m + "0E" + e; },
                           +[](const std::string&m, const std::string&e) {
                             return (m.front() == '-' ? "" : "+") + m + "e" + e + " /* as it was */";
                           },
                           +[](const std::string&m, const std::string&e) {
                             return m.back() == '.' ? m.substr(0, m.size() - 1) + "e" + e : m + "E" + e;
                           }}) {
    const std::string written = spelled(text, other);
    ASSERT_NE(written, text);
    const Part part = read_as("block.step", written);
    ASSERT_EQ(part.face_count(), sound.face_count());
    EXPECT_EQ(part.repairs, sound.repairs);
    for (std::size_t k = 0; k < part.faces.size(); ++k)
      EXPECT_EQ(part.faces[k].surface.poles, sound.faces[k].surface.poles) << k;
  }
}

TEST(UnreadFaces, OfAnAssemblyAreMissingWhereverThePartStands) {
  const TopoDS_Shape block = bored_block();
  gp_Trsf away;
  away.SetTranslation(gp_Vec(100.0, 0.0, 0.0));
  TopoDS_Compound both;
  BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, block);
  builder.Add(both, block.Moved(TopLoc_Location(away)));
  Interface_Static::SetIVal("write.step.assembly", 1);
  const std::string text = step_text(both);
  Interface_Static::SetIVal("write.step.assembly", 0);
  const std::vector<std::size_t> faces = places_of(text, "ADVANCED_FACE");
  const Part sound = read_as("two.step", text);
  ASSERT_EQ(sound.face_count(), 14);
  ASSERT_EQ(faces.size(), 7u) << "one part, twice";
  for (const int k : {0, 3, 6})
    expect_the_others(sound, read_as("two.step", kStepDamages[0].edit(text, faces[static_cast<std::size_t>(k)])),
                      {k, k + 7});
}

/// The parameter lines that begin an entity of this type: its surface is the parameter after the type.
std::string with_no_surface(std::string text, const std::string& type, int k) {
  std::vector<std::size_t> lines;
  for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1) {
    const bool parameters = at + 73 < text.size() && text[at + 72] == 'P';
    if (parameters && text.compare(at, type.size() + 1, type + ",") == 0) lines.push_back(at + type.size() + 1);
    if (text.find('\n', at) == std::string::npos) break;
  }
  EXPECT_EQ(lines.size(), 7u);
  std::size_t at = lines[static_cast<std::size_t>(k)];
  // The columns stay: zeros in front of a zero.
  for (; text[at] != ','; ++at) text[at] = '0';
  return text;
}

TEST(UnreadFaces, OfIgesKeepTheirNumbers) {
  for (const bool solid : {true, false}) {
    const std::string text = iges_text(bored_block(), solid);
    const Part sound = read_as("block.igs", text);
    ASSERT_EQ(sound.face_count(), 7) << solid;
    ASSERT_TRUE(sound.left_out.empty());
    for (int k = 0; k < 7; ++k) {
      SCOPED_TRACE((solid ? "solid, F" : "surfaces, F") + std::to_string(k + 1));
      expect_the_others(sound, read_as("block.igs", with_no_surface(text, solid ? "510" : "144", k)), {k});
    }
  }
}

TEST(UnreadFaces, AFileOfWhichNoFaceIsReadIsRefused) {
  std::string text = step_text(bored_block());
  // From the last to the first: the new word is longer.
  const std::vector<std::size_t> faces = places_of(text, "ADVANCED_FACE");
  for (auto at = faces.rbegin(); at != faces.rend(); ++at) text = kStepDamages[2].edit(text, *at);
  const Scratch scratch;
  EXPECT_NE(testing_io::refusal(scratch.write("none.step", text)).find("no faces"), std::string::npos);
}

/// A part is its surfaces: triangles that a file brings along may be those of another shape.
TEST(UnreadFaces, TrianglesOfTheFileAreNotThePart) {
  const TopoDS_Shape block = bored_block();
  const BRepMesh_IncrementalMesh meshed(block, 0.1);
  TopLoc_Location location;
  const TopoDS_Face face = TopoDS::Face(TopExp_Explorer(block, TopAbs_FACE).Current());
  BRep_Tool::Triangulation(face, location)->SetNode(1, gp_Pnt(0.0, 0.0, 500.0));
  const Part part = read_as("block.brep", testing_io::brep_text(block));
  EXPECT_NEAR((part.box.high - part.box.low).z(), 10.0, 1e-9);
}

}  // namespace
}  // namespace flank::internal
