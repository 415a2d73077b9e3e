#include "flank/io/kernel/occt_complaints.h"

#include <fmt/format.h>

#include <BRep_Tool.hxx>
#include <Interface_Check.hxx>
#include <Interface_EntityIterator.hxx>
#include <Interface_Graph.hxx>
#include <Interface_InterfaceModel.hxx>
#include <StepGeom_BSplineCurveWithKnots.hxx>
#include <StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve.hxx>
#include <StepGeom_BSplineSurfaceWithKnots.hxx>
#include <StepGeom_BSplineSurfaceWithKnotsAndRationalBSplineSurface.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_Direction.hxx>
#include <StepGeom_Pcurve.hxx>
#include <StepGeom_SurfaceCurve.hxx>
#include <StepShape_EdgeCurve.hxx>
#include <StepShape_EdgeLoop.hxx>
#include <StepShape_FaceSurface.hxx>
#include <StepShape_OrientedEdge.hxx>
#include <StepShape_VertexPoint.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TransferBRep.hxx>
#include <Transfer_Binder.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <algorithm>
#include <array>
#include <gp_XYZ.hxx>
#include <string_view>
#include <utility>
#include <vector>

namespace flank::internal {
namespace {

using Entity = Handle(Standard_Transient);

constexpr double kTornShare = 1e-3;  ///< of the size of a border: edges that are farther apart do not meet

struct Complaint {
  Entity about;
  std::string text;
};

/// The first failure of a check that is about shapes; empty if there is none. A name that is none shapes nothing.
std::string failure_of(const Handle(Interface_Check) & check) {
  for (int i = 1; !check.IsNull() && i <= check->NbFails(); ++i) {
    std::string text = check->CFail(i, true);
    if (text.find("not a quoted String") != std::string::npos) continue;
    text.erase(0, text.find_first_not_of(' '));
    return text;
  }
  return {};
}

/// An edge that is neither a curve nor another edge turned round is dropped from its border with a warning.
std::string dropped_edge(const Entity& entity) {
  const auto turned = Handle(StepShape_OrientedEdge)::DownCast(entity);
  if (turned.IsNull()) return {};
  const Handle(StepShape_Edge) edge = turned->EdgeElement();
  const bool known = !edge.IsNull() && (edge->IsKind(STANDARD_TYPE(StepShape_EdgeCurve)) ||
                                        edge->IsKind(STANDARD_TYPE(StepShape_OrientedEdge)));
  return known ? "" : "its edge has no curve";
}

/// What is flat has a meaning in the parameters of a surface alone. Where a point in space is asked for the kernel adds a zero.
std::string lacks_coordinates(const Entity& entity) {
  const auto point = Handle(StepGeom_CartesianPoint)::DownCast(entity);
  const auto direction = Handle(StepGeom_Direction)::DownCast(entity);
  if (!direction.IsNull() && direction->DirectionRatios().IsNull()) return "it has no coordinates";
  const int count = !point.IsNull() ? point->NbCoordinates() : !direction.IsNull() ? direction->NbDirectionRatios() : 3;
  return count < 3 ? fmt::format("it has {} of three coordinates", count) : "";
}

gp_XYZ place_of(const Handle(StepShape_Vertex) & vertex) {
  const auto at = Handle(StepShape_VertexPoint)::DownCast(vertex);
  const auto point =
      at.IsNull() ? Handle(StepGeom_CartesianPoint)() : Handle(StepGeom_CartesianPoint)::DownCast(at->VertexGeometry());
  gp_XYZ place(0.0, 0.0, 0.0);
  for (int i = 1; !point.IsNull() && i <= std::min(3, point->NbCoordinates()); ++i)
    place.SetCoord(i, point->CoordinatesValue(i));
  return place;
}

/// The two ends of each edge of a border; empty if one of them has none.
std::vector<std::array<Handle(StepShape_Vertex), 2>> ends_of(const Handle(StepShape_EdgeLoop) & loop) {
  std::vector<std::array<Handle(StepShape_Vertex), 2>> ends;
  for (int i = 1; i <= loop->NbEdgeList(); ++i) {
    Handle(StepShape_Edge) edge = loop->EdgeListValue(i);
    for (auto turned = Handle(StepShape_OrientedEdge)::DownCast(edge); !turned.IsNull();
         turned = Handle(StepShape_OrientedEdge)::DownCast(edge))
      edge = turned->EdgeElement();
    if (edge.IsNull() || edge->EdgeStart().IsNull() || edge->EdgeEnd().IsNull()) return {};
    ends.push_back({edge->EdgeStart(), edge->EdgeEnd()});
  }
  return ends;
}

/// A border whose edges do not follow one another: the kernel goes straight across what is between them. Which way each edge
/// runs is not asked: the kernel mends that.
std::string torn(const Entity& entity) {
  const auto loop = Handle(StepShape_EdgeLoop)::DownCast(entity);
  if (loop.IsNull()) return {};
  const auto ends = ends_of(loop);
  double size = 0.0;
  for (const auto& edge : ends)
    for (const auto& vertex : edge) size = std::max(size, (place_of(vertex) - place_of(ends.front()[0])).Modulus());
  const auto meet = [&](const auto& a, const auto& b) {
    return a == b || (place_of(a) - place_of(b)).Modulus() <= kTornShare * size;
  };
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const auto &a = ends[k], &b = ends[(k + 1) % ends.size()];
    if (!meet(a[0], b[0]) && !meet(a[0], b[1]) && !meet(a[1], b[0]) && !meet(a[1], b[1]))
      return fmt::format("edges {} and {} of this border do not meet", k + 1, (k + 1) % ends.size() + 1);
  }
  return {};
}

/// Knots that fall: the kernel sorts some, and makes of others no curve or another one, without a word.
std::string falling_knots(const Entity& entity) {
  const auto falls = [](const Handle(TColStd_HArray1OfReal) & knots) {
    return !knots.IsNull() && !std::is_sorted(knots->begin(), knots->end());
  };
  auto curve = Handle(StepGeom_BSplineCurveWithKnots)::DownCast(entity);
  auto surface = Handle(StepGeom_BSplineSurfaceWithKnots)::DownCast(entity);
  if (const auto both = Handle(StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve)::DownCast(entity); !both.IsNull())
    curve = both->BSplineCurveWithKnots();
  if (const auto both = Handle(StepGeom_BSplineSurfaceWithKnotsAndRationalBSplineSurface)::DownCast(entity);
      !both.IsNull())
    surface = both->BSplineSurfaceWithKnots();
  const bool fall = (!curve.IsNull() && falls(curve->Knots())) ||
                    (!surface.IsNull() && (falls(surface->UKnots()) || falls(surface->VKnots())));
  return fall ? "its knots do not rise" : "";
}

/// An edge that a border runs along twice the same way. Both ways is a seam.
std::string repeated_edge(const Entity& entity) {
  const auto loop = Handle(StepShape_EdgeLoop)::DownCast(entity);
  std::set<std::pair<const Standard_Transient*, bool>> seen;
  for (int i = 1; !loop.IsNull() && i <= loop->NbEdgeList(); ++i) {
    const auto edge = loop->EdgeListValue(i);
    if (edge.IsNull() || edge->EdgeElement().IsNull()) continue;
    if (!seen.emplace(edge->EdgeElement().get(), edge->Orientation()).second)
      return fmt::format("edge {} of this border occurs twice", i);
  }
  return {};
}

/// A border that a face names twice.
std::string repeated_border(const Entity& entity) {
  const auto face = Handle(StepShape_FaceSurface)::DownCast(entity);
  std::set<const Standard_Transient*> seen;
  for (int i = 1; !face.IsNull() && i <= face->NbBounds(); ++i)
    if (const auto border = face->BoundsValue(i); !border.IsNull() && !seen.insert(border.get()).second)
      return fmt::format("border {} occurs twice", i);
  return {};
}

/// Edges of a face that the file states together with their curves in the parameters of its surface; 0 if one comes without.
int stated_edges(const Handle(StepShape_FaceSurface) & face) {
  int count = 0;
  for (int i = 1; i <= face->NbBounds(); ++i) {
    const auto border = face->BoundsValue(i);
    const auto loop = Handle(StepShape_EdgeLoop)::DownCast(border.IsNull() ? nullptr : border->Bound());
    for (int k = 1; !loop.IsNull() && k <= loop->NbEdgeList(); ++k, ++count) {
      const auto turned = loop->EdgeListValue(k);
      const auto edge =
          Handle(StepShape_EdgeCurve)::DownCast(turned.IsNull() ? Handle(StepShape_Edge)() : turned->EdgeElement());
      if (edge.IsNull() || edge->EdgeGeometry().IsNull()) return 0;
      if (!edge->EdgeGeometry()->IsKind(STANDARD_TYPE(StepGeom_SurfaceCurve))) return 0;
    }
  }
  return count;
}

/// A border that states its curves in the parameters of the surface, and that the kernel had to lead along a seam to close it there.
/// Writers that state such curves state the seam, too: an edge runs the other way round its circle.
std::string closed_by_seam(const Entity& entity, const Handle(Transfer_TransientProcess) & process) {
  const auto face = Handle(StepShape_FaceSurface)::DownCast(entity);
  const int stated = face.IsNull() ? 0 : stated_edges(face);
  if (stated == 0) return {};
  int edges = 0, seams = 0;
  for (TopExp_Explorer faces(TransferBRep::ShapeResult(process, entity), TopAbs_FACE); faces.More(); faces.Next())
    for (TopExp_Explorer it(faces.Current(), TopAbs_EDGE); it.More(); it.Next()) {
      const TopoDS_Edge& edge = TopoDS::Edge(it.Current());
      if (BRep_Tool::Degenerated(edge)) continue;
      ++edges;
      seams += BRep_Tool::IsClosed(edge, TopoDS::Face(faces.Current()));
    }
  return seams > 0 && edges > stated ? "its border does not close in the parameters of its surface" : "";
}

/// Of all entities, in the order of the file.
std::vector<Complaint> complaints_of(const Handle(XSControl_WorkSession) & session) {
  const Handle(Interface_InterfaceModel) model = session->Model();
  const Handle(Transfer_TransientProcess) process = session->TransferReader()->TransientProcess();
  std::vector<Complaint> all;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Entity entity = model->Value(i);
    std::string text = failure_of(model->Check(i, true));
    if (text.empty())
      if (const Handle(Transfer_Binder) made = process->Find(entity); !made.IsNull()) text = failure_of(made->Check());
    for (const auto& look : {dropped_edge, lacks_coordinates, falling_knots, torn, repeated_edge, repeated_border})
      if (text.empty()) text = look(entity);
    if (text.empty()) text = closed_by_seam(entity, process);
    if (!text.empty()) all.push_back({entity, std::move(text)});
  }
  return all;
}

}  // namespace

std::map<const Standard_Transient*, std::string> complaints_of_faces(const Handle(XSControl_WorkSession) & session,
                                                                     const std::set<const Standard_Transient*>& faces) {
  std::map<const Standard_Transient*, std::string> found;
  const Interface_Graph& graph = session->Graph();
  for (const Complaint& complaint : complaints_of(session)) {
    const std::string text =
        fmt::format("{}: {}", session->Model()->StringLabel(complaint.about)->ToCString(), complaint.text);
    // Up to the faces that use it, and no farther.
    std::vector<Entity> ways{complaint.about};
    std::set<const Standard_Transient*> seen{complaint.about.get()};
    while (!ways.empty()) {
      const Entity entity = ways.back();
      ways.pop_back();
      if (faces.count(entity.get()) > 0) {
        found.emplace(entity.get(), text);
        continue;
      }
      for (Interface_EntityIterator users = graph.Sharings(entity); users.More(); users.Next())
        // A curve in the parameters of a surface names the surface, and stands in the borders of both its faces. Both have the curve
        // in space, too, which counts.
        if (!users.Value()->IsKind(STANDARD_TYPE(StepGeom_Pcurve)) && seen.insert(users.Value().get()).second)
          ways.push_back(users.Value());
    }
  }
  return found;
}

}  // namespace flank::internal
