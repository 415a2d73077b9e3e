#include "flank/inspect.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/geom/trim.h"
#include "flank/inspect/inspect_mesh.h"
#include "flank/inspect/inspect_order.h"
#include "flank/inspect/inspect_text.h"
#include "flank/io/face_groups.h"

namespace flank {
using namespace internal;
namespace {

/// Cells that a trim cuts are halved this many times before their middle decides.
constexpr int kCutDepth = 5;
constexpr int kCells = 16;         // of the integral of the area, in a direction, at least
constexpr int kLengthSteps = 200;  // chords of a line whose length is taken
/// Derivatives shorter than this share of the face's longest belong to a point where a side of the parameter rectangle
/// has shrunk.
constexpr double kShrunk = 1e-3;
/// Sine of the angle between the parameter lines below which curvatures are not to be had.
constexpr double kDegenerate = 0.01;
constexpr int kMeshSamples = 1000;  // vertices of a mesh face where its bend is looked at
/// Mesh faces with a smaller share of the area are not looked at closely.
constexpr double kLeastAreaShareForBend = 1e-3;
/// Of the samples of a mesh this share decides on the smallest concave radius: the rest is noise and torn borders.
constexpr double kMeshQuantile = 0.99;

/// How many places of a face bend in which way.
struct Bends {
  std::array<long, 4> count{};
  std::vector<double> concave;  ///< curvatures towards the machining side

  void add(double low, double high, double flat) {
    // `flat` is a curvature, 1/mm: below it a bow over the whole face would not be noticed.
    const bool away = low<-flat, towards = high> flat;
    const Bend bend = away && towards ? Bend::kSaddle : towards ? Bend::kConcave : away ? Bend::kConvex : Bend::kFlat;
    ++count[static_cast<std::size_t>(bend)];
    if (towards) concave.push_back(high);
  }
};

/// Writes what the places say into the row. `quantile` of the concave curvatures, sorted, gives the smallest radius:
/// 1 for exact faces.
void conclude(Bends bends, double quantile, InspectRow& row) {
  static constexpr std::array<const char*, 4> kNames = {"flat", "convex", "concave", "saddle"};
  long total = 0;
  for (const long n : bends.count) total += n;
  row.bend = total > 0 ? "mixed" : "unknown";
  for (std::size_t i = 0; i < kNames.size() && total > 0; ++i) {
    row.bend_share[i] = static_cast<double>(bends.count[i]) / static_cast<double>(total);
    if (row.bend_share[i] >= kPureShare) row.bend = kNames[i];
  }
  if (bends.concave.empty()) return;
  std::sort(bends.concave.begin(), bends.concave.end());
  const double last = static_cast<double>(bends.concave.size() - 1);
  row.smallest_concave_radius_mm = 1.0 / bends.concave[static_cast<std::size_t>(quantile * last)];
}

/// Principal curvatures, positive where the surface bends towards the side of sign * (S_u x S_v); false at degenerate
/// points.
bool curvatures(const SurfaceJet& jet, const Vec2& least, double sign, double& low, double& high) {
  const Vec3 cross = jet.du.cross(jet.dv);
  const double e = jet.du.squaredNorm(), f = jet.du.dot(jet.dv), g = jet.dv.squaredNorm(), area = cross.norm();
  if (!(area > kDegenerate * std::sqrt(e * g)) || e < least[0] * least[0] || g < least[1] * least[1]) return false;
  const Vec3 n = sign * cross / area;
  const double l = jet.duu.dot(n), m = jet.duv.dot(n), nn = jet.dvv.dot(n), det = area * area;
  // From the first and second fundamental form.
  const double mean = 0.5 * (e * nn - 2.0 * f * m + g * l) / det, gauss = (l * nn - m * m) / det;
  // The root of a difference that rounding may make negative at umbilics.
  const double spread = std::sqrt(std::max(0.0, mean * mean - gauss));
  low = mean - spread, high = mean + spread;
  return true;
}

/// Area of one cell by Gauss' rule with `points` (2 or 4) in each direction.
double gauss_area(const BSplineSurface& s, const ParameterRectangle& r, int points) {
  static constexpr double kX2[] = {-0.5773502691896257, 0.5773502691896257}, kW2[] = {1.0, 1.0};
  static constexpr double kX4[] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
  static constexpr double kW4[] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
  const double *x = points == 2 ? kX2 : kX4, *w = points == 2 ? kW2 : kW4;
  const double hu = 0.5 * (r.u1 - r.u0), hv = 0.5 * (r.v1 - r.v0);
  double sum = 0.0;
  for (int i = 0; i < points; ++i) {
    for (int j = 0; j < points; ++j) {
      const SurfaceJet jet = s.jet(r.u0 + hu * (1.0 + x[i]), r.v0 + hv * (1.0 + x[j]));
      sum += w[i] * w[j] * jet.du.cross(jet.dv).norm();
    }
  }
  return sum * hu * hv;
}

/// mm^2 of the trimmed part of a cell: by halving where a loop passes, down to kCutDepth.
double trimmed_area(const BSplineSurface& s, const TrimRegion& region, const ParameterRectangle& r, int depth) {
  const TrimRegion::Side side = region.whole() ? TrimRegion::Side::kInside : region.classify(r);
  if (side == TrimRegion::Side::kOutside) return 0.0;
  // Small cells beside a loop need fewer points than whole ones for the same error.
  if (side == TrimRegion::Side::kInside) return gauss_area(s, r, depth == kCutDepth ? 4 : 2);
  const double u = 0.5 * (r.u0 + r.u1), v = 0.5 * (r.v0 + r.v1);
  if (depth == 0) {
    if (!region.inside(u, v)) return 0.0;
    const SurfaceJet jet = s.jet(u, v);
    return jet.du.cross(jet.dv).norm() * (r.u1 - r.u0) * (r.v1 - r.v0);
  }
  return trimmed_area(s, region, {r.u0, u, r.v0, v}, depth - 1) +
         trimmed_area(s, region, {u, r.u1, r.v0, v}, depth - 1) +
         trimmed_area(s, region, {r.u0, u, v, r.v1}, depth - 1) +
         trimmed_area(s, region, {u, r.u1, v, r.v1}, depth - 1);
}

double middle(double a, double b, int i, int count) { return a + (b - a) * i / count; }

/// Where cells begin and end: at every knot of the range, because the integrand has kinks there, and between them.
std::vector<double> cell_borders(int degree, const std::vector<double>& knots, double a, double b) {
  std::vector<double> borders{a};
  for (std::size_t k = static_cast<std::size_t>(degree); k + static_cast<std::size_t>(degree) < knots.size(); ++k) {
    const double next = std::clamp(knots[k], a, b), from = borders.back();
    const int pieces = static_cast<int>(std::ceil(kCells * (next - from) / (b - a) - 1e-9));
    for (int i = 1; i <= pieces; ++i) borders.push_back(i == pieces ? next : middle(from, next, i, pieces));
  }
  if (borders.back() < b) borders.push_back(b);
  return borders;
}

/// mm^2, of the trimmed face.
double area(const BSplineSurface& s, const TrimRegion& region) {
  const ParameterRectangle& b = region.box();
  const std::vector<double> u = cell_borders(s.degree_u, s.knots_u, b.u0, b.u1),
                            v = cell_borders(s.degree_v, s.knots_v, b.v0, b.v1);
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < u.size(); ++i)
    for (std::size_t j = 0; j + 1 < v.size(); ++j)
      sum += trimmed_area(s, region, {u[i], u[i + 1], v[j], v[j + 1]}, kCutDepth);
  return sum;
}

/// mm, of the line through the middle of the parameter box: a size that people recognise, though no exact measure.
double iso_length(const BSplineSurface& s, const ParameterRectangle& b, bool along_u) {
  const double u = 0.5 * (b.u0 + b.u1), v = 0.5 * (b.v0 + b.v1);
  double length = 0.0;
  Vec3 before = along_u ? s.value(b.u0, v) : s.value(u, b.v0);
  for (int i = 1; i <= kLengthSteps; ++i) {
    const Vec3 p =
        along_u ? s.value(middle(b.u0, b.u1, i, kLengthSteps), v) : s.value(u, middle(b.v0, b.v1, i, kLengthSteps));
    length += (p - before).norm();
    before = p;
  }
  return length;
}

/// Points of the trims: a grid inside of them misses the box's extremes at the border.
void add_border(const Face& face, Box3& box) {
  for (const TrimLoop& loop : face.loops) {
    for (const BSplineCurve2& edge : loop.edges) {
      const int steps = 8 * edge.count();
      for (int i = 0; i < steps; ++i) {
        const Vec2 q = edge.value(middle(edge.first(), edge.last(), i, steps));
        box.add(face.surface.value(q.x(), q.y()));
      }
    }
  }
}

/// Centre and mean normal of samples, each with its part of the area.
class Middle {
 public:
  /// `area_normal`: as long as the sample's area, mm^2, on the machining side.
  void add(const Vec3& place, const Vec3& area_normal) {
    const double weight = area_normal.norm();
    area_ += weight;
    place_ += weight * place;
    normal_ += area_normal;
  }
  void write(InspectRow& row) const {
    if (!(area_ > 0.0)) return;
    row.centre = place_ / area_;
    if (normal_.norm() > kLeastMeanNormal * area_) row.normal = normal_.normalized();
  }

 private:
  double area_ = 0.0;
  Vec3 place_ = Vec3::Zero(), normal_ = Vec3::Zero();
};

/// What of a row needs no samples.
InspectRow row_of(const Face& face, const std::string& type) {
  const BSplineSurface& s = face.surface;
  InspectRow row;
  row.id = face.id;
  row.type = type;
  row.degree_u = s.degree_u, row.degree_v = s.degree_v;
  row.poles_u = s.count_u, row.poles_v = s.count_v;
  row.rational = !s.weights.empty();
  row.trims = static_cast<int>(face.loops.size());
  row.holes = std::max(0, row.trims - 1);
  row.solid = face.of_solid ? face.solid : -1;
  return row;
}

/// Of a grid over the trimmed range, what lies inside.
std::vector<SurfaceJet> samples_of(const BSplineSurface& s, const TrimRegion& region) {
  const ParameterRectangle& b = region.box();
  std::vector<SurfaceJet> jets;
  for (int i = 0; i <= kInspectGrid; ++i) {
    for (int j = 0; j <= kInspectGrid; ++j) {
      const double u = middle(b.u0, b.u1, i, kInspectGrid), v = middle(b.v0, b.v1, j, kInspectGrid);
      if (region.whole() || region.inside(u, v)) jets.push_back(s.jet(u, v));
    }
  }
  return jets;
}

InspectRow inspect_face(const Face& face, const std::string& type) {
  const BSplineSurface& s = face.surface;
  InspectRow row = row_of(face, type);
  const TrimRegion region(face.loops, {s.u_first(), s.u_last(), s.v_first(), s.v_last()});
  row.area_mm2 = area(s, region);
  row.length_u_mm = iso_length(s, region.box(), true), row.length_v_mm = iso_length(s, region.box(), false);
  const std::vector<SurfaceJet> jets = samples_of(s, region);
  const double sign = face.reversed ? -1.0 : 1.0;
  Middle middle_of_face;
  Vec2 longest = Vec2::Zero();
  for (const SurfaceJet& jet : jets) {
    row.box.add(jet.p);
    middle_of_face.add(jet.p, sign * jet.du.cross(jet.dv));
    longest = longest.cwiseMax(Vec2(jet.du.norm(), jet.dv.norm()));
  }
  add_border(face, row.box);
  middle_of_face.write(row);
  Bends bends;
  double low = 0.0, high = 0.0;
  // In a second round: what counts as shrunk depends on the longest derivative of the face.
  for (const SurfaceJet& jet : jets)
    if (curvatures(jet, kShrunk * longest, sign, low, high)) bends.add(low, high, kFlatBow / row.box.diagonal());
  conclude(std::move(bends), 1.0, row);
  return row;
}

double mesh_area(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[static_cast<std::size_t>(t[0])], &b = mesh.vertices[static_cast<std::size_t>(t[1])],
               &c = mesh.vertices[static_cast<std::size_t>(t[2])];
    sum += 0.5 * (b - a).cross(c - a).norm();
  }
  return sum;
}

/// The bend of faces that are small, in area or in vertices, stays unknown.
InspectRow inspect_mesh_face(const Part& part, int index, double total_area) {
  InspectRow row;
  row.id = fmt::format("F{}", index + 1);
  row.type = "mesh";
  const TriangleMesh mesh = extract_mesh(part, {index});
  row.triangles = static_cast<int>(mesh.triangles.size());
  row.box = mesh.box();
  row.area_mm2 = mesh_area(mesh);
  Middle middle_of_face;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto corner = [&](int k) { return mesh.vertices[static_cast<std::size_t>(k)]; };
    const Vec3 p = corner(a), q = corner(b), r = corner(c);
    middle_of_face.add((p + q + r) / 3.0, 0.5 * (q - p).cross(r - p));
  }
  middle_of_face.write(row);
  Bends bends;
  if (row.area_mm2 >= kLeastAreaShareForBend * total_area)
    for (const auto& [low, high] : mesh_curvatures(mesh, kMeshSamples))
      bends.add(low, high, kFlatBow / row.box.diagonal());
  conclude(std::move(bends), kMeshQuantile, row);
  return row;
}

}  // namespace

InspectReport inspect(const Part& part) {
  InspectReport report{part.file, part.format, part.unit, part.solids, part.box, {}, part.repairs};
  report.rows.resize(static_cast<std::size_t>(part.face_count()));
  // Zero for a part of faces: its rows do not ask for it.
  const double total_area = mesh_area(part.mesh);
  parallel_for(report.rows.size(), [&](std::size_t i) {
    if (part.is_left_out(static_cast<int>(i))) {
      report.rows[i].id = part.face_id(static_cast<int>(i));
      report.rows[i].type = report.rows[i].bend = "not read";
      report.rows[i].why = part.left_out.at(static_cast<int>(i));
      return;
    }
    report.rows[i] = part.is_mesh() ? inspect_mesh_face(part, static_cast<int>(i), total_area)
                                    : inspect_face(part.faces[i], part.surface_types[i]);
    for (const NamedPiece& piece : pieces_of_face(part, static_cast<int>(i)))
      report.rows[i].pieces.push_back(inspect_face(piece.face, piece.edge ? "edge" : "side"));
  });
  return report;
}

const std::vector<std::string>& inspect_sorts() { return sorts(); }

InspectReport in_order(InspectReport report, const InspectOrder& order) {
  arrange(order, report.rows);
  return report;
}

std::string inspect_table(const InspectReport& report) { return to_table(report); }

std::string inspect_json(const InspectReport& report) { return inspect_to_json(report); }

}  // namespace flank
