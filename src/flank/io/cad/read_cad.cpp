#include "flank/io/cad/read_cad.h"

#include <fmt/format.h>

#include <BRepBndLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Poly_Triangulation.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <utility>

#include "flank/error.h"
#include "flank/io/cad/read_occt_border.h"
#include "flank/io/cad/read_occt_face.h"
#include "flank/io/cad/read_occt_sew.h"
#include "flank/io/kernel/read_occt_shape.h"
#include "flank/io/kernel/read_occt_silence.h"

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

/// Where the faces of the file's shape are among those of the part, among which are those that the kernel did not read.
using Places = std::vector<std::size_t>;

/// Tells every face its solid and its orientation in it; a solid of negative volume is inside out and all its faces are
/// turned.
void assign_solids(const OcctShape& loaded, const Places& places, Part& part) {
  TopTools_IndexedMapOfShape solids;
  TopExp::MapShapes(loaded.shape, TopAbs_SOLID, solids);
  part.solids = solids.Extent();
  for (int k = 1; k <= solids.Extent(); ++k) {
    double volume = 0.0;
    Box3 ignored;
    std::vector<Face*> members;
    for (TopExp_Explorer it(solids(k), TopAbs_FACE); it.More(); it.Next()) {
      const TopoDS_Face face = TopoDS::Face(it.Current());
      volume += add_triangulation(face, ignored);
      Face& member = part.faces[places[static_cast<std::size_t>(loaded.faces.FindIndex(face) - 1)]];
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
void sew_sheets(const OcctShape& loaded, const Places& places, Part& part) {
  const SewnFaces sewn = sew_loose_faces(loaded.faces, part.box.diagonal());
  part.solids = sewn.solids;
  for (std::size_t k = 0; k < places.size(); ++k) {
    Face& face = part.faces[places[k]];
    face.solid = sewn.solid[k];
    face.of_solid = sewn.solid[k] >= 0;
    face.reversed = sewn.reversed[k];
  }
  // A face that is all there is, is a sheet on purpose.
  if (part.faces.size() > 1) part.repairs.insert(part.repairs.end(), sewn.notes.begin(), sewn.notes.end());
}

/// Says where the border of a face is not on its surface, or has ends elsewhere.
void note_border_gap(const TopoDS_Face& face, const std::string& name, Part& part) {
  if (const double gap = border_gap(face); gap > 0.0)
    part.repairs.push_back(
        fmt::format("{}: the parts of its border are up to {:.2g} mm apart, or that far off its surface; check it "
                    "before using the result",
                    name, gap));
  if (const double factor = border_stray_weight(face); factor > 0.0)
    part.repairs.push_back(
        fmt::format("{}: a weight of a border curve differs from its neighbours by a factor of {:.3g}; check it before "
                    "using the result",
                    name, factor));
}

/// Says where edges of a face have no curve on its surface.
void note_lost_curves(int lost, const std::string& name, Part& part) {
  if (lost > 0)
    part.repairs.push_back(fmt::format(
        "{}: {} of its border {} no curve on its surface that can be read; check it before using the result", name,
        lost == 1 ? "1 edge" : fmt::format("{} edges", lost), lost == 1 ? "has" : "have"));
}

/// Says of which solids borders are free: a face is missing there, or does not meet its neighbours.
void note_open_solids(const OcctShape& loaded, Part& part) {
  TopTools_IndexedMapOfShape solids;
  TopExp::MapShapes(loaded.shape, TopAbs_SOLID, solids);
  for (int k = 1; k <= solids.Extent(); ++k) {
    TopTools_IndexedDataMapOfShapeListOfShape owners;
    TopExp::MapShapesAndAncestors(solids(k), TopAbs_EDGE, TopAbs_FACE, owners);
    int free = 0;
    for (int i = 1; i <= owners.Extent(); ++i)
      free += owners(i).Extent() == 1 && !BRep_Tool::Degenerated(TopoDS::Edge(owners.FindKey(i)));
    if (free > 0)
      part.repairs.push_back(fmt::format(
          "solid {} is not closed: {} edges belong to one face only, so its inside is not known there", k, free));
  }
}

/// Adds a face of which nothing is known but its number.
void leave_out(Part& part, Face face, std::string type, std::string why) {
  part.left_out[static_cast<int>(part.faces.size())] = std::move(why);
  part.faces.push_back(std::move(face));
  part.surface_types.push_back(std::move(type));
}

Face next_face(const Part& part) {
  Face face;
  face.id = fmt::format("F{}", part.faces.size() + 1);
  return face;
}

/// Converts a face, or leaves it out with the reason: one face that nobody asked for must not lose the part. `spoilt`: why the
/// kernel's face is not that of the file; empty where it is.
void add_face(const TopoDS_Face& face, const std::string& spoilt, Part& part) {
  Face whole = next_face(part);
  const std::string name = part.file + ", face " + whole.id;
  OcctFace converted;
  converted.type = "unknown";
  std::string why;
  const int lost = border_without_curves(face);  // what is converted has such curves
  try {
    converted = convert_occt_face(face, name);
    if (!spoilt.empty()) why = fmt::format("{}: some of its data could not be read ({})", name, spoilt);
  } catch (const InputError& error) {
    why = error.what();
  } catch (const Standard_Failure& failure) {
    why = fmt::format("{}: its geometry cannot be used ({})", name, failure.GetMessageString());
  }
  if (!why.empty()) return leave_out(part, std::move(whole), std::move(converted.type), std::move(why));
  part.repairs.insert(part.repairs.end(), converted.notes.begin(), converted.notes.end());
  add_extent(face, converted.type, part.box);
  note_border_gap(face, name, part);
  note_lost_curves(lost, name, part);
  converted.face.id = std::move(whole.id);
  part.faces.push_back(std::move(converted.face));
  part.surface_types.push_back(std::move(converted.type));
}

/// All faces of the file in its order: those behind one that could not be read keep their numbers.
Places add_faces(const OcctShape& loaded, Part& part) {
  Places places;
  auto unread = loaded.left.unread.begin();
  for (int i = 1; i <= loaded.faces.Extent() + 1; ++i) {
    for (; unread != loaded.left.unread.end() && (unread->before <= i || i > loaded.faces.Extent()); ++unread) {
      Face face = next_face(part);
      std::string why = fmt::format("{}, face {} ({} in the file): the CAD kernel cannot read it ({})", part.file,
                                    face.id, unread->entity, unread->why);
      leave_out(part, std::move(face), "unknown", std::move(why));
    }
    if (i > loaded.faces.Extent()) break;
    const auto spoilt = loaded.left.spoilt.find(i);
    places.push_back(part.faces.size());
    add_face(TopoDS::Face(loaded.faces(i)), spoilt == loaded.left.spoilt.end() ? "" : spoilt->second, part);
  }
  return places;
}

/// A face that could not be read is of the solid of its neighbours in the file.
void assign_unread(const OcctShape& loaded, const Places& places, Part& part) {
  std::size_t k = 0;
  for (const UnreadFace& unread : loaded.left.unread) {
    while (std::binary_search(places.begin(), places.end(), k)) ++k;
    if (unread.beside > 0) {
      const Face& beside = part.faces[places[static_cast<std::size_t>(unread.beside - 1)]];
      part.faces[k].solid = beside.solid, part.faces[k].of_solid = beside.of_solid;
    }
    ++k;
  }
}

/// Notes for what is left out; a part of which nothing is left is refused.
void refuse_unreadable(Part& part) {
  if (part.left_out.size() == part.faces.size()) throw InputError(part.left_out.begin()->second);
  for (const auto& [face, why] : part.left_out)
    part.repairs.push_back(why + "; the face is not read, so gouges of it cannot be detected");
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
  try {
    BRepTools::Clean(loaded.shape);  // triangles that the file brings may be those of another shape
    const BRepMesh_IncrementalMesh meshed(loaded.shape, kRelativeDeflection, true, kAngularDeflection, false);
    const Places places = add_faces(loaded, part);
    refuse_unreadable(part);
    assign_solids(loaded, places, part);
    note_open_solids(loaded, part);
    if (part.solids == 0) sew_sheets(loaded, places, part);
    assign_unread(loaded, places, part);
  } catch (const Standard_Failure& failure) {
    throw InputError(file + ": its geometry cannot be used (" + failure.GetMessageString() + "); export it again");
  }
  return part;
}

}  // namespace flank::internal
