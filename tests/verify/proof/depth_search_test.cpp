// The proof against a slow search that shares nothing with it but the evaluation of surface, curve and radius: every sphere of
// the tool at every place of a dense net gives a depth that the face is surely cut to, and none may exceed the bound.
#include "flank/verify/proof/depth_search.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <functional>

#include "flank/error.h"
#include "flank/threads.h"
#include "flank/verify/proof/face_shape.h"
#include "flank/verify/proof/mesh_shape.h"
#include "sanitized.h"
#include "verify/brute_force.h"
#include "verify/faces.h"

namespace flank::internal::verify {
namespace {

/// A curve of places on the face: the whole of it is swept by two parameters, a border by one.
struct Places {
  int parameters = 2;
  std::function<Vec3(double, double)> at;
  std::function<bool(double, double)> holds;
};

/// Even-odd over a polyline, on its own.
bool inside(const std::vector<Vec2>& polygon, double u, double v) {
  bool in = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2 &a = polygon[i], &b = polygon[j];
    if ((a.y() > v) != (b.y() > v) && u < a.x() + (v - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) in = !in;
  }
  return in;
}

std::vector<Places> places_of(const Face& face) {
  const BSplineSurface& s = face.surface;
  std::vector<std::vector<Vec2>> polygons;
  std::vector<Places> out;
  for (const TrimLoop& loop : face.loops) {
    polygons.emplace_back();
    for (const BSplineCurve2& edge : loop.edges) {
      for (int i = 0; i < 400; ++i) polygons.back().push_back(edge.value(i / 400.0));
      out.push_back({1,
                     [&s, &edge](double t, double) {
                       const Vec2 p = edge.value(t);
                       return s.value(p.x(), p.y());
                     },
                     [](double, double) { return true; }});
    }
  }
  const auto holds = [polygons](double u, double v) {
    bool in = polygons.empty();
    for (const auto& polygon : polygons) in ^= inside(polygon, u, v);
    return in;
  };
  out.push_back({2, [&s](double u, double v) { return s.value(u, v); }, holds});
  if (face.loops.empty())
    for (int k = 0; k < 4; ++k)
      out.push_back({1, [&s, k](double t, double) { return k < 2 ? s.value(t, k) : s.value(k - 2, t); },
                     [](double, double) { return true; }});
  return out;
}

/// One place of face and path: two parameters of the face, pose + fraction, s.
using Spot = std::array<double, 4>;

class Brute {
 public:
  Brute(const Tool& tool, const Strip& strip, const Places& places) : tool_(tool), strip_(strip), places_(places) {}

  /// Depth by the sphere of a spot; nothing off the face.
  [[nodiscard]] double depth(const Spot& x) const {
    if (!places_.holds(x[0], x[1])) return -1e300;
    return -brute::sphere_distance(tool_.radial, places_.at(x[0], x[1]), pose(x[2]), x[3]);
  }

  /// The deepest spot of a net, and of a walk with ever shorter steps from the best of it.
  [[nodiscard]] double deepest() const {
    const auto last = static_cast<double>(strip_.poses.size() - 1);
    const Spot high{1.0, places_.parameters == 2 ? 1.0 : 0.0, last, tool_.radial.axis_length()};
    const int nu = places_.parameters == 2 ? 16 : 80, nv = places_.parameters == 2 ? 16 : 0;
    const int nt = static_cast<int>(last) * 2, ns = 12;
    std::vector<Pose> poses;
    for (int t = 0; t <= nt; ++t) poses.push_back(pose(nt > 0 ? last * t / nt : 0.0));
    std::vector<std::pair<double, Spot>> best;
    for (int i = 0; i <= nu; ++i) {
      for (int j = 0; j <= nv; ++j) {
        const double u = 1.0 * i / nu, v = nv > 0 ? 1.0 * j / nv : 0.0;
        std::pair<double, Spot> here{-1e300, {}};
        if (places_.holds(u, v)) {
          const Vec3 place = places_.at(u, v);
          for (int t = 0; t <= nt; ++t) {
            for (int k = 0; k <= ns; ++k) {
              const Spot x{u, v, nt > 0 ? last * t / nt : 0.0, high[3] * k / ns};
              const double d = -brute::sphere_distance(tool_.radial, place, poses[static_cast<std::size_t>(t)], x[3]);
              if (d > here.first) here = {d, x};
            }
          }
        }
        best.push_back(here);
      }
    }
    std::sort(best.begin(), best.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    double most = best[0].first;
    for (std::size_t k = 0; k < std::min<std::size_t>(6, best.size()); ++k)
      most = std::max(
          most, walk(best[k].second, best[k].first, high, {1.0 / nu, nv > 0 ? 1.0 / nv : 0.0, 0.5, high[3] / ns}));
    return most;
  }

 private:
  [[nodiscard]] Pose pose(double t) const {
    const auto last = static_cast<double>(strip_.poses.size() - 1);
    const auto k = static_cast<std::size_t>(std::min(std::floor(t), std::max(0.0, last - 1.0)));
    return brute::between(strip_.poses[k], strip_.poses[std::min(k + 1, strip_.poses.size() - 1)],
                          t - static_cast<double>(k));
  }

  [[nodiscard]] double walk(Spot x, double d, const Spot& high, Spot step) const {
    for (int round = 0; round < 34; ++round) {
      bool better = true;
      for (int hop = 0; hop < 20 && better; ++hop) {
        better = false;
        for (std::size_t k = 0; k < 4; ++k) {
          for (double by : {-step[k], step[k]}) {
            Spot next = x;
            next[k] = std::clamp(x[k] + by, 0.0, high[k]);
            if (const double value = depth(next); value > d) x = next, d = value, better = true;
          }
        }
      }
      for (double& s : step) s *= 0.6;
    }
    return d;
  }

  const Tool& tool_;
  const Strip& strip_;
  const Places& places_;
};

double brute_depth(const Tool& tool, const Path& path, const Face& face) {
  double most = 0.0;
  for (const Places& places : places_of(face))
    for (const Strip& strip : path.strips) most = std::max(most, Brute(tool, strip, places).deepest());
  return most;
}

/// A bent patch of about 10 x 8 mm over [0, 1]^2; trimmed by a triangle, by a circle, or not.
Face random_face(Random& random) {
  Face face;
  face.id = "F1";
  BSplineSurface& s = face.surface;
  s.degree_u = 3, s.degree_v = 2;
  const bool kinked = random.uniform(0.0, 1.0) < 0.3;
  s.knots_u = kinked ? std::vector<double>{0, 0, 0, 0, 0.4, 0.4, 0.4, 1, 1, 1, 1}
                     : std::vector<double>{0, 0, 0, 0, 0.3, 0.6, 0.6, 1, 1, 1, 1};
  s.knots_v = {0, 0, 0, 0.5, 1, 1, 1};
  s.count_u = 7, s.count_v = 4;
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 4; ++j)
      s.poles.push_back(Vec3(10.0 * i / 6, 8.0 * j / 3, 0.0) + brute::random_vector(random, 0.35));
  if (random.uniform(0.0, 1.0) < 0.4)
    for (std::size_t k = 0; k < s.poles.size(); ++k) s.weights.push_back(random.uniform(0.7, 1.4));
  const double trims = random.uniform(0.0, 1.0);
  if (trims < 0.3)
    face.loops = {test::polygon({{0.1, 0.1}, {0.95, 0.2}, {0.4, 0.9}})};
  else if (trims < 0.6)
    face.loops = {test::circle({0.5, 0.5}, 0.42), test::circle({0.55, 0.4}, 0.1)};
  return face;
}

/// A pass beside the face, then something wrong with it.
Path random_path(Random& random, const Face& face, double radius, double length) {
  const auto chance = [&] { return random.uniform(0.0, 1.0); };
  Strip strip;
  const double lift = radius + random.uniform(-0.03, 0.6);
  for (int i = 0; i < 7; ++i) {
    const Vec3 p = face.surface.value(i / 6.0, 0.5);
    strip.poses.push_back({p + Vec3(0.0, -0.5 * length, lift), Vec3::UnitY()});
  }
  auto& poses = strip.poses;
  const auto k = static_cast<std::size_t>(random.uniform(0.0, 6.99));
  const double kind = chance();
  if (kind < 0.2)
    for (Pose& p : poses) p.tip += brute::random_vector(random, 0.1);
  else if (kind < 0.4)
    poses[k].axis = (poses[k].axis + brute::random_vector(random, 0.1)).normalized();
  else if (kind < 0.5)
    poses.erase(poses.begin() + static_cast<std::ptrdiff_t>(k));
  else if (kind < 0.6)
    std::swap(poses[k], poses[(k + 2) % 7]);
  Path path{{strip}};
  if (kind >= 0.6) {
    // A thin cut: a stroke that comes from outside and enters by a micrometre to a tenth at a place of a border.
    const std::vector<Places> all = places_of(face);
    std::vector<const Places*> borders;
    for (const Places& p : all)
      if (p.parameters == 1) borders.push_back(&p);
    const Places& border = *borders[static_cast<std::size_t>(chance() * 0.999 * static_cast<double>(borders.size()))];
    const Vec3 at = border.at(chance() < 0.3 ? std::round(chance()) : chance(), 0.0);
    const double depth = std::pow(10.0, random.uniform(-3.0, -1.0));
    const Vec3 away = brute::random_unit(random), axis = away.unitOrthogonal();
    Strip cut;
    for (int i = 0; i < 3; ++i) {
      const Vec3 tip = at + (radius - depth) * away - random.uniform(0.2, 0.8) * length * axis +
                       0.4 * (i - 1) * away.cross(axis) + 0.05 * (1 - i) * (i - 1) * away;
      cut.poses.push_back({tip, axis});
    }
    for (Pose& p : path.strips[0].poses) p.tip.z() += 1.0;
    path.strips.push_back(cut);
  }
  return path;
}

int trial_count() {
  const char* asked = std::getenv("FLANK_PROOF_TRIALS");
  return asked != nullptr ? std::atoi(asked) : kSanitized ? 8 : 60;
}

DepthLimits usual_limits() { return {0.01, 0.0002, 400000, 200000}; }

TEST(DepthSearch, NothingIsDeeperThanTheBoundOnMutatedPaths) {
  int found = 0, tight = 0;
  for (int trial = 0; trial < trial_count(); ++trial) {
    Random random(static_cast<std::uint64_t>(7001 + trial));
    const Face face = random_face(random);
    const double length = 12.0;
    const Tool tool = brute::random_tool(random, length);
    const Path path = random_path(random, face, smallest_radius(tool), length);
    const SweptVolume volume(tool, path);
    const ProvedDepth proved = search_depth(volume, smallest_radius(tool), *make_shape(face), 0.0, usual_limits());
    const double brute = brute_depth(tool, path, face);
    EXPECT_LE(brute, proved.bound_mm + 1e-7) << "trial " << trial << ": found " << proved.deepest_mm;
    EXPECT_FALSE(proved.exhausted) << "trial " << trial << ": bound " << proved.bound_mm;
    if (proved.deepest_mm > 0.0) {
      ++found;
      EXPECT_NEAR(volume.distance(proved.point).f, -proved.deepest_mm, 1e-8);
    }
    tight += proved.bound_mm - proved.deepest_mm <= 0.0002 ? 1 : 0;
  }
  EXPECT_GE(4 * found, trial_count()) << "most paths are meant to cut";
  EXPECT_GE(3 * tight, trial_count()) << "the bound is to be near what was found, where that costs little";
}

/// A ball-ended stick that dips into the plane y = 0 by `depth` at (x, z), and stands above it elsewhere.
Path dip(double x, double z, double depth, double radius) {
  return {{{1, "flank", "", {{Vec3(x, radius - depth, z), Vec3::UnitY()}}}}};
}

Tool stick(double radius) {
  Tool tool;
  tool.radial = RadialFunction::spline(10.0, Eigen::VectorXd::Constant(6, radius));
  return tool;
}

void expect_depth(const Shape& shape, const Path& path, double depth, const char* where) {
  const Tool tool = stick(1.0);
  const SweptVolume volume(tool, path);
  const ProvedDepth proved = search_depth(volume, smallest_radius(tool), shape, 0.0, usual_limits());
  EXPECT_LE(proved.deepest_mm, depth + 1e-9) << where;
  EXPECT_GE(proved.bound_mm, depth - 1e-9) << where;
  EXPECT_LT(proved.bound_mm - proved.deepest_mm, 0.0003) << where;
}

TEST(DepthSearch, CutsOfMicrometresAtBordersEdgesAndCornersAreFound) {
  const Face plane = test::plane_face("F1", 40.0, 20.0);
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {40, 0, 0}, {40, 0, 20}, {0, 0, 20}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const auto face = make_shape(plane), triangles = make_shape(mesh);
  for (double depth : {0.001, 0.005, 0.03}) {
    for (const Shape* shape : {face.get(), triangles.get()}) {
      expect_depth(*shape, dip(13.7, 7.1, depth, 1.0), depth, "inside");
      expect_depth(*shape, dip(20.0, 10.0, depth, 1.0), depth, "on the diagonal");
      expect_depth(*shape, dip(0.0, 3.3, depth, 1.0), depth, "on a border");
      expect_depth(*shape, dip(40.0, 20.0, depth, 1.0), depth, "on a corner");
      // Beside the face: the ball's side reaches over the border by a little.
      const double away = 0.5;
      const double beside = 1.0 - std::hypot(away, 1.0 - depth - 0.2);
      expect_depth(*shape, dip(-away, 3.3, depth + 0.2, 1.0), std::max(0.0, beside), "from beyond a border");
    }
  }
}

TEST(DepthSearch, AHoleIsNotCut) {
  Face face = test::plane_face("F1", 40.0, 20.0);
  face.loops = {test::polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), test::circle({0.5, 0.5}, 0.2)};
  // The circle is an ellipse of 8 by 4 mm in space.
  const Tool tool = stick(1.0);
  const SweptVolume volume(tool, dip(20.0, 10.0, 0.9, 1.0));
  const ProvedDepth proved = search_depth(volume, 1.0, *make_shape(face), 0.0, usual_limits());
  EXPECT_EQ(proved.deepest_mm, 0.0);
  EXPECT_LE(proved.bound_mm, 0.01);
  expect_depth(*make_shape(face), dip(28.0, 10.0, 0.02, 1.0), 0.02, "on the border of the hole");
}

TEST(DepthSearch, WhatTheLimitsForbidIsNotProved) {
  Random random(5);
  const Face face = random_face(random);
  const Tool tool = stick(1.0);
  const SweptVolume volume(tool, random_path(random, face, 1.0, 10.0));
  DepthLimits limits = usual_limits();
  limits.tolerance_mm = 1e-9;
  limits.evaluations = 100;
  const ProvedDepth proved = search_depth(volume, 1.0, *make_shape(face), 0.0, limits);
  EXPECT_TRUE(proved.exhausted || proved.deepest_mm > limits.tolerance_mm);
  EXPECT_LT(proved.evaluations, 1000u);
}

TEST(DepthSearch, WhatIsKnownBeforeSparesNoDeeperPlace) {
  const Face plane = test::plane_face("F1", 40.0, 20.0);
  const auto shape = make_shape(plane);
  Path path = dip(13.7, 7.1, 0.004, 1.0);
  path.strips.push_back(dip(30.3, 12.9, 0.009, 1.0).strips[0]);
  const Tool tool = stick(1.0);
  const SweptVolume volume(tool, path);
  for (const double known : {0.0, 0.004, 0.0089}) {
    const ProvedDepth proved = search_depth(volume, 1.0, *shape, known, usual_limits());
    EXPECT_GE(proved.bound_mm, 0.009 - 1e-9) << known;
    EXPECT_LE(proved.bound_mm, 0.0095) << known;
    EXPECT_FALSE(proved.exhausted);
  }
}

TEST(DepthSearch, SameBitsForOneAndTwoThreads) {
  Random random(7003);
  const Face face = random_face(random);
  const Tool tool = brute::random_tool(random, 12.0);
  const SweptVolume volume(tool, random_path(random, face, smallest_radius(tool), 12.0));
  std::vector<ProvedDepth> proved;
  for (int threads : {1, 2}) {
    set_thread_count(threads);
    proved.push_back(search_depth(volume, smallest_radius(tool), *make_shape(face), 0.0, usual_limits()));
  }
  set_thread_count(0);
  EXPECT_EQ(proved[0].deepest_mm, proved[1].deepest_mm);
  EXPECT_EQ(proved[0].bound_mm, proved[1].bound_mm);
  EXPECT_EQ(proved[0].evaluations, proved[1].evaluations);
}

}  // namespace
}  // namespace flank::internal::verify
