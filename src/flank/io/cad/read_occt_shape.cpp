#include "flank/io/cad/read_occt_shape.h"

#include <fmt/format.h>

#include <BRepBuilderAPI_Transform.hxx>
#include <BRepTools.hxx>
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
#include <TopExp_Explorer.hxx>
#include <algorithm>
#include <cctype>
#include <map>

#include "flank/error.h"
#include "flank/io/cad/read_occt_silence.h"
#include "flank/io/text/read_sniff.h"
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

/// CAD files state their unit: a user who names another one has the wrong file, or would get the wrong size.
void refuse_other_unit(const std::string& file, const std::optional<std::string>& asked, double millimetres) {
  if (asked && std::abs(millimetres_per(*asked) - millimetres) > 1e-6 * millimetres)
    throw InputError(file + ": states its own unit (" + unit_of(millimetres) + "), which `unit` " + *asked +
                     " contradicts; omit `unit`");
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
    refuse_content(file, "STEP", "its unit of length, " + name + ", is none of parts");
}

/// Of the file, for reports; the shape itself is in millimetres.
void state_unit(OcctShape& result, double millimetres) {
  result.millimetres_per_unit = millimetres;
  result.unit = unit_of(millimetres);
}

/// References are checked first: the kernel drops what it cannot resolve and says nothing.
OcctShape load_step(const std::string& file, const std::optional<std::string>& unit) {
  const std::string content = read_bytes(file);
  check_step_syntax(file, content);
  const std::vector<long> lost = undefined_step_references(content);
  if (!lost.empty())
    refuse_content(
        file, "STEP",
        fmt::format("#{} and {} other entities are referred to but not defined", lost.front(), lost.size() - 1));
  STEPControl_Reader reader;
  if (reader.ReadFile(file.c_str()) != IFSelect_RetDone) refuse_content(file, "STEP", "its structure is damaged");
  OcctShape result;
  TColStd_SequenceOfAsciiString lengths, angles, solid_angles;
  reader.FileUnits(lengths, angles, solid_angles);
  for (Standard_Integer i = 1; i <= lengths.Length(); ++i) refuse_absurd_unit(file, lengths.Value(i).ToCString());
  double millimetres = lengths.IsEmpty() ? 0.0 : millimetres_of_step_unit(lengths.First().ToCString());
  if (millimetres == 0.0) {
    result.notes.push_back("the file's unit of length is not one that is known by name; millimetres are reported");
    millimetres = 1.0;
  }
  for (Standard_Integer i = 2; i <= lengths.Length(); ++i)
    if (millimetres_of_step_unit(lengths.Value(i).ToCString()) != millimetres)
      result.notes.push_back("the file mixes units of length; each part of it was read in its own");
  refuse_other_unit(file, unit, millimetres);
  state_unit(result, millimetres);
  reader.TransferRoots();
  result.shape = reader.OneShape();
  return result;
}

/// The unit is stated in the global section.
OcctShape load_iges(const std::string& file, const std::optional<std::string>& unit) {
  IGESControl_Reader reader;
  if (reader.ReadFile(file.c_str()) != IFSelect_RetDone) refuse_content(file, "IGES", "its structure is damaged");
  OcctShape result;
  const double millimetres = reader.IGESModel()->GlobalSection().UnitValue();
  if (!(millimetres >= kSmallestUnitMm && millimetres <= kLargestUnitMm))
    refuse_content(file, "IGES", fmt::format("its unit of length, {:g} mm, is none of parts", millimetres));
  refuse_other_unit(file, unit, millimetres);
  state_unit(result, millimetres);
  reader.TransferRoots();
  result.shape = reader.OneShape();
  return result;
}

/// BREP files state no unit: millimetres unless the user names another one.
OcctShape load_brep(const std::string& file, const std::optional<std::string>& unit) {
  OcctShape result;
  if (!BRepTools::Read(result.shape, file.c_str(), BRep_Builder()))
    refuse_content(file, "BREP", "its structure is damaged");
  state_unit(result, unit ? millimetres_per(*unit) : 1.0);
  if (result.millimetres_per_unit != 1.0 && !result.shape.IsNull()) {
    gp_Trsf scale;
    scale.SetScaleFactor(result.millimetres_per_unit);
    result.shape = BRepBuilderAPI_Transform(result.shape, scale, true).Shape();
  }
  return result;
}

/// Entities of the kinds that become faces, as the text of a STEP file has them.
int count_step_faces(const std::string& content) {
  int count = 0;
  for (const std::string word : {"ADVANCED_FACE", "FACE_SURFACE"})
    for (std::size_t at = content.find(word); at != std::string::npos; at = content.find(word, at + 1)) {
      const char after = content[std::min(at + word.size(), content.size() - 1)];
      count += after == '(' || after == ' ';
    }
  return count;
}

int count_faces(const TopoDS_Shape& shape) {
  int count = 0;
  for (TopExp_Explorer it(shape, TopAbs_FACE); it.More(); it.Next()) ++count;
  return count;
}

}  // namespace

OcctShape load_occt_shape(const std::string& file, const std::string& format, const std::optional<std::string>& unit) {
  // The kernel prints its own messages to the standard output, which belongs to the caller.
  const OcctSilence silence;
  OcctShape result;
  try {
    Interface_Static::SetCVal("xstep.cascade.unit", "MM");
    result = format == "STEP"   ? load_step(file, unit)
             : format == "IGES" ? load_iges(file, unit)
                                : load_brep(file, unit);
  } catch (const Standard_Failure& failure) {
    refuse_content(file, format, failure.GetMessageString());
  }
  const int faces = result.shape.IsNull() ? 0 : count_faces(result.shape);
  if (faces == 0)
    throw InputError(file + ": has no faces; accepted are solids, shells and faces (not curves or meshes) in " +
                     format);
  if (format == "STEP") {
    // Faces that fail are left out silently, so the text of the file is counted.
    const int listed = count_step_faces(read_bytes(file));
    if (faces < listed)
      result.notes.push_back(
          fmt::format("{} of {} faces in the file could not be read and are missing", listed - faces, listed));
  }
  return result;
}

}  // namespace flank::internal
