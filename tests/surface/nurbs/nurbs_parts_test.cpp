/// Cold footpoints on every face of real parts against dense search: of files of FLANK_DATA, and of generated ones. FLANK_TEST_POINTS sets how many points a part
/// gets.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "flank/geom/trim.h"
#include "flank/part.h"
#include "flank/target.h"
#include "rotor37_file.h"
#include "sanitized.h"
#include "shared_data.h"
#include "surface/nurbs_fixtures.h"

namespace flank::internal {
namespace {

using namespace test;

/// Dense search on a trimmed face that shares nothing with the target: the loops as fine polylines, a grid of interior
/// points, the points of the borders; the best of each polished on the surface's own evaluation.
class DenseFace {
 public:
  explicit DenseFace(const Face& face)
      : s_(face.surface),
        untrimmed_(TrimRegion(face.loops, {s_.u_first(), s_.u_last(), s_.v_first(), s_.v_last()}).whole()) {
    for (const TrimLoop& loop : untrimmed_ ? std::vector<TrimLoop>{whole()} : face.loops)
      for (const BSplineCurve2& edge : loop.edges) add_edge(edge);
    const double u0 = s_.u_first(), u1 = s_.u_last(), v0 = s_.v_first(), v1 = s_.v_last();
    const int nu = std::clamp(4 * s_.count_u, 40, 100), nv = std::clamp(4 * s_.count_v, 40, 100);
    hu_ = (u1 - u0) / nu;
    hv_ = (v1 - v0) / nv;
    for (int i = 0; i <= nu; ++i)
      for (int j = 0; j <= nv; ++j) {
        const double u = u0 + hu_ * i, v = v0 + hv_ * j;
        if (untrimmed_ || inside(u, v)) interior_.push_back({s_.value(u, v), u, v});
      }
    for (const Sample& x : interior_) box_.add(x.point);
    for (const Sample& x : border_) box_.add(x.point);
  }

  [[nodiscard]] const Box3& box() const { return box_; }

  [[nodiscard]] double distance(const Vec3& p) const {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t k : nearest(interior_, p, 4)) best = std::min(best, polish_interior(interior_[k], p));
    for (std::size_t k : nearest(border_, p, 4)) best = std::min(best, polish_border(border_[k], p));
    return std::sqrt(best);
  }

 private:
  struct Sample {
    Vec3 point;
    double u = 0, v = 0, t = 0, step = 0;
    std::size_t edge = 0;
  };

  TrimLoop whole() const { return rectangle_loop({s_.u_first(), s_.u_last(), s_.v_first(), s_.v_last()}); }

  Vec3 on_edge(std::size_t edge, double t) const {
    const Vec2 c = edges_[edge].value(t);
    return s_.value(c[0], c[1]);
  }

  void add_edge(const BSplineCurve2& edge) {
    edges_.push_back(edge);
    const int count = edge.degree == 1 && edge.count() == 2 ? 64 : std::clamp(8 * edge.count(), 128, 600);
    for (int k = 0; k <= count; ++k) {
      const double step = (edge.last() - edge.first()) / count, t = edge.first() + step * k;
      const Vec2 c = edge.value(t);
      if (k > 0) segments_.emplace_back(last_, c);
      last_ = c;
      border_.push_back({on_edge(edges_.size() - 1, t), c[0], c[1], t, step, edges_.size() - 1});
    }
  }

  /// Inside, and not so near to a loop or to the surface's border that the polyline could be wrong about it.
  [[nodiscard]] bool inside(double u, double v) const {
    bool odd = false;
    const Vec2 size(s_.u_last() - s_.u_first(), s_.v_last() - s_.v_first()), q(u, v);
    const Vec2 share = (q - Vec2(s_.u_first(), s_.v_first())).cwiseQuotient(size);
    if (share.minCoeff() < 1e-4 || share.maxCoeff() > 1 - 1e-4) return false;
    for (const auto& [a, b] : segments_) {
      if ((a[1] > v) != (b[1] > v) && u < a[0] + (b[0] - a[0]) * (v - a[1]) / (b[1] - a[1])) odd = !odd;
      const Vec2 d = (b - a).cwiseQuotient(size), r = (q - a).cwiseQuotient(size);
      const double t = d.squaredNorm() > 0 ? std::clamp(r.dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
      if ((r - t * d).norm() < 1e-4) return false;
    }
    return odd;
  }

  static std::vector<std::size_t> nearest(const std::vector<Sample>& samples, const Vec3& p, std::size_t count) {
    std::vector<std::pair<double, std::size_t>> best;
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const double d = (samples[k].point - p).squaredNorm();
      if (best.size() == count && d >= best.back().first) continue;
      if (best.size() == count) best.pop_back();
      best.insert(std::upper_bound(best.begin(), best.end(), std::pair(d, k)), {d, k});
    }
    std::vector<std::size_t> result;
    for (const auto& [d, k] : best) result.push_back(k);
    return result;
  }

  double polish_interior(const Sample& start, const Vec3& p) const {
    const double first = (start.point - p).squaredNorm();
    double u = start.u, v = start.v, best = first;
    for (double hu = hu_, hv = hv_; hu > 1e-12 * (s_.u_last() - s_.u_first());) {
      double next = best, nu = u, nv = v;
      for (int a = -1; a <= 1; ++a)
        for (int b = -1; b <= 1; ++b) {
          const double x = std::clamp(u + a * hu, s_.u_first(), s_.u_last()),
                       y = std::clamp(v + b * hv, s_.v_first(), s_.v_last());
          const double d = (s_.value(x, y) - p).squaredNorm();
          if (d < next) {
            next = d;
            nu = x;
            nv = y;
          }
        }
      if (next < best) {
        best = next;
        u = nu;
        v = nv;
      } else {
        hu *= 0.5;
        hv *= 0.5;
      }
    }
    return untrimmed_ || inside(u, v) ? best : first;
  }

  double polish_border(const Sample& start, const Vec3& p) const {
    const BSplineCurve2& edge = edges_[start.edge];
    double t = start.t, best = (start.point - p).squaredNorm();
    for (double h = start.step; h > 1e-13 * (edge.last() - edge.first());) {
      bool moved = false;
      for (double x : {std::max(t - h, edge.first()), std::min(t + h, edge.last())}) {
        const double d = (on_edge(start.edge, x) - p).squaredNorm();
        if (d < best) {
          best = d;
          t = x;
          moved = true;
        }
      }
      if (!moved) h *= 0.5;
    }
    return best;
  }

  const BSplineSurface& s_;
  const bool untrimmed_;
  std::vector<BSplineCurve2> edges_;
  std::vector<std::pair<Vec2, Vec2>> segments_;
  std::vector<Sample> interior_, border_;
  Vec2 last_ = Vec2::Zero();
  double hu_ = 0, hv_ = 0;
  Box3 box_;
};

/// A point in front of or behind the face, as a tool's axis is.
Vec3 beside(Random& random, const std::vector<SurfaceSample>& samples) {
  const SurfaceSample& s = samples[static_cast<std::size_t>(random.uniform() * static_cast<double>(samples.size()))];
  return s.point + random.uniform(-5, 5) * s.normal;
}

constexpr std::array<double, 4> kMargins{0.05, 0.5, 3.0, 0.0};  ///< of the box that points are drawn from

int points_a_part() {
  const char* text = std::getenv("FLANK_TEST_POINTS");
  return text != nullptr ? std::atoi(text) : few_if_sanitized(200);
}

/// "rotor37..." is generated, everything else lies in FLANK_DATA.
std::string file_of(const std::string& name) {
  if (name.starts_with("rotor37")) return rotor37_file(name);
  return shared_data(name);
}

class NurbsParts : public ::testing::TestWithParam<const char*> {};

TEST_P(NurbsParts, ColdFootpointsMatchDenseSearchOnEveryFace) {
  const std::string file = file_of(GetParam());
  if (file.empty()) GTEST_SKIP() << "FLANK_DATA has no " << GetParam();
  const Part part = read_part(file);
  if (kSanitized && part.faces.size() > 12) GTEST_SKIP() << "the same code on more faces";
  const int each = std::max(1, points_a_part() / std::max(1, static_cast<int>(part.faces.size())));
  Random random(101);
  int borders = 0, extensions = 0, points = 0;
  for (const Face& face : part.faces) {
    const auto target = make_target(std::vector<Face>{face});
    const DenseFace dense(face);
    const std::vector<SurfaceSample> samples = target->samples(target->diagonal() / 50);
    EXPECT_NEAR(target->diagonal() / dense.box().diagonal(), 1, 2e-2) << face.id;
    for (int k = 0; k < each; ++k, ++points) {
      const Vec3 p = k % 4 == 3 ? beside(random, samples)
                                : random_in(random, target->box(), kMargins[static_cast<std::size_t>(k % 4)]);
      const Footpoint f = target->closest(p);
      borders += f.location == Location::kBorder;
      const double excess = std::abs(f.distance) - dense.distance(p);
      EXPECT_LT(excess, 1e-9 * target->diagonal()) << face.id << " at " << p.transpose() << ", point " << k;
      EXPECT_NEAR(std::abs(f.distance), (f.point - p).norm(), 1e-9 * (p - f.point).norm() + 1e-12) << face.id;
      EXPECT_LT((face.surface.value(f.u, f.v) - f.point).norm(), 1e-9 * target->diagonal()) << face.id;
      const Footpoint warm = target->track(p, f);
      extensions += warm.location != Location::kInside;
      if (f.location == Location::kInside) {
        EXPECT_LT(std::abs(warm.distance), std::abs(f.distance) + 1e-9 * target->diagonal()) << face.id;
      }
    }
  }
  std::printf("%s: %d points, %d on borders, %d warm ones past them\n", GetParam(), points, borders, extensions);
}

INSTANTIATE_TEST_SUITE_P(Files, NurbsParts,
                         ::testing::Values("rotor37", "rotor37-blisk", "kj66_impeller.step",
                                           "bladex_propeller_shaft.iges"));

}  // namespace
}  // namespace flank::internal
