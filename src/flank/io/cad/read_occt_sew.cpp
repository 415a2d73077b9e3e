#include "flank/io/cad/read_occt_sew.h"

#include <fmt/format.h>

#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Poly_Triangulation.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <map>
#include <utility>

namespace flank::internal {
namespace {

constexpr double kFirstShare = 1e-6;  ///< sewing tolerances are tried from this share of the size on, times ten each

struct Sewn {
  TopoDS_Shape shape;
  std::vector<TopoDS_Shape> faces;  ///< what has become of each face
  int free_edges = 0;
  double gap_mm = 0.0;
};

/// The loose faces, as each lies in the file.
Sewn loose(const TopTools_IndexedMapOfShape& faces) {
  Sewn result;
  for (int i = 1; i <= faces.Extent(); ++i) result.faces.push_back(faces(i).Oriented(TopAbs_FORWARD));
  return result;
}

/// Goes on from what a narrower gap has joined: only borders that are free still are looked at, and that is what takes the time.
Sewn sew(const Sewn& before, double tolerance_mm) {
  BRepBuilderAPI_Sewing sewing(tolerance_mm);
  if (before.shape.IsNull())
    for (const TopoDS_Shape& face : before.faces) sewing.Add(face);
  else
    sewing.Add(before.shape);
  sewing.Perform();
  Sewn result{sewing.SewedShape(), {}, sewing.NbFreeEdges(), tolerance_mm};
  for (const TopoDS_Shape& face : before.faces) result.faces.push_back(sewing.ModifiedSubShape(face));
  return result;
}

/// With the least gap beyond which nothing more closes. A gap as wide as a face would swallow it, so that one that loses
/// faces is too wide.
Sewn sew_by_steps(const TopTools_IndexedMapOfShape& faces, double size_mm) {
  Sewn best = sew(loose(faces), kFirstShare * size_mm);
  for (double share = 10.0 * kFirstShare; best.free_edges > 0 && share < 1.5 * kSewingShare; share *= 10.0) {
    Sewn next = sew(best, share * size_mm);
    TopTools_IndexedMapOfShape left;
    TopExp::MapShapes(next.shape, TopAbs_FACE, left);
    if (left.Extent() < faces.Extent()) break;
    if (next.free_edges < best.free_edges) best = std::move(next);
  }
  return best;
}

/// Two faces along one edge, or one alone along a free one.
struct Joint {
  double length = 0.0;  ///< of the edge, mm
  int a = -1, b = -1;
  bool same_way = false;  ///< the edge runs the same way round in both, so that one of the two is to be turned
};

/// Which way the edge runs in the face, were it oriented forward: +1 or -1; 0: both, a seam.
int way_of(const TopoDS_Shape& edge, const TopoDS_Shape& face) {
  int way = 0;
  for (TopExp_Explorer it(face.Oriented(TopAbs_FORWARD), TopAbs_EDGE); it.More(); it.Next())
    if (it.Current().IsSame(edge)) way += it.Current().Orientation() == TopAbs_FORWARD ? 1 : -1;
  return way;
}

/// All edges of the sewn shape but seams and those where more than two faces meet, the longest first: what short ones say
/// is often a slip of the sewing.
std::vector<Joint> joints_of(const Sewn& sewn) {
  TopTools_DataMapOfShapeInteger numbers;
  for (std::size_t k = 0; k < sewn.faces.size(); ++k)
    if (!sewn.faces[k].IsNull()) numbers.Bind(sewn.faces[k], static_cast<int>(k));
  TopTools_IndexedDataMapOfShapeListOfShape owners;
  TopExp::MapShapesAndAncestors(sewn.shape, TopAbs_EDGE, TopAbs_FACE, owners);
  std::vector<Joint> joints;
  for (int i = 1; i <= owners.Extent(); ++i) {
    const TopoDS_Shape& edge = owners.FindKey(i);
    if (BRep_Tool::Degenerated(TopoDS::Edge(edge))) continue;
    std::vector<std::pair<int, int>> sides;
    for (const TopoDS_Shape& face : owners(i))
      if (const int* k = numbers.Seek(face)) sides.emplace_back(*k, way_of(edge, face));
    const bool seam = !sides.empty() && sides.front().second == 0;
    if (sides.empty() || sides.size() > 2 || seam || (sides.size() == 2 && sides[0].first == sides[1].first)) continue;
    GProp_GProps properties;
    BRepGProp::LinearProperties(edge, properties);
    const bool free = sides.size() == 1;
    joints.push_back(
        {properties.Mass(), sides[0].first, free ? -1 : sides[1].first, !free && sides[0].second == sides[1].second});
  }
  std::stable_sort(joints.begin(), joints.end(), [](const Joint& x, const Joint& y) { return x.length > y.length; });
  return joints;
}

/// Faces joined to sheets, each turned or not against the first of its sheet.
class Sheets {
 public:
  explicit Sheets(std::size_t count) : parent_(count), turned_(count, false) {
    for (std::size_t k = 0; k < count; ++k) parent_[k] = static_cast<int>(k);
  }

  void join(const Joint& joint) {
    const int a = root(joint.a), b = root(joint.b);
    if (a == b) return;
    const bool turn = joint.same_way != (turned(joint.a) != turned(joint.b));
    parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    turned_[static_cast<std::size_t>(std::max(a, b))] = turn;
  }

  [[nodiscard]] int root(int face) const {
    while (parent_[static_cast<std::size_t>(face)] != face) face = parent_[static_cast<std::size_t>(face)];
    return face;
  }
  [[nodiscard]] bool turned(int face) const {
    bool turn = false;
    for (; parent_[static_cast<std::size_t>(face)] != face; face = parent_[static_cast<std::size_t>(face)])
      turn = turn != turned_[static_cast<std::size_t>(face)];
    return turn;
  }

 private:
  std::vector<int> parent_;
  std::vector<bool> turned_;
};

/// Six times the volume between the triangles of a face, oriented forward, and the origin; they are those of the file's
/// face.
double volume_under(const TopoDS_Face& face) {
  TopLoc_Location location;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, location);
  if (mesh.IsNull()) return 0.0;
  const auto node = [&](int i) { return mesh->Node(i).Transformed(location.Transformation()).XYZ(); };
  double volume = 0.0;
  for (int i = 1; i <= mesh->NbTriangles(); ++i) {
    int a = 0, b = 0, c = 0;
    mesh->Triangle(i).Get(a, b, c);
    volume += node(a).Dot(node(b).Crossed(node(c)));
  }
  return volume;
}

/// What is known of the faces before they are sewn: each as it stands.
SewnFaces as_they_stand(const TopTools_IndexedMapOfShape& faces) {
  SewnFaces result;
  for (int i = 1; i <= faces.Extent(); ++i) {
    result.solid.push_back(-1);
    result.reversed.push_back(faces(i).Orientation() == TopAbs_REVERSED);
  }
  return result;
}

/// Orients the members of one sheet; a closed one becomes the next solid.
void orient(const TopTools_IndexedMapOfShape& faces, const Sheets& sheets, const std::vector<int>& members, bool closed,
            SewnFaces& result) {
  bool flip = false;
  if (closed) {
    double volume = 0.0;
    for (const int k : members) {
      const double part = volume_under(TopoDS::Face(faces(k + 1)));
      volume += sheets.turned(k) ? -part : part;
    }
    flip = volume < 0.0;
  } else {
    // Nothing says which side of an open sheet is out: most of its faces stay as they stand, or the first.
    std::size_t others = 0;
    for (const int k : members) others += sheets.turned(k) != result.reversed[static_cast<std::size_t>(k)];
    const auto first = static_cast<std::size_t>(members.front());
    const bool tie = 2 * others == members.size();
    flip = tie ? sheets.turned(members.front()) != result.reversed[first] : 2 * others > members.size();
  }
  for (const int k : members) {
    result.reversed[static_cast<std::size_t>(k)] = sheets.turned(k) != flip;
    if (closed) result.solid[static_cast<std::size_t>(k)] = result.solids;
  }
  result.solids += closed ? 1 : 0;
}

/// The sheets that the sewn faces form; returns how many of them are open.
std::size_t take_sides(const TopTools_IndexedMapOfShape& faces, const Sewn& sewn, SewnFaces& result) {
  const std::vector<Joint> joints = joints_of(sewn);
  Sheets sheets(sewn.faces.size());
  for (const Joint& joint : joints)
    if (joint.b >= 0) sheets.join(joint);
  std::vector<bool> open(sewn.faces.size(), false), joined(sewn.faces.size(), false);
  for (const Joint& joint : joints) {
    const auto root = static_cast<std::size_t>(sheets.root(joint.a));
    joined[root] = true;
    if (joint.b < 0 && joint.length > sewn.gap_mm) open[root] = true;
  }
  std::map<int, std::vector<int>> members;
  for (std::size_t k = 0; k < sewn.faces.size(); ++k)
    members[sheets.root(static_cast<int>(k))].push_back(static_cast<int>(k));
  std::size_t count = 0;
  for (const auto& [root, all] : members) {
    // A face without any border but seams is closed by itself: a ball, a torus.
    const bool closed = !open[static_cast<std::size_t>(root)] && sewn.free_edges == 0
                            ? true
                            : !open[static_cast<std::size_t>(root)] && joined[static_cast<std::size_t>(root)];
    orient(faces, sheets, all, closed, result);
    count += closed ? 0 : 1;
  }
  return count;
}

std::string account(const SewnFaces& sides, const Sewn& sewn, std::size_t open) {
  const std::string gap = fmt::format("over gaps of up to {:.2g} mm", sewn.gap_mm);
  if (sides.solids > 0 && open == 0)
    return fmt::format("the file has loose faces: they were sewn to {} solid{}, {}", sides.solids,
                       sides.solids == 1 ? "" : "s", gap);
  if (sides.solids > 0)
    return fmt::format("the file has loose faces: they were sewn to {} solid{} and {} open sheet{}, {}", sides.solids,
                       sides.solids == 1 ? "" : "s", open, open == 1 ? "" : "s", gap);
  return fmt::format(
      "the file has loose faces that do not form a closed solid: {} open sheet{} when sewn, {}, {} free edges; the "
      "side of "
      "the material is not known",
      open, open == 1 ? "" : "s", gap, sewn.free_edges);
}

}  // namespace

SewnFaces sew_loose_faces(const TopTools_IndexedMapOfShape& faces, double size_mm) {
  SewnFaces result = as_they_stand(faces);
  if (faces.Extent() > kMostSewnFaces) {
    result.notes.push_back(
        fmt::format("the file has {} loose faces, more than the {} that are sewn", faces.Extent(), kMostSewnFaces));
    return result;
  }
  try {
    const Sewn sewn = sew_by_steps(faces, size_mm);
    const std::size_t open = take_sides(faces, sewn, result);
    result.notes.push_back(account(result, sewn, open));
  } catch (const Standard_Failure& failure) {
    result = as_they_stand(faces);
    result.notes.push_back(
        fmt::format("the file has loose faces, which could not be sewn ({})", failure.GetMessageString()));
  }
  return result;
}

}  // namespace flank::internal
