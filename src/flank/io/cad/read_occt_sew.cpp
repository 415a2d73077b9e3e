#include "flank/io/cad/read_occt_sew.h"

#include <fmt/format.h>

#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <ShapeFix_Shell.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <algorithm>
#include <map>

namespace flank::internal {
namespace {

constexpr double kFirstShare = 1e-6;  ///< sewing tolerances are tried from this share of the size on, times ten each

struct Sewn {
  TopoDS_Shape shape;
  std::vector<TopoDS_Shape> faces;  ///< what has become of each face
  int free_edges = 0;
  double gap_mm = 0.0;
};

Sewn sew(const TopTools_IndexedMapOfShape& faces, double tolerance_mm) {
  BRepBuilderAPI_Sewing sewing(tolerance_mm);
  for (int i = 1; i <= faces.Extent(); ++i) sewing.Add(faces(i).Oriented(TopAbs_FORWARD));
  sewing.Perform();
  Sewn result{sewing.SewedShape(), {}, sewing.NbFreeEdges(), tolerance_mm};
  for (int i = 1; i <= faces.Extent(); ++i)
    result.faces.push_back(sewing.ModifiedSubShape(faces(i).Oriented(TopAbs_FORWARD)));
  return result;
}

/// With the least gap beyond which nothing more closes. A gap as wide as a face would swallow it, so that one that loses
/// faces is too wide.
Sewn sew_by_steps(const TopTools_IndexedMapOfShape& faces, double size_mm) {
  Sewn best = sew(faces, kFirstShare * size_mm);
  for (double share = 10.0 * kFirstShare; best.free_edges > 0 && share < 1.5 * kSewingShare; share *= 10.0) {
    Sewn next = sew(faces, share * size_mm);
    TopTools_IndexedMapOfShape left;
    TopExp::MapShapes(next.shape, TopAbs_FACE, left);
    if (left.Extent() < faces.Extent()) break;
    if (next.free_edges < best.free_edges) best = std::move(next);
  }
  return best;
}

/// Every edge of the shell lies between two of its faces.
bool is_closed(const TopoDS_Shell& shell) {
  TopTools_IndexedDataMapOfShapeListOfShape owners;
  TopExp::MapShapesAndAncestors(shell, TopAbs_EDGE, TopAbs_FACE, owners);
  int real = 0;
  for (int i = 1; i <= owners.Extent(); ++i) {
    if (BRep_Tool::Degenerated(TopoDS::Edge(owners.FindKey(i)))) continue;
    ++real;
    // The seam of a closed surface is twice in the list of one face.
    if (owners(i).Extent() != 2) return false;
  }
  return real > 0;
}

/// The shells of the sewn shape, with faces that agree with their neighbours, and faces that were sewn to nothing.
std::vector<TopoDS_Shell> consistent_shells(const TopoDS_Shape& sewn) {
  std::vector<TopoDS_Shell> shells;
  for (TopExp_Explorer it(sewn, TopAbs_SHELL); it.More(); it.Next()) {
    ShapeFix_Shell fix(TopoDS::Shell(it.Current()));
    fix.FixFaceOrientation(TopoDS::Shell(it.Current()));
    for (TopExp_Explorer part(fix.Shape(), TopAbs_SHELL); part.More(); part.Next())
      shells.push_back(TopoDS::Shell(part.Current()));
  }
  for (TopExp_Explorer it(sewn, TopAbs_FACE, TopAbs_SHELL); it.More(); it.Next()) {
    TopoDS_Shell shell;
    BRep_Builder().MakeShell(shell);
    BRep_Builder().Add(shell, it.Current());
    shells.push_back(shell);
  }
  return shells;
}

class Sides {
 public:
  explicit Sides(const TopTools_IndexedMapOfShape& faces) {
    for (int i = 1; i <= faces.Extent(); ++i) {
      result_.solid.push_back(-1);
      result_.reversed.push_back(faces(i).Orientation() == TopAbs_REVERSED);
    }
  }

  void take(const Sewn& sewn, const std::vector<TopoDS_Shell>& shells) {
    for (std::size_t k = 0; k < sewn.faces.size(); ++k)
      if (!sewn.faces[k].IsNull()) numbers_.Bind(sewn.faces[k], static_cast<int>(k));
    for (const TopoDS_Shell& shell : shells) {
      TopoDS_Shape sides = shell;
      bool closed = is_closed(shell);
      if (closed) {
        TopoDS_Solid solid;
        BRep_Builder().MakeSolid(solid);
        BRep_Builder().Add(solid, shell);
        closed = BRepLib::OrientClosedSolid(solid);
        if (closed) sides = solid;
      }
      take_faces(sides, closed ? result_.solids++ : -1);
    }
  }

  [[nodiscard]] SewnFaces& result() { return result_; }

 private:
  void take_faces(const TopoDS_Shape& sides, int solid) {
    std::map<std::size_t, bool> found;
    for (TopExp_Explorer it(sides, TopAbs_FACE); it.More(); it.Next())
      if (const int* k = numbers_.Seek(it.Current()))
        found[static_cast<std::size_t>(*k)] = it.Current().Orientation() == TopAbs_REVERSED;
    std::size_t turned = 0;
    for (const auto& [k, reversed] : found) turned += reversed != result_.reversed[k];
    // Of an open shell nothing says which side is out: most of its faces stay as they stand, or the first.
    const bool tie = 2 * turned == found.size() && !found.empty() && found.begin()->second != result_.reversed[found.begin()->first];
    const bool flip = solid < 0 && (2 * turned > found.size() || tie);
    for (const auto& [k, reversed] : found) {
      result_.reversed[k] = reversed != flip;
      result_.solid[k] = solid;
    }
  }

  SewnFaces result_;
  TopTools_DataMapOfShapeInteger numbers_;  ///< of the sewn faces, whichever way they are oriented
};

std::string account(const SewnFaces& sides, const Sewn& sewn, std::size_t open) {
  const std::string gap = fmt::format("over gaps of up to {:.2g} mm", sewn.gap_mm);
  if (sides.solids > 0 && open == 0)
    return fmt::format("the file has loose faces: they were sewn to {} solid{}, {}", sides.solids,
                       sides.solids == 1 ? "" : "s", gap);
  if (sides.solids > 0)
    return fmt::format("the file has loose faces: they were sewn to {} solid{} and {} open sheet{}, {}", sides.solids,
                       sides.solids == 1 ? "" : "s", open, open == 1 ? "" : "s", gap);
  return fmt::format(
      "the file has loose faces, which do not close: {} open sheet{} when sewn, {}, {} borders free; on which side the material is, is not known",
      open, open == 1 ? "" : "s", gap, sewn.free_edges);
}

}  // namespace

SewnFaces sew_loose_faces(const TopTools_IndexedMapOfShape& faces, double size_mm) {
  Sides sides(faces);
  SewnFaces& result = sides.result();
  if (faces.Extent() > kMostSewnFaces) {
    result.notes.push_back(fmt::format("the file has {} loose faces, more than the {} that are sewn", faces.Extent(), kMostSewnFaces));
    return result;
  }
  try {
    const Sewn sewn = sew_by_steps(faces, size_mm);
    const std::vector<TopoDS_Shell> shells = consistent_shells(sewn.shape);
    sides.take(sewn, shells);
    result.notes.push_back(account(result, sewn, shells.size() - static_cast<std::size_t>(result.solids)));
  } catch (const Standard_Failure& failure) {
    result = Sides(faces).result();
    result.notes.push_back(fmt::format("the file has loose faces, which could not be sewn ({})", failure.GetMessageString()));
  }
  return result;
}

}  // namespace flank::internal
