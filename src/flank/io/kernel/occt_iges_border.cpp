#include "flank/io/kernel/occt_iges_border.h"

#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <IGESGeom_CurveOnSurface.hxx>
#include <IGESGeom_TrimmedSurface.hxx>
#include <IGESToBRep_CurveAndSurface.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <Transfer_TransientProcess.hxx>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "flank/io/kernel/occt_space_curve.h"

namespace flank::internal {
namespace {

/// As a border and its surface (read_occt_border.cpp), mm and share of its size.
constexpr double kGapMm = 0.05, kGapShare = 1e-3;

/// The curves of the edges of a shape in space.
std::vector<SpaceCurve> edges_of(const TopoDS_Shape& shape) {
  std::vector<SpaceCurve> curves;
  for (TopExp_Explorer it(shape, TopAbs_EDGE); it.More(); it.Next()) {
    double first = 0.0, last = 0.0;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(it.Current()), first, last);
    if (!curve.IsNull() && !Precision::IsInfinite(first) && !Precision::IsInfinite(last))
      curves.emplace_back(curve, first, last);
  }
  return curves;
}

/// The borders of a trimmed surface.
std::vector<Handle(IGESGeom_CurveOnSurface)> borders_of(const Handle(IGESGeom_TrimmedSurface) & trimmed) {
  std::vector<Handle(IGESGeom_CurveOnSurface)> borders;
  if (trimmed->HasOuterContour()) borders.push_back(trimmed->OuterContour());
  for (int i = 1; i <= trimmed->NbInnerContours(); ++i) borders.push_back(trimmed->InnerContour(i));
  return borders;
}

/// What the kernel makes of a curve in space, with nothing of its surface.
TopoDS_Shape in_space(const Handle(IGESData_IGESModel) & model, const Handle(IGESData_IGESEntity) & curve) {
  constexpr double kEps = 1e-4, kCoefficients = 1e-6;  // as the kernel's reader has them
  IGESToBRep_CurveAndSurface transfer(kEps, kEps, kCoefficients, true, false, false);
  transfer.SetModel(model);
  transfer.SetTransferProcess(new Transfer_TransientProcess);
  return transfer.TransferGeometry(curve);
}

/// The largest distance of the points of `from` from the nearest of `to`; what is no more than `most` does not count.
double largest_gap(const std::vector<SpaceCurve>& from, const std::vector<SpaceCurve>& to, double most) {
  double gap = 0.0;
  for (const SpaceCurve& curve : from)
    for (const gp_Pnt& p : curve.points()) {
      double least = 1e300;
      for (const SpaceCurve& other : to)
        if (least > most) least = std::min(least, other.distance(p, most));
      gap = std::max(gap, least);
    }
  return gap > most ? gap : 0.0;
}

double length_of(const std::vector<SpaceCurve>& curves) {
  double length = 0.0;
  for (const SpaceCurve& curve : curves) length += curve.length();
  return length;
}

/// A curve that runs there and back on itself is nowhere off the other one, and longer: by how much. Paces differ, lengths hardly.
double excess_length(const std::vector<SpaceCurve>& a, const std::vector<SpaceCurve>& b, double most) {
  constexpr double kShare = 0.02, kGaps = 10.0;
  const double length = length_of(a), other = length_of(b), excess = std::abs(length - other);
  return excess > std::max(kGaps * most, kShare * std::max(length, other)) ? excess : 0.0;
}

}  // namespace

double iges_border_gap(const Handle(IGESData_IGESModel) & model, const Handle(IGESData_IGESEntity) & entity,
                       const TopoDS_Shape& made) {
  const auto trimmed = Handle(IGESGeom_TrimmedSurface)::DownCast(entity);
  if (trimmed.IsNull() || trimmed->HasTransf()) return 0.0;
  const std::vector<SpaceCurve> edges = edges_of(made);
  Bnd_Box box;
  for (const SpaceCurve& edge : edges)
    for (const gp_Pnt& p : edge.points()) box.Add(p);
  if (box.IsVoid()) return 0.0;
  const double most = std::max(kGapMm, kGapShare * std::sqrt(box.SquareExtent()));
  std::vector<SpaceCurve> stated;
  bool all = true;
  for (const Handle(IGESGeom_CurveOnSurface) & border : borders_of(trimmed)) {
    const bool known = !border.IsNull() && !border->HasTransf() && !border->Curve3D().IsNull();
    all = all && known;
    if (!known) continue;
    for (SpaceCurve& curve : edges_of(in_space(model, border->Curve3D()))) stated.push_back(std::move(curve));
  }
  if (stated.empty()) return 0.0;
  // Both ways: a bulge may be narrower than the other curve's points are apart. An edge of a border that states no curve has none.
  const double gap = largest_gap(stated, edges, most);
  return all ? std::max({gap, largest_gap(edges, stated, most), excess_length(stated, edges, most)}) : gap;
}

}  // namespace flank::internal
