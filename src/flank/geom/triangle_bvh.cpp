#include "flank/geom/triangle_bvh.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Coordinate of the places of a node that hold no child: farther than anything, and its square is infinite.
constexpr float kNowhere = 1e30f;

/// Bound of the error of a single-precision distance, as a multiple of the largest coordinate involved.
constexpr double kFloatError = 64.0 * 0x1.0p-24;

/// Squared height over squared longest side below which a triangle's inner coordinates are lost in single precision.
constexpr double kThin = 0.02;

Vec3 doubled_area(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& t = mesh.triangles[triangle];
  const Vec3& a = mesh.vertices[static_cast<std::size_t>(t[0])];
  return (mesh.vertices[static_cast<std::size_t>(t[1])] - a).cross(mesh.vertices[static_cast<std::size_t>(t[2])] - a);
}

}  // namespace

TrianglePoint closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const auto at = [&](double u, double v) {
    TrianglePoint r;
    r.u = u;
    r.v = v;
    r.point = a + u * ab + v * ac;
    r.squared_distance = (p - r.point).squaredNorm();
    return r;
  };
  // Voronoi regions in turn: corner a, corner b, side ab, corner c, side ac, side bc; else the point lies above the
  // triangle, and va, vb, vc are its barycentric coordinates up to a factor.
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return at(0.0, 0.0);
  // A side between equal corners (d1 = d3 or d2 = d6) has no direction: another one is as near.
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return at(1.0, 0.0);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 && d1 > d3) return at(d1 / (d1 - d3), 0.0);
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return at(0.0, 1.0);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 && d2 > d6) return at(0.0, d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return at(1.0 - w, w);
  }
  const double scale = 1.0 / (va + vb + vc);
  return at(vb * scale, vc * scale);
}

/// What a search has found so far: an upper bound of the distance, and the triangles whose lower bound it does not
/// exclude. Both are in single precision, the bounds widened by its error; only what is left at the end is measured in
/// double precision.
struct TriangleBvh::Candidates {
  static constexpr int kRoom = 64;
  float error, slack;
  float nearest = kInfinity;             // upper bound of the distance
  float winning = kInfinity;             // squared lower bound beyond which a triangle cannot be the nearest
  float bound = kInfinity;               // and beyond which it is not asked for
  std::array<float, kRoom + 4> squared;  // lower bounds
  std::array<int, kRoom + 4> place;      // in corners_ and triangles_
  int count = 0;
  bool complete = true;
  BvhHit best;  // of those measured already

  Candidates(double error_mm, double slack_mm)
      : error(static_cast<float>(error_mm * 1.0001)), slack(static_cast<float>(slack_mm * 1.0001)) {}

  void limit(float distance) {
    nearest = std::min(nearest, distance);
    const float win = nearest * (1.0f + 1e-6f) + 2.0f * error, reach = win + slack;
    winning = win * win;
    bound = reach * reach;
  }

  /// Drops what has been excluded meanwhile.
  void keep(float most) {
    int kept = 0;
    for (int i = 0; i < count; ++i) {
      squared[kept] = squared[i];
      place[kept] = place[i];
      kept += squared[i] <= most;
    }
    count = kept;
  }
};

/// Top-down construction by halves across the direction of largest spread: full groups, compact patches, a bounded
/// depth.
struct TriangleBvh::Builder {
  /// No more than is compared: of a few million triangles every number here is dozens of megabytes.
  struct Item {
    Vec3 center;
    double key;
    int triangle;
  };
  struct Range {
    std::size_t begin, end;
    [[nodiscard]] std::size_t size() const { return end - begin; }
  };

  TriangleBvh& bvh;
  const TriangleMesh& mesh;
  std::vector<Item> items;

  static constexpr std::size_t kGroupSize = 4;

  /// Direction in which the triangles' centres spread most.
  [[nodiscard]] Vec3 longest_axis(const Range& r) const {
    Vec3 mean = Vec3::Zero();
    for (std::size_t i = r.begin; i < r.end; ++i) mean += items[i].center;
    mean /= static_cast<double>(r.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (std::size_t i = r.begin; i < r.end; ++i) {
      const Vec3 x = items[i].center - mean;
      spread += x * x.transpose();
    }
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(spread);
    return solver.eigenvectors().col(2);
  }

  /// Cuts across the longest axis into halves of equal count, rounded so that groups are full.
  std::pair<Range, Range> split(const Range& r) {
    const Vec3 axis = longest_axis(r);
    for (std::size_t i = r.begin; i < r.end; ++i) items[i].key = axis.dot(items[i].center);
    const std::size_t half = r.size() / 2;
    const std::size_t middle = r.begin + (half + kGroupSize - 1) / kGroupSize * kGroupSize;
    const auto at = [&](std::size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(r.begin), at(middle), at(r.end), [](const Item& x, const Item& y) {
      return x.key != y.key ? x.key < y.key : x.triangle < y.triangle;
    });
    return {{r.begin, middle}, {middle, r.end}};
  }

  /// Stores up to four triangles side by side, for one operation on all. Returns -1 - index: negative numbers are
  /// groups, others are nodes.
  int group(const Range& r) {
    Group g;
    g.thin = false;
    for (std::size_t i = 0; i < kGroupSize; ++i) {
      // The last one fills the lanes that are left; -1 marks them, so that they are not reported twice.
      const int triangle = items[r.begin + std::min(i, r.size() - 1)].triangle;
      const auto& t = mesh.triangles[static_cast<std::size_t>(triangle)];
      const Corners c{mesh.vertices[static_cast<std::size_t>(t[0])], mesh.vertices[static_cast<std::size_t>(t[1])],
                      mesh.vertices[static_cast<std::size_t>(t[2])]};
      const Vec3 ab = c.b - c.a, ac = c.c - c.a;
      const auto lane = static_cast<int>(i);
      for (int k = 0; k < 3; ++k) {
        // Relative to the box's centre: single precision has seven digits, which a part far from the origin would use
        // up.
        g.a[k][lane] = static_cast<float>(c.a[k] - bvh.center_[k]);
        g.ab[k][lane] = static_cast<float>(ab[k]);
        g.ac[k][lane] = static_cast<float>(ac[k]);
      }
      const double det = ab.cross(ac).squaredNorm();
      const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
      // Of a thin triangle the inner coordinates would be rounding: its plane is left out, and `width`, twice its
      // height, is taken off the distance to its sides instead.
      const bool thin = det <= kThin * longest * longest || det < 1e-30;
      g.inverse_det[lane] = thin ? 0.0f : static_cast<float>(1.0 / det);
      g.width[lane] = thin && longest > 0.0 ? static_cast<float>(2.0 * std::sqrt(det / longest)) : 0.0f;
      g.thin = g.thin || thin;
      bvh.corners_.push_back(c);
      bvh.triangles_.push_back(i < r.size() ? triangle : -1);
    }
    bvh.groups_.push_back(g);
    return -static_cast<int>(bvh.groups_.size());
  }

  /// The flat disc along the mean normal of the triangles in `r`, rounded outwards.
  void set_child(Node& node, int i, const Range& r) const {
    const auto each_corner = [&](auto&& body) {
      for (std::size_t k = r.begin; k < r.end; ++k)
        for (int v : mesh.triangles[static_cast<std::size_t>(items[k].triangle)])
          body(mesh.vertices[static_cast<std::size_t>(v)]);
    };
    Vec3 normal = Vec3::Zero();
    for (std::size_t k = r.begin; k < r.end; ++k)
      normal += doubled_area(mesh, static_cast<std::size_t>(items[k].triangle));
    const double length = normal.norm();
    const Eigen::Vector3f axis = (length > 0.0 ? Vec3(normal / length) : Vec3(Vec3::UnitZ())).cast<float>();
    const Vec3 n = axis.cast<double>(), e1 = n.unitOrthogonal(), e2 = n.cross(e1);
    Box3 local;
    each_corner([&](const Vec3& x) { local.add(Vec3(e1.dot(x), e2.dot(x), n.dot(x) / n.squaredNorm())); });
    // Back from the local axes, of which n is of unit length in single precision only.
    const Vec3 middle = local.center();
    const Vec3 center = middle[0] * e1 + middle[1] * e2 + (middle[2] - n.dot(middle[0] * e1 + middle[1] * e2)) * n;
    const Eigen::Vector3f c = (center - bvh.center_).cast<float>();
    // Measured from the centre as it is stored: its rounding is then in radius and thickness.
    const Vec3 rounded = c.cast<double>() + bvh.center_;
    double radius = 0.0, thickness = 0.0;
    each_corner([&](const Vec3& x) {
      const double along = n.dot(x - rounded);
      thickness = std::max(thickness, std::abs(along));
      radius = std::max(radius, (x - rounded - along * n).norm());
    });
    for (int k = 0; k < 3; ++k) {
      node.center[k][i] = c[k];
      node.axis[k][i] = axis[k];
    }
    node.radius[i] = static_cast<float>(radius * (1.0 + 1e-5));
    node.thickness[i] = static_cast<float>(thickness * (1.0 + 1e-5));
  }

  /// Halves the largest child until there are as many as the width of a node; returns the node's index.
  int node(const Range& r) {
    std::array<Range, kWidth> children{r};
    std::size_t count = 1;
    while (count < kWidth) {
      std::size_t widest = count;
      for (std::size_t i = 0; i < count; ++i) {
        if (children[i].size() <= kGroupSize) continue;
        if (widest == count || children[i].size() > children[widest].size()) widest = i;
      }
      if (widest == count) break;
      const auto halves = split(children[widest]);
      children[widest] = halves.first;
      children[count++] = halves.second;
    }
    const std::size_t index = bvh.nodes_.size();
    const Wide zero = Wide::Zero(), nowhere = Wide::Constant(kNowhere);
    bvh.nodes_.push_back(Node{{nowhere, nowhere, nowhere}, {zero, zero, zero}, zero, zero, {}});
    for (std::size_t i = 0; i < count; ++i) {
      const int child = children[i].size() <= kGroupSize ? group(children[i]) : node(children[i]);
      set_child(bvh.nodes_[index], static_cast<int>(i), children[i]);
      bvh.nodes_[index].child[i] = child;
    }
    return static_cast<int>(index);
  }
};

TriangleBvh::TriangleBvh(const TriangleMesh& mesh) {
  FLANK_ASSERT(!mesh.triangles.empty());
  Box3 box;
  Builder builder{*this, mesh, {}};
  builder.items.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Box3 b;
    for (int v : mesh.triangles[t]) b.add(mesh.vertices[static_cast<std::size_t>(v)]);
    box.add(b);
    builder.items.push_back({b.center(), 0.0, static_cast<int>(t)});
  }
  center_ = box.center();
  radius_ = (box.high - box.low).maxCoeff();
  nodes_.reserve(mesh.triangles.size() / 6 + 1);  // a good guess: it saves moving them about
  const std::size_t groups = mesh.triangles.size() / Builder::kGroupSize + 1;
  groups_.reserve(groups), corners_.reserve(4 * groups), triangles_.reserve(4 * groups);
  builder.node({0, builder.items.size()});
}

void TriangleBvh::visit(const Vec3& p, const Eigen::Array3f& q, int group, Candidates& found) const {
  const Group& g = groups_[static_cast<std::size_t>(group)];
  const Four x = q[0] - g.a[0], y = q[1] - g.a[1], z = q[2] - g.a[2];
  const Four d1 = g.ab[0] * x + g.ab[1] * y + g.ab[2] * z, d2 = g.ac[0] * x + g.ac[1] * y + g.ac[2] * z;
  const auto clamped = [](const Four& t) -> Four { return t.max(0.0f).min(1.0f); };
  const auto distance = [&](const Four& u, const Four& v) -> Four {
    const Four dx = x - u * g.ab[0] - v * g.ac[0], dy = y - u * g.ab[1] - v * g.ac[1],
               dz = z - u * g.ab[2] - v * g.ac[2];
    return dx * dx + dy * dy + dz * dz;
  };
  const Four bb = g.ab[0] * g.ab[0] + g.ab[1] * g.ab[1] + g.ab[2] * g.ab[2];
  const Four bc = g.ab[0] * g.ac[0] + g.ab[1] * g.ac[1] + g.ab[2] * g.ac[2];
  const Four cc = g.ac[0] * g.ac[0] + g.ac[1] * g.ac[1] + g.ac[2] * g.ac[2];
  // The closest points of the three sides, and that of the plane if it lies in the triangle (else a huge penalty
  // removes it). For a thin triangle u = v = 0, which is corner a.
  const Four zero = Four::Zero(), tiny = Four::Constant(1e-37f);
  const Four w = clamped((bb - bc + d2 - d1) / (bb - 2.0f * bc + cc).max(tiny));
  const Four sides = distance(clamped(d1 / bb.max(tiny)), zero)
                         .min(distance(zero, clamped(d2 / cc.max(tiny))))
                         .min(distance(1.0f - w, w));
  const Four u = (cc * d1 - bc * d2) * g.inverse_det, v = (bb * d2 - bc * d1) * g.inverse_det;
  const Four outside = -u.min(v).min(1.0f - u - v).min(0.0f);
  const Four upper = sides.min(distance(u, v) + outside * 1e30f);
  const Four lower = g.thin ? Four((upper.sqrt() - g.width).max(0.0f).square()) : upper;
  found.limit(std::sqrt(upper.minCoeff()));
  for (int i = 0; i < 4; ++i) {
    found.squared[found.count] = lower[i];
    found.place[found.count] = 4 * group + i;
    found.count += lower[i] <= found.bound;
  }
  if (found.count > Candidates::kRoom) make_room(p, found);
}

TriangleBvh::Wide TriangleBvh::bounds(const Node& n, const Eigen::Array3f& q) {
  const Wide x = q[0] - n.center[0], y = q[1] - n.center[1], z = q[2] - n.center[2];
  const Wide along = (x * n.axis[0] + y * n.axis[1] + z * n.axis[2]).abs();
  // The difference of squares cancels; the factor takes more than it can lose.
  const Wide across = ((x * x + y * y + z * z) * (1.0f - 0x1.0p-19f) - along * along).max(0.0f).sqrt();
  const Wide up = (along - n.thickness).max(0.0f), out = (across - n.radius).max(0.0f);
  return up * up + out * out;
}

void TriangleBvh::search(const Vec3& p, Candidates& found) const {
  struct Entry {
    float squared;
    int child;
  };
  const Eigen::Array3f q = (p - center_).cast<float>().array();
  std::array<Entry, 256> stack;
  int top = 0;
  Entry at{0.0f, 0};
  for (;;) {
    if (at.squared <= found.bound && at.child < 0) {
      visit(p, q, -at.child - 1, found);
    } else if (at.squared <= found.bound) {
      const Node& n = nodes_[static_cast<std::size_t>(at.child)];
      const Wide squared = bounds(n, q);
      // Without branches, which would be mispredicted: whatever matters goes on the stack, the nearest of it on top.
      int nearest = top;
      float least = kInfinity;
      for (int i = 0; i < kWidth; ++i) {
        stack[top] = {squared[i], n.child[i]};
        const bool nearer = squared[i] < least;
        nearest = nearer ? top : nearest;
        least = nearer ? squared[i] : least;
        top += squared[i] <= found.bound && squared[i] < kInfinity;
      }
      if (nearest < top) std::swap(stack[nearest], stack[top - 1]);
    }
    if (top == 0) return;
    at = stack[--top];
  }
}

double TriangleBvh::float_error(const Vec3& p) const {
  return kFloatError * ((p - center_).cwiseAbs().maxCoeff() + radius_);
}

/// More triangles than can be kept are nearly as near as the nearest (p is close to the centre of a sphere): they are
/// measured now.
void TriangleBvh::make_room(const Vec3& p, Candidates& found) const {
  found.keep(found.bound);
  if (found.count <= Candidates::kRoom / 2) return;
  measure(p, found);
  found.count = 0;
  found.complete = false;
}

void TriangleBvh::measure(const Vec3& p, Candidates& found) const {
  for (int i = 0; i < found.count; ++i) {
    const auto k = static_cast<std::size_t>(found.place[i]);
    if (found.squared[i] > found.winning || triangles_[k] < 0) continue;
    const TrianglePoint point = closest_on_triangle(p, corners_[k].a, corners_[k].b, corners_[k].c);
    if (found.best.triangle >= 0 && point.squared_distance >= found.best.squared_distance) continue;
    static_cast<TrianglePoint&>(found.best) = point;
    found.best.triangle = triangles_[k];
  }
}

BvhHit TriangleBvh::closest(const Vec3& p) const {
  FLANK_ASSERT(!nodes_.empty() && p.allFinite());
  Candidates found(float_error(p), 0.0);
  search(p, found);
  measure(p, found);
  return found.best;
}

BvhHit TriangleBvh::closest_within(const Vec3& p, double most) const {
  FLANK_ASSERT(!nodes_.empty() && p.allFinite());
  FLANK_ASSERT(most >= 0.0);
  Candidates found(float_error(p), 0.0);
  found.limit(static_cast<float>(most * (1.0 + 1e-6)));
  search(p, found);
  measure(p, found);
  if (found.best.triangle >= 0 && found.best.squared_distance <= most * most) return found.best;
  BvhHit none;
  none.squared_distance = most * most;
  return none;
}

BvhHit TriangleBvh::closest(const Vec3& p, double slack, BvhTies& ties) const {
  FLANK_ASSERT(!nodes_.empty() && p.allFinite());
  FLANK_ASSERT(slack >= 0.0);
  Candidates found(float_error(p), slack);
  search(p, found);
  found.keep(found.bound);
  ties.count = 0;
  ties.complete = found.complete;
  for (int i = 0; i < found.count; ++i) {
    const int triangle = triangles_[static_cast<std::size_t>(found.place[i])];
    if (triangle >= 0) ties.triangle[static_cast<std::size_t>(ties.count++)] = triangle;
  }
  measure(p, found);
  return found.best;
}

}  // namespace flank::internal
