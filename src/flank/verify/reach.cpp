// Why two tests: a point of the target that lies deep inside another solid has a ball that enters nothing, since the
// solid's surface is far away. Between the two cases the ball always enters that surface: where the target passes
// through it, the centre is at most a radius from it. So what is inside and what is not need only be told apart where
// the surface is farther than the ball, which the winding number does whatever the triangulation's small gaps.
#include "flank/verify/reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <span>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/base/stopping.h"
#include "flank/error.h"
#include "flank/geom/tessellate.h"
#include "flank/geom/triangle_bvh.h"
#include "flank/verify/buried.h"
#include "flank/verify/clearance/obstacle_tree.h"
#include "flank/verify/clearance/winding.h"

namespace flank::internal {
namespace {

using namespace internal::verify;

/// A cell on the border of the reachable part is measured at the places of a Fibonacci lattice: every line along a side
/// of the cell holds one of them, so that a border along the sides is seen as finely as one across.
constexpr int kPlaces = 89, kTurn = 55;
constexpr std::size_t kBlock = 256;     ///< samples per task; fixed, so that threads change nothing
constexpr std::size_t kLeastBlock = 8;  ///< so few balls are measured one by one
constexpr std::size_t kFewTriangles = 24;
constexpr double kRounding = 1e-9;  ///< relative: widens a ball by more than round-off can shrink it
constexpr int kStackSize =
    128;  ///< each level leaves one node behind, and a tree that halves is 31 levels deep at most

double triangle_distance(const ObstacleTree& tree, int triangle, const Vec3& x) {
  const std::array<Vec3, 3> v = tree.corners(triangle);
  return std::sqrt(closest_on_triangle(x, v[0], v[1], v[2]).squared_distance);
}

Vec3 triangle_point(const ObstacleTree& tree, int triangle, const Vec3& x) {
  const std::array<Vec3, 3> v = tree.corners(triangle);
  return closest_on_triangle(x, v[0], v[1], v[2]).point;
}

/// No triangle of the node is nearer.
double node_bound(const ObstacleTree::Node& node, const Vec3& x) {
  const double along = node.normal.dot(x);
  const double slab = std::max(node.low - along, along - node.high);
  return std::max(slab, (x - node.sphere.center).norm() - node.sphere.radius);
}

using Trees = std::vector<std::shared_ptr<const ObstacleTree>>;
using NearTrees = std::vector<const ObstacleTree*>;

/// A triangle of one of some trees.
struct TreeTriangle {
  const ObstacleTree* tree = nullptr;
  int triangle = -1;
};

/// Distance from x to the nearest triangle where that is below `cap`, else `cap`; any distance below `enough` if there
/// is one. `nearest`: that triangle; stays as it is if none is below the cap.
double capped_distance(const ObstacleTree& tree, const Vec3& x, double cap, double enough, int* nearest = nullptr) {
  if (tree.empty()) return cap;
  struct Promise {
    int index;
    double least;
  };
  std::array<Promise, kStackSize> stack;  // without values: most trees are asked for their root alone
  int size = 0;
  stack[size++] = {0, node_bound(tree.node(0), x)};
  double least = cap;
  while (size > 0 && least >= enough) {
    const auto [index, promised] = stack[--size];
    if (promised >= least) continue;
    const ObstacleTree::Node& node = tree.node(index);
    if (node.second < 0) {
      for (int k = node.first; k < node.end; ++k) {
        const double here = triangle_distance(tree, k, x);
        if (here >= least) continue;
        least = here;
        if (nearest != nullptr) *nearest = k;
      }
      continue;
    }
    Promise near{index + 1, node_bound(tree.node(index + 1), x)},
        far{node.second, node_bound(tree.node(node.second), x)};
    if (far.least < near.least) std::swap(near, far);
    if (far.least < least) stack[size++] = far;
    if (near.least < least) stack[size++] = near;
  }
  return least;
}

/// The same of several trees.
double capped_distance(const NearTrees& trees, const Vec3& x, double cap, double enough,
                       TreeTriangle* nearest = nullptr) {
  double least = cap;
  for (const ObstacleTree* tree : trees) {
    if (least < enough) break;
    int here = -1;
    least = capped_distance(*tree, x, least, enough, &here);
    if (here >= 0 && nearest != nullptr) *nearest = {tree, here};
  }
  return least;
}

/// Those of which a triangle may be nearer to x than `cap`.
NearTrees trees_within(const NearTrees& trees, const Vec3& x, double cap) {
  NearTrees near;
  for (const ObstacleTree* tree : trees)
    if (!tree->empty() && node_bound(tree->node(0), x) < cap) near.push_back(tree);
  return near;
}

/// The triangles that are nearer to x than `cap`.
void add_triangles_within(const ObstacleTree& tree, const Vec3& x, double cap, std::vector<TreeTriangle>& found) {
  std::vector<int> stack;
  if (!tree.empty()) stack.push_back(0);
  while (!stack.empty()) {
    const int index = stack.back();
    stack.pop_back();
    const ObstacleTree::Node& node = tree.node(index);
    if (node_bound(node, x) >= cap) continue;
    if (node.second >= 0) {
      stack.push_back(node.second);
      stack.push_back(index + 1);
      continue;
    }
    for (int k = node.first; k < node.end; ++k)
      if (triangle_distance(tree, k, x) < cap) found.push_back({&tree, k});
  }
}

/// The ball at one sample.
struct Ball {
  Vec3 center, normal;
  double area = 0.0;   ///< of the sample's cell
  double slack = 0.0;  ///< no place of the cell moves the centre by more
};

/// A solid that a ball's centre may lie in.
struct ReadySolid {
  int number = -1;
  Box3 box;
  std::vector<Winding> faces;  ///< of each of its faces
  bool all_checked = true;     ///< none is there only to close it
  Trees surface = {};          ///< the same faces

  /// More than half wound round, as Winding::inside says of a whole mesh.
  [[nodiscard]] bool holds(const Vec3& x) const {
    if ((x.array() < box.low.array()).any() || (x.array() > box.high.array()).any()) return false;
    double sum = 0.0;
    for (const Winding& face : faces) sum += face.number(x);
    return std::abs(sum) > 0.5;
  }
};

/// What the ball must keep out of.
class Surroundings {
 public:
  Surroundings(Trees surface, std::shared_ptr<const ObstacleTree> own,
               std::vector<std::shared_ptr<const ReadySolid>> solids, bool all_checked, double limit)
      : limit_(limit),
        all_checked_(all_checked),
        surface_(std::move(surface)),
        own_(std::move(own)),
        solids_(std::move(solids)) {
    for (const std::shared_ptr<const ObstacleTree>& tree : surface_) all_.push_back(tree.get());
    own_alone_.push_back(own_.get());
  }

  /// The shares of the cells of neighbouring balls, in halves: a distance has slope 1, so that one place may decide for
  /// all of them.
  void measure(std::span<const Ball> balls, std::span<double> shares) const { measure(balls, shares, all_); }

  /// Radius of the largest ball up to `radius` that touches the target at x, on the side of the unit vector n, and is free.
  [[nodiscard]] double largest_ball(const Vec3& x, const Vec3& n, double radius, double tolerance) const {
    constexpr int kMostSteps = 64;
    constexpr double kSettled = 1e-3;
    for (int step = 0; step < kMostSteps && radius > tolerance; ++step) {
      const Vec3 center = x + radius * n;
      double smaller = radius;
      for (const NearTrees* trees : {&all_, &own_alone_}) {
        TreeTriangle nearest;
        const double limit = radius - tolerance;
        if (capped_distance(*trees, center, limit, 0.0, &nearest) >= limit) continue;
        const Vec3 away = triangle_point(*nearest.tree, nearest.triangle, center) - x;
        // The ball that touches at x and passes through that point. What lies behind x lets none pass.
        const double ahead = away.dot(n);
        smaller = std::min(smaller, ahead > 0.0 ? away.squaredNorm() / (2.0 * ahead) : 0.0);
      }
      if (smaller >= (1.0 - kSettled) * radius) return buried(center) ? 0.0 : radius;
      radius = smaller;
    }
    return 0.0;
  }

  /// Whether the ball that touches the target here enters it elsewhere.
  [[nodiscard]] bool in_a_corner(const Ball& ball) const {
    return capped_distance(*own_, ball.center, limit_, limit_) < limit_;
  }

 private:
  /// The same, where no other trees are near any of the balls.
  void measure(std::span<const Ball> balls, std::span<double> shares, const NearTrees& trees) const {
    if (balls.size() <= kLeastBlock) {
      stop_here();
      std::transform(balls.begin(), balls.end(), shares.begin(), [&](const Ball& ball) {
        return share(ball, trees_within(trees, ball.center, limit_ + ball.slack));
      });
      return;
    }
    Box3 box;
    double slack = 0.0;
    for (const Ball& ball : balls) {
      box.add(ball.center);
      slack = std::max(slack, ball.slack);
    }
    const double away = slack + 0.5 * box.diagonal() * (1.0 + kRounding);
    const NearTrees near = trees_within(trees, box.center(), limit_ + away);
    const double distance = capped_distance(near, box.center(), limit_ + away, limit_ - away);
    if (distance < limit_ - away) {
      std::fill(shares.begin(), shares.end(), 0.0);
    } else if (distance >= limit_ + away && all_checked_ && on_one_side(box.center(), away)) {
      std::fill(shares.begin(), shares.end(), buried(box.center()) ? 0.0 : 1.0);
    } else {
      const std::size_t half = balls.size() / 2;
      measure(balls.first(half), shares.first(half), near);
      measure(balls.subspan(half), shares.subspan(half), near);
    }
  }

  /// No surface of a solid is between the centres, all of them no farther than this from the middle: one is inside where all are.
  [[nodiscard]] bool on_one_side(const Vec3& middle, double away) const {
    // Closing triangles are off their faces by less than the ball's radius.
    const double clear = limit_ + away;
    return std::all_of(solids_.begin(), solids_.end(), [&](const std::shared_ptr<const ReadySolid>& solid) {
      return std::all_of(solid->surface.begin(), solid->surface.end(),
                         [&](const auto& tree) { return capped_distance(*tree, middle, clear, clear) >= clear; });
    });
  }

  /// Share of a cell that the ball can touch: 0 or 1 if the distance of its centre decides, else counted at places.
  [[nodiscard]] double share(const Ball& ball, const NearTrees& trees) const {
    const auto& [center, normal, area, slack] = ball;
    if (normal.isZero()) return 1.0;  // degenerate: such a cell has no area
    const double distance = capped_distance(trees, center, limit_ + slack, limit_ - slack);
    if (distance < limit_ - slack || buried(center)) return 0.0;
    if (distance >= limit_ + slack) return 1.0;
    // A triangle that holds any place of the cell is one of these.
    std::vector<TreeTriangle> near;
    for (const ObstacleTree* tree : trees) add_triangles_within(*tree, center, limit_ + slack, near);
    const Vec3 e1 = normal.unitOrthogonal(), e2 = normal.cross(e1);
    const double side = std::sqrt(area) / kPlaces;
    int free = 0;
    for (int i = 0; i < kPlaces; ++i) {
      const double a = (i + 0.5 - 0.5 * kPlaces) * side, b = ((i * kTurn) % kPlaces + 0.5 - 0.5 * kPlaces) * side;
      const Vec3 x = center + a * e1 + b * e2;
      if (!held_by(near, trees, x)) ++free;
    }
    return static_cast<double>(free) / kPlaces;
  }

  /// Whether the ball at x meets the surface, all of which that is near enough is listed.
  [[nodiscard]] bool held_by(const std::vector<TreeTriangle>& near, const NearTrees& trees, const Vec3& x) const {
    // Of many triangles the tree asks but a few.
    if (near.size() > kFewTriangles) return capped_distance(trees, x, limit_, limit_) < limit_;
    return std::any_of(near.begin(), near.end(),
                       [&](const TreeTriangle& t) { return triangle_distance(*t.tree, t.triangle, x) < limit_; });
  }

  [[nodiscard]] bool buried(const Vec3& x) const {
    return std::any_of(solids_.begin(), solids_.end(),
                       [&](const std::shared_ptr<const ReadySolid>& solid) { return solid->holds(x); });
  }

  double limit_;
  bool all_checked_;  ///< no face of a solid is there only to close it
  Trees surface_;     ///< one a face
  NearTrees all_;     ///< these
  NearTrees own_alone_;
  std::shared_ptr<const ObstacleTree> own_;
  std::vector<std::shared_ptr<const ReadySolid>> solids_;
};

void require_usable(const ReachOptions& options) {
  if (!(options.radius_mm > 0.0 && std::isfinite(options.radius_mm)))
    throw UsageError("reach: the radius must be > 0 mm");
  if (!(options.tolerance_mm > 0.0)) throw UsageError("reach: the tolerance must be > 0 mm");
}

}  // namespace

struct ReachScene::Data {
  double radius, tolerance;
  Surroundings around;
};

struct ReachFaces::Ready {
  std::shared_ptr<const ObstacleTree> tree;
  int solid = -1;
  bool checked = true;
};

struct ReachFaces::Solid : ReadySolid {};

ReachFaces::ReachFaces(const std::vector<ReachFace>& faces) : faces_(faces.size()) {
  parallel_for(faces.size(), [&](std::size_t k) {
    stop_here();
    const ReachFace& face = faces[k];
    faces_[k] =
        std::make_shared<const Ready>(Ready{std::make_shared<const ObstacleTree>(face.mesh), face.solid, face.checked});
  });
  std::map<int, std::vector<std::size_t>> solids;
  for (std::size_t k = 0; k < faces.size(); ++k)
    if (faces[k].solid >= 0) solids[faces[k].solid].push_back(k);
  for (const auto& [number, members] : solids) {
    const auto checked = [&](std::size_t k) { return faces[k].checked; };
    if (std::none_of(members.begin(), members.end(), checked)) continue;
    Solid solid{{number, {}, {}, std::all_of(members.begin(), members.end(), checked)}};
    for (const std::size_t k : members) {
      const TriangleMesh& closing = faces[k].closing.triangles.empty() ? faces[k].mesh : faces[k].closing;
      if (!closing.triangles.empty()) solid.box.add(closing.box());
      solid.surface.push_back(&closing == &faces[k].mesh ? faces_[k]->tree
                                                         : std::make_shared<const ObstacleTree>(closing));
      solid.faces.emplace_back(solid.surface.back());
    }
    solids_.push_back(std::make_shared<const Solid>(std::move(solid)));
  }
}

ReachScene::ReachScene(const ReachFaces& faces, std::size_t target, bool corners, const ReachOptions& options) {
  require_usable(options);
  Trees surface;
  std::vector<std::shared_ptr<const ReadySolid>> solids;
  bool all_checked = true;
  const bool is_one = target < faces.faces_.size();
  const int home = is_one ? faces.faces_[target]->solid : -1;
  for (std::size_t k = 0; k < faces.faces_.size(); ++k)
    if (k != target && faces.faces_[k]->checked) surface.push_back(faces.faces_[k]->tree);
  for (const std::shared_ptr<const ReachFaces::Solid>& solid : faces.solids_) {
    if (home >= 0 && solid->number == home) continue;
    solids.push_back(solid);
    all_checked = all_checked && solid->all_checked;
  }
  std::shared_ptr<const ObstacleTree> own =
      corners && is_one ? faces.faces_[target]->tree : std::make_shared<const ObstacleTree>();
  data_ = std::make_unique<const Data>(Data{options.radius_mm, options.tolerance_mm,
                                            Surroundings(std::move(surface), std::move(own), std::move(solids),
                                                         all_checked, options.radius_mm - options.tolerance_mm)});
}

ReachScene::ReachScene(const std::vector<ReachFace>& others, const TriangleMesh& own, const ReachOptions& options)
    : ReachScene(
          [&] {
            std::vector<ReachFace> all = others;
            all.push_back({own, -1, true});
            return ReachFaces(all);
          }(),
          others.size(), true, options) {}
ReachScene::~ReachScene() = default;
ReachScene::ReachScene(ReachScene&&) noexcept = default;

std::vector<double> ReachScene::shares(const FaceSamples& target) const {
  if (target.normals.size() != target.points.size()) throw InternalError("reach: the samples of a face need normals");
  std::vector<double> shares(target.points.size());
  parallel_blocks(shares.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    std::vector<Ball> balls(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      const double reach = target.reaches_mm.empty() ? target.spacing_mm : target.reaches_mm[i];
      const double bend = target.curvatures_per_mm.empty() ? 0.0 : data_->radius * target.curvatures_per_mm[i];
      const Vec3& n = target.normals[i];
      balls[i - begin] = {target.points[i] + data_->radius * n, n, target.areas[i], reach * (1.0 + bend)};
    }
    data_->around.measure(balls, std::span(shares).subspan(begin, end - begin));
    for (std::size_t i = begin; i < end; ++i)
      if (shares[i] > 0.0 && data_->around.in_a_corner(balls[i - begin])) shares[i] = 0.0;
  });
  return shares;
}

std::vector<double> ReachScene::largest_balls(const FaceSamples& target) const {
  if (target.normals.size() != target.points.size()) throw InternalError("reach: the samples of a face need normals");
  std::vector<double> radii(target.points.size());
  parallel_blocks(radii.size(), kLeastBlock, [&](std::size_t begin, std::size_t end) {
    stop_here();
    for (std::size_t i = begin; i < end; ++i)
      radii[i] = target.normals[i].isZero()
                     ? data_->radius
                     : data_->around.largest_ball(target.points[i], target.normals[i], data_->radius, data_->tolerance);
  });
  return radii;
}

std::vector<double> reachable_shares(const FaceSamples& target, const std::vector<ReachFace>& others,
                                     const ReachOptions& options) {
  return ReachScene(others, {}, options).shares(target);
}

int side_of_tool(const Tool& tool, const Path& path, const FaceSamples& sheet) {
  return side_votes(SweptVolume(tool, path), path, sheet, 0.5 * smallest_radius(tool)).side();
}

}  // namespace flank::internal
