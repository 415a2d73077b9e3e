#include "flank/io/cad/write_solid.h"

#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_Surface.hxx>
#include <Standard_Failure.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Vertex.hxx>
#include <cmath>

#include "flank/error.h"
#include "flank/io/cad/read_occt_face.h"
#include "flank/io/cad/write_occt_face.h"
#include "flank/io/cad/write_occt_products.h"
#include "flank/io/kernel/read_occt_silence.h"

namespace flank::internal {
namespace {

constexpr double kSamePointMm = 1e-7;  ///< Open CASCADE's own confusion

/// mm^3; negative if the faces look inwards.
double volume_of(const TopoDS_Shape& shape) {
  GProp_GProps volume;
  BRepGProp::VolumeProperties(shape, volume);
  return volume.Mass();
}

/// Whether two faces lie on one and the same surface, at the same place.
bool on_same_surface(const TopoDS_Face& a, const TopoDS_Face& b) {
  TopLoc_Location place_a, place_b;
  const Handle(Geom_Surface)& surface_a = BRep_Tool::Surface(a, place_a);
  const Handle(Geom_Surface)& surface_b = BRep_Tool::Surface(b, place_b);
  return surface_a == surface_b && place_a == place_b;
}

/// The solid that consists of the faces of `shape`, in the order of the faces of `order` that lie on the same surfaces.
/// Neither sewing nor Booleans keep an order that means anything; both keep the surfaces.
TopoDS_Solid solid_in_order(const TopoDS_Shape& shape, const std::vector<TopoDS_Face>& order, const std::string& name) {
  const BRep_Builder builder;
  TopoDS_Shell shell;
  builder.MakeShell(shell);
  std::size_t found = 0, all = 0;
  for (TopExp_Explorer it(shape, TopAbs_FACE); it.More(); it.Next()) ++all;
  for (const TopoDS_Face& wanted : order) {
    for (TopExp_Explorer it(shape, TopAbs_FACE); it.More(); it.Next()) {
      if (!on_same_surface(TopoDS::Face(it.Current()), wanted)) continue;
      builder.Add(shell, it.Current());
      ++found;
    }
  }
  if (found != order.size() || found != all)
    throw InternalError(name + ": a solid of " + std::to_string(order.size()) + " faces was built with " +
                        std::to_string(all) + ", " + std::to_string(found) + " of them the intended ones");
  shell.Closed(BRep_Tool::IsClosed(shell));
  TopoDS_Solid solid;
  builder.MakeSolid(solid);
  builder.Add(solid, shell);
  if (!shell.Closed() || !BRepCheck_Analyzer(solid).IsValid() || volume_of(solid) <= 0.0)
    throw InternalError(name + ": the faces do not form a valid solid");
  return solid;
}

/// Reads the faces back from the solid, so that they have the trims and sides that a reader of the file finds.
SolidModel model_of(const std::string& name, const TopoDS_Solid& solid) {
  SolidModel model;
  for (TopExp_Explorer it(solid, TopAbs_FACE); it.More(); it.Next()) {
    const std::string id = "F" + std::to_string(model.faces.size() + 1);
    Face& face = model.faces.emplace_back(convert_occt_face(TopoDS::Face(it.Current()), name + ", face " + id).face);
    face.id = id;
    face.of_solid = true;
    face.solid = 0;
  }
  model.step = step_text(name, {{name, solid}});
  return model;
}

/// The faces as the kernel has them, in the same order.
std::vector<TopoDS_Face> occt_faces(const std::vector<Face>& faces) {
  std::vector<TopoDS_Face> all;
  for (const Face& face : faces) all.push_back(occt_face(face));
  return all;
}

/// One solid of faces whose borders coincide within kSewingMm.
TopoDS_Solid sewn(const std::string& name, const std::vector<TopoDS_Face>& faces) {
  BRepBuilderAPI_Sewing sewing(kSewingMm);
  for (const TopoDS_Face& face : faces) sewing.Add(face);
  sewing.Perform();
  if (sewing.NbFreeEdges() > 0)
    throw InternalError(name + ": the faces leave " + std::to_string(sewing.NbFreeEdges()) + " borders open");
  return solid_in_order(sewing.SewedShape(), faces, name);
}

/// The sector of a hub, and its faces by name for the order of the result.
struct Hub {
  TopoDS_Shape solid;
  TopoDS_Face skin, front, from, to, back, bore;
};

/// The kernel names no faces of a section that is turned all round, so each of its edges is turned by itself.
Hub hub_ring(const std::string& name, const std::vector<TopoDS_Edge>& section, const gp_Ax1& axis) {
  std::vector<TopoDS_Face> faces;
  BRepBuilderAPI_Sewing sewing(kSewingMm);
  for (const TopoDS_Edge& edge : section) {
    faces.push_back(TopoDS::Face(BRepPrimAPI_MakeRevol(edge, axis).Shape()));
    sewing.Add(faces.back());
  }
  sewing.Perform();
  const TopExp_Explorer shell(sewing.SewedShape(), TopAbs_SHELL);
  if (!shell.More()) throw InternalError(name + ": the faces of the hub cannot be joined");
  const BRep_Builder builder;
  TopoDS_Solid solid;
  builder.MakeSolid(solid);
  builder.Add(solid, shell.Current());
  return {
      volume_of(solid) < 0.0 ? solid.Reversed() : TopoDS_Shape(solid), faces[0], faces[3], {}, {}, faces[1], faces[2]};
}

/// The section of the hub at the first angle, turned about X to the second.
Hub hub_solid(const std::string& name, const HubSector& hub) {
  const auto at = [&](double x, double radius) {
    return gp_Pnt(x, radius * std::cos(hub.from_rad), radius * std::sin(hub.from_rad));
  };
  const Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, static_cast<int>(hub.profile.size()));
  for (int i = 1; i <= points->Length(); ++i) {
    const Vec2& p = hub.profile[static_cast<std::size_t>(i - 1)];
    points->SetValue(i, at(p.x(), p.y()));
  }
  GeomAPI_Interpolate outline(points, Standard_False, kSamePointMm);
  outline.Perform();
  if (!outline.IsDone()) throw InternalError("no curve could be interpolated through the outline of the hub");
  const TopoDS_Vertex front_out = BRepBuilderAPI_MakeVertex(points->First()),
                      back_out = BRepBuilderAPI_MakeVertex(points->Last()),
                      front_in = BRepBuilderAPI_MakeVertex(at(points->First().X(), hub.bore_radius_mm)),
                      back_in = BRepBuilderAPI_MakeVertex(at(points->Last().X(), hub.bore_radius_mm));
  const TopoDS_Edge skin = BRepBuilderAPI_MakeEdge(outline.Curve(), front_out, back_out),
                    back = BRepBuilderAPI_MakeEdge(back_out, back_in),
                    bore = BRepBuilderAPI_MakeEdge(back_in, front_in),
                    front = BRepBuilderAPI_MakeEdge(front_in, front_out);
  const gp_Ax1 axis(gp_Pnt(0.0, 0.0, 0.0), gp_Dir(1.0, 0.0, 0.0));
  if (hub.is_whole()) return hub_ring(name, {skin, back, bore, front}, axis);
  const TopoDS_Wire wire = BRepBuilderAPI_MakeWire(skin, back, bore, front);
  BRepPrimAPI_MakeRevol turned(BRepBuilderAPI_MakeFace(wire, Standard_True), axis, hub.turn_rad());
  const auto swept = [&](const TopoDS_Edge& edge) { return TopoDS::Face(turned.Generated(edge).First()); };
  const TopoDS_Shape solid = turned.Shape();
  return {volume_of(solid) < 0.0 ? solid.Reversed() : solid,
          swept(skin),
          swept(front),
          TopoDS::Face(turned.FirstShape()),
          TopoDS::Face(turned.LastShape()),
          swept(back),
          swept(bore)};
}

/// Hub and blades as one solid. A blade's sixth face is its tip; its fifth, the lid inside the hub, disappears.
TopoDS_Solid fused(const std::string& name, const Hub& hub, const std::vector<std::vector<TopoDS_Face>>& blades) {
  TopTools_ListOfShape arguments, tools;
  arguments.Append(hub.solid);
  std::vector<TopoDS_Face> order{hub.skin, hub.front}, tips;
  if (!hub.from.IsNull()) order.insert(order.end(), {hub.from, hub.to});
  order.push_back(hub.back);
  for (const std::vector<TopoDS_Face>& blade : blades) {
    tools.Append(sewn(name, blade));
    for (const std::size_t k : {1u, 2u, 3u, 0u}) order.push_back(blade[k]);
    tips.push_back(blade[5]);
  }
  order.push_back(hub.bore);
  order.insert(order.end(), tips.begin(), tips.end());
  BRepAlgoAPI_Fuse fuse;
  fuse.SetArguments(arguments);
  fuse.SetTools(tools);
  fuse.Build();
  if (!fuse.IsDone()) throw InternalError(name + ": hub and blades cannot be joined");
  return solid_in_order(fuse.Shape(), order, name);
}

}  // namespace

SolidModel sew_solid(const std::string& name, const std::vector<Face>& faces) {
  const OcctSilence silence;
  try {
    return model_of(name, sewn(name, occt_faces(faces)));
  } catch (const Standard_Failure& failure) {
    throw InternalError(name + ": the solid cannot be made (" + failure.GetMessageString() + ")");
  }
}

SolidModel fuse_blisk(const std::string& name, const HubSector& hub, const std::vector<std::vector<Face>>& blades) {
  const OcctSilence silence;
  try {
    std::vector<std::vector<TopoDS_Face>> made;
    for (const std::vector<Face>& blade : blades) made.push_back(occt_faces(blade));
    return model_of(name, fused(name, hub_solid(name, hub), made));
  } catch (const Standard_Failure& failure) {
    throw InternalError(name + ": the solid cannot be made (" + failure.GetMessageString() + ")");
  }
}

}  // namespace flank::internal
