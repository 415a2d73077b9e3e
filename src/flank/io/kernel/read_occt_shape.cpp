#include "flank/io/kernel/read_occt_shape.h"

#include <fmt/format.h>

#include <BRepBuilderAPI_Transform.hxx>
#include <BRepTools_ShapeSet.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopAbs_ShapeEnum.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <istream>
#include <map>
#include <set>
#include <streambuf>

#include "flank/error.h"
#include "flank/io/kernel/plain_file.h"
#include "flank/io/kernel/read_occt_silence.h"
#include "flank/io/text/read_bytes.h"
#include "flank/io/text/read_unit.h"
#include "flank/io/text/step_syntax.h"

namespace flank::internal {
namespace {

/// A micrometre and a kilometre, and a little more.
constexpr double kSmallestUnitMm = 1e-4, kLargestUnitMm = 1e7;

[[noreturn]] void refuse_content(const std::string& file, const std::string& format, const std::string& why) {
  throw InputError(file + ": cannot be read as " + format + " (" + why +
                   "); export it again, as STEP AP203, AP214 or AP242 if there is a choice");
}

/// Millimetres of a unit as Open CASCADE names those of a STEP file: SI names with prefix, or the name of a
/// conversion-based unit.
double millimetres_of_step_unit(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  static const std::map<std::string, double> known = {
      {"millimetre", 1.0},  {"mm", 1.0},       {"millimeter", 1.0}, {"centimetre", 10.0}, {"cm", 10.0},
      {"metre", 1000.0},    {"meter", 1000.0}, {"m", 1000.0},       {"inch", 25.4},       {"in", 25.4},
      {"foot", 304.8},      {"feet", 304.8},   {"ft", 304.8},       {"micrometre", 1e-3}, {"kilometre", 1e6},
      {"decimetre", 100.0}, {"mil", 0.0254},   {"'inch'", 25.4}};
  const auto found = known.find(name);
  return found == known.end() ? 0.0 : found->second;
}

/// Exametres and the like: SI has them, no part is measured in them. The kernel does not scale by all of them.
void refuse_absurd_unit(const std::string& file, std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  if (name.ends_with("metre") && millimetres_of_step_unit(name) == 0.0)
    refuse_content(file, "STEP", "its unit of length, " + name + ", is not supported");
}

/// Of the file, for reports; the shape itself is in millimetres.
void state_unit(OcctShape& result, double millimetres) {
  result.millimetres_per_unit = millimetres;
  result.unit = unit_of(millimetres);
}

/// Makes the shape as large as it is in the unit that was asked for. The file may state another one: programs that write metres and
/// call them millimetres are many.
void use_unit(OcctShape& result, const std::string& format, const std::optional<std::string>& asked) {
  const double stated = result.millimetres_per_unit, wanted = asked ? millimetres_per(*asked) : stated;
  if (std::abs(wanted - stated) <= 1e-6 * stated || result.shape.IsNull()) return;
  gp_Trsf scale;
  scale.SetScaleFactor(wanted / stated);
  result.shape = BRepBuilderAPI_Transform(result.shape, scale, true).Shape();
  if (format != "BREP")
    result.notes.push_back(fmt::format("the file states its unit as {}; its numbers were read as {}, as --unit says",
                                       result.unit, *asked));
  state_unit(result, wanted);
}

/// A text as a stream, without a copy of it.
class TextBuffer : public std::streambuf {
 public:
  explicit TextBuffer(std::string& text) { setg(text.data(), text.data(), text.data() + text.size()); }
};

void list_faces(OcctShape& result) {
  result.faces.Clear();
  if (!result.shape.IsNull()) TopExp::MapShapes(result.shape, TopAbs_FACE, result.faces);
}

/// References are checked first: the kernel drops what it cannot resolve and says nothing.
OcctShape load_step(const std::string& file) {
  std::string content = plain_step(file, read_bytes(file));
  const std::vector<long> lost = undefined_step_references(content);
  if (!lost.empty())
    refuse_content(
        file, "STEP",
        fmt::format("#{} and {} other entities are referred to but not defined", lost.front(), lost.size() - 1));
  STEPControl_Reader reader;
  TextBuffer buffer(content);
  std::istream stream(&buffer);
  if (reader.ReadStream(file.c_str(), stream) != IFSelect_RetDone)
    refuse_content(file, "STEP", "its structure is damaged");
  std::string().swap(content);
  OcctShape result;
  TColStd_SequenceOfAsciiString lengths, angles, solid_angles;
  reader.FileUnits(lengths, angles, solid_angles);
  for (Standard_Integer i = 1; i <= lengths.Length(); ++i) refuse_absurd_unit(file, lengths.Value(i).ToCString());
  double millimetres = lengths.IsEmpty() ? 0.0 : millimetres_of_step_unit(lengths.First().ToCString());
  if (millimetres == 0.0) {
    result.notes.push_back("the file's unit of length has no common name; lengths are reported in millimetres");
    millimetres = 1.0;
  }
  for (Standard_Integer i = 2; i <= lengths.Length(); ++i)
    if (millimetres_of_step_unit(lengths.Value(i).ToCString()) != millimetres)
      result.notes.push_back("the file mixes units of length; each part of it was read in its own");
  state_unit(result, millimetres);
  reader.TransferRoots();
  result.shape = reader.OneShape();
  list_faces(result);
  result.left = faces_of_step(reader.WS(), result.faces);
  return result;
}

/// The unit is stated in the global section.
OcctShape load_iges(const std::string& file) {
  IGESControl_Reader reader;
  if (reader.ReadFile(PlainFile(file).name().c_str()) != IFSelect_RetDone)
    refuse_content(file, "IGES", "its structure is damaged");
  OcctShape result;
  const double millimetres = reader.IGESModel()->GlobalSection().UnitValue();
  if (!(millimetres >= kSmallestUnitMm && millimetres <= kLargestUnitMm))
    refuse_content(file, "IGES", fmt::format("its unit of length, {:g} mm, is not supported", millimetres));
  state_unit(result, millimetres);
  reader.TransferRoots();
  result.shape = reader.OneShape();
  list_faces(result);
  result.left = faces_of_iges(reader.WS(), result.faces);
  result.notes.insert(result.notes.end(), result.left.notes.begin(), result.left.notes.end());
  return result;
}

/// What the file holds and its shape does not use: programs write what they use, so that a reference to it is lost.
void note_unused(const BRepTools_ShapeSet& all, OcctShape& result) {
  TopTools_IndexedMapOfShape used;
  TopExp::MapShapes(result.shape, used);
  std::set<const TopoDS_TShape*> known;
  for (int i = 1; i <= used.Extent(); ++i) known.insert(used(i).TShape().get());
  int faces = 0, edges = 0, others = 0;
  for (int i = 1; i <= all.NbShapes(); ++i) {
    if (known.count(all.Shape(i).TShape().get()) > 0) continue;
    const TopAbs_ShapeEnum kind = all.Shape(i).ShapeType();
    ++(kind == TopAbs_FACE ? faces : kind == TopAbs_EDGE ? edges : others);
  }
  if (faces + edges + others > 0)
    result.notes.push_back(fmt::format(
        "the file also holds {} faces, {} edges and {} other entities that belong to no shape in it; check it "
        "before using the result",
        faces, edges, others));
}

/// BREP files state no unit, and count in millimetres.
OcctShape load_brep(const std::string& file) {
  OcctShape result;
  const PlainFile plain(file);
  std::ifstream stream(plain.name(), std::ios::binary);
  BRepTools_ShapeSet all{BRep_Builder()};
  all.Read(stream);
  if (all.NbShapes() == 0) refuse_content(file, "BREP", "its structure is damaged");
  all.Read(result.shape, stream);
  if (result.shape.IsNull()) refuse_content(file, "BREP", "its structure is damaged");
  note_unused(all, result);
  state_unit(result, 1.0);
  return result;
}

/// " that can be read (#12: ...)" where there are some in the file.
std::string first_reason(const FileFaces& left) {
  if (left.unread.empty()) return "";
  return fmt::format(" that can be read ({} of {}: {})", left.unread.front().entity, left.unread.size(),
                     left.unread.front().why);
}

}  // namespace

OcctShape load_occt_shape(const std::string& file, const std::string& format, const std::optional<std::string>& unit) {
  // The kernel prints its own messages to the standard output, which belongs to the caller.
  const OcctSilence silence;
  OcctShape result;
  try {
    Interface_Static::SetCVal("xstep.cascade.unit", "MM");
    result = format == "STEP" ? load_step(file) : format == "IGES" ? load_iges(file) : load_brep(file);
    use_unit(result, format, unit);
  } catch (const Standard_Failure& failure) {
    refuse_content(file, format, failure.GetMessageString());
  }
  list_faces(result);
  if (result.faces.IsEmpty())
    throw InputError(file + ": has no faces" + first_reason(result.left) +
                     "; expected solids, shells and faces (not curves or meshes) in " + format);
  return result;
}

}  // namespace flank::internal
