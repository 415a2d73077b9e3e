#include "flank/io/cad/read_cad.h"

#include <fmt/format.h>

#include <BRepBndLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Poly_Triangulation.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <utility>

#include "flank/error.h"
#include "flank/io/cad/read_occt_face.h"
#include "flank/io/cad/read_occt_sew.h"
#include "flank/io/cad/read_occt_shape.h"
#include "flank/io/cad/read_occt_silence.h"

namespace flank::internal {
namespace {

/// Tessellation for boxes and volumes only: chord error as a share of each edge's size, and in angle. Half the angle takes seven times as long on blades,
/// and moves their boxes by less than a thousandth.
constexpr double kRelativeDeflection = 0.01;
constexpr double kAngularDeflection = 0.6;

/// Adds the nodes of the face's triangulation to the box; returns six times the signed volume of the cone from the
/// origin over it, with the face oriented as it stands in its solid.
double add_triangulation(const TopoDS_Face& face, Box3& box) {
  TopLoc_Location location;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, location);
  if (mesh.IsNull()) return 0.0;
  std::vector<Vec3> nodes;
  for (int i = 1; i <= mesh->NbNodes(); ++i) {
    const gp_Pnt p = mesh->Node(i).Transformed(location.Transformation());
    nodes.emplace_back(p.X(), p.Y(), p.Z());
    box.add(nodes.back());
  }
  double volume = 0.0;
  for (int i = 1; i <= mesh->NbTriangles(); ++i) {
    int a = 0, b = 0, c = 0;
    mesh->Triangle(i).Get(a, b, c);
    volume += nodes[static_cast<std::size_t>(a - 1)].dot(
        nodes[static_cast<std::size_t>(b - 1)].cross(nodes[static_cast<std::size_t>(c - 1)]));
  }
  return face.Orientation() == TopAbs_REVERSED ? -volume : volume;
}

/// The box of a face: exact where the surface is elementary and that is cheap, else that of the tessellation.
void add_extent(const TopoDS_Face& face, const std::string& type, Box3& box) {
  add_triangulation(face, box);
  if (type != "plane" && type != "cylinder" && type != "cone" && type != "sphere" && type != "torus") return;
  Bnd_Box exact;
  BRepBndLib::AddOptimal(face, exact, false, false);
  if (exact.IsVoid() || exact.IsOpen()) return;
  double x0 = 0.0, y0 = 0.0, z0 = 0.0, x1 = 0.0, y1 = 0.0, z1 = 0.0;
  exact.Get(x0, y0, z0, x1, y1, z1);
  box.add(Vec3(x0, y0, z0));
  box.add(Vec3(x1, y1, z1));
}

/// Tells every face its solid and its orientation in it; a solid of negative volume is inside out and all its faces are
/// turned.
void assign_solids(const TopoDS_Shape& shape, const TopTools_IndexedMapOfShape& index, Part& part) {
  TopTools_IndexedMapOfShape solids;
  TopExp::MapShapes(shape, TopAbs_SOLID, solids);
  part.solids = solids.Extent();
  for (int k = 1; k <= solids.Extent(); ++k) {
    double volume = 0.0;
    Box3 ignored;
    std::vector<Face*> members;
    for (TopExp_Explorer it(solids(k), TopAbs_FACE); it.More(); it.Next()) {
      const TopoDS_Face face = TopoDS::Face(it.Current());
      volume += add_triangulation(face, ignored);
      Face& member = part.faces[static_cast<std::size_t>(index.FindIndex(face) - 1)];
      if (member.of_solid) continue;  // shared with an earlier solid
      member.of_solid = true;
      member.solid = k - 1;
      member.reversed = face.Orientation() == TopAbs_REVERSED;
      members.push_back(&member);
    }
    if (volume >= 0.0) continue;
    for (Face* member : members) member->reversed = !member->reversed;
    part.repairs.push_back("solid " + std::to_string(k) + " was inside out (negative volume): its " +
                           std::to_string(members.size()) + " faces were turned");
  }
}

/// A file without solids: its faces are sewn, and where they close the sides are those of the solid.
void sew_sheets(const TopTools_IndexedMapOfShape& index, Part& part) {
  const SewnFaces sewn = sew_loose_faces(index, part.box.diagonal());
  part.solids = sewn.solids;
  for (std::size_t k = 0; k < part.faces.size(); ++k) {
    part.faces[k].solid = sewn.solid[k];
    part.faces[k].of_solid = sewn.solid[k] >= 0;
    part.faces[k].reversed = sewn.reversed[k];
  }
  // A face that is all there is, is a sheet on purpose.
  if (part.faces.size() > 1) part.repairs.insert(part.repairs.end(), sewn.notes.begin(), sewn.notes.end());
}

/// Converts a face, or leaves it out with the reason: one face that nobody asked for must not lose the part.
void add_face(const TopoDS_Face& face, Part& part) {
  const std::string id = fmt::format("F{}", part.faces.size() + 1);
  const std::string name = part.file + ", face " + id;
  OcctFace converted;
  converted.type = "unknown";
  try {
    converted = convert_occt_face(face, name);
    part.repairs.insert(part.repairs.end(), converted.notes.begin(), converted.notes.end());
    add_extent(face, converted.type, part.box);
  } catch (const InputError& error) {
    converted.face = {};
    part.left_out[static_cast<int>(part.faces.size())] = error.what();
  } catch (const Standard_Failure& failure) {
    converted.face = {};
    part.left_out[static_cast<int>(part.faces.size())] =
        fmt::format("{}: its geometry cannot be used ({})", name, failure.GetMessageString());
  }
  converted.face.id = id;
  part.faces.push_back(std::move(converted.face));
  part.surface_types.push_back(std::move(converted.type));
}

/// Notes for what is left out; a part of which nothing is left is refused.
void refuse_unreadable(Part& part) {
  if (part.left_out.size() == part.faces.size()) throw InputError(part.left_out.begin()->second);
  for (const auto& [face, why] : part.left_out)
    part.repairs.push_back(why + "; the face is left out, nothing is known of what enters it");
}

}  // namespace

Part read_cad(const std::string& file, const std::string& format, const std::optional<std::string>& unit) {
  const OcctSilence silence;
  OcctShape loaded = load_occt_shape(file, format, unit);
  Part part;
  part.file = file;
  part.format = format;
  part.unit = loaded.unit;
  part.millimetres_per_unit = loaded.millimetres_per_unit;
  part.repairs = std::move(loaded.notes);
  TopTools_IndexedMapOfShape index;
  TopExp::MapShapes(loaded.shape, TopAbs_FACE, index);
  try {
    const BRepMesh_IncrementalMesh meshed(loaded.shape, kRelativeDeflection, true, kAngularDeflection, false);
    for (int i = 1; i <= index.Extent(); ++i) add_face(TopoDS::Face(index(i)), part);
    refuse_unreadable(part);
    assign_solids(loaded.shape, index, part);
    if (part.solids == 0) sew_sheets(index, part);
  } catch (const Standard_Failure& failure) {
    throw InputError(file + ": its geometry cannot be used (" + failure.GetMessageString() + "); export it again");
  }
  return part;
}

}  // namespace flank::internal
