#include "flank/radial_function.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "flank/base/random.h"
#include "flank/bspline_basis.h"
#include "flank/error.h"
#include "flank/tool.h"

namespace flank::internal {
namespace {

constexpr double kLength = 20.0;

Eigen::VectorXd values(std::initializer_list<double> list) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(list.size()));
  int i = 0;
  for (const double x : list) v[i++] = x;
  return v;
}

/// One legitimate tool of every family, and some at the edges of their formulas.
std::vector<RadialFunction> tools() {
  return {{ToolFamily::kCylinder, kLength, values({4.0})},
          {ToolFamily::kCone, kLength, values({2.0, 0.05})},
          {ToolFamily::kBarrel, kLength, values({85.0, 5.0, 8.0})},
          {ToolFamily::kBarrel, kLength, values({-60.0, 5.0, 8.0})},
          {ToolFamily::kLens, kLength, values({5.0, 4.2})},
          {ToolFamily::kLens, kLength, values({4.2, 4.2})},
          {ToolFamily::kLens, kLength, values({4.2, 5.0})},
          {ToolFamily::kTaperedBarrel, kLength, values({250.0, 5.0, 0.2})},
          {ToolFamily::kHyperbolic, kLength, values({3.0, 0.02, 0.004})},
          {ToolFamily::kPower, kLength, values({8.0, 1.5, 1.2, 2.3})},
          RadialFunction::spline(kLength, values({3.0, 3.3, 3.9, 4.2, 4.4, 4.1, 4.6, 5.0})),
          RadialFunction::spline(kLength, values({3.0, 3.3, 3.9, 4.2})),
          RadialFunction::spline(kLength, values({3.0, 3.3, 3.9, 4.2, 4.1}))};
}

TEST(RadialFunction, DerivativesMatchFiniteDifferences) {
  for (const RadialFunction& f : tools()) {
    for (double s = 0.13; s < kLength; s += 0.77) {
      const double h = 1e-4;
      const RadialJet a = f.at(s - h), b = f.at(s), c = f.at(s + h);
      EXPECT_NEAR(b.d1, (c.r - a.r) / (2.0 * h), 1e-9) << family_name(f.family()) << " s = " << s;
      EXPECT_NEAR(b.d2, (c.d1 - a.d1) / (2.0 * h), 1e-9) << family_name(f.family()) << " s = " << s;
    }
  }
}

TEST(RadialFunction, GradientMatchesFiniteDifferences) {
  for (const RadialFunction& f : tools()) {
    std::vector<double> gradient(static_cast<std::size_t>(f.parameter_count()));
    for (double s = 0.0; s <= kLength; s += 0.77) {
      f.gradient(s, gradient.data());
      for (int k = 0; k < f.parameter_count(); ++k) {
        const double h = 1e-5 * std::max(1.0, std::abs(f.parameters()[k]));
        Eigen::VectorXd up = f.parameters(), down = up;
        up[k] += h;
        down[k] -= h;
        const double difference = (f.with_parameters(up).at(s).r - f.with_parameters(down).at(s).r) / (2.0 * h);
        EXPECT_NEAR(gradient[static_cast<std::size_t>(k)], difference, 1e-8 * (1.0 + std::abs(difference)))
            << family_name(f.family()) << " parameter " << k << " s = " << s;
      }
    }
  }
}

TEST(RadialFunction, ActiveGradientIsTheGradientWhereItIsNotZero) {
  for (const RadialFunction& f : tools()) {
    std::vector<double> all(static_cast<std::size_t>(f.parameter_count())),
        active(static_cast<std::size_t>(f.active_count()));
    for (double s = 0.0; s <= kLength; s += 0.5) {
      f.gradient(s, all.data());
      f.active_gradient(s, active.data());
      const int first = f.first_active(s);
      for (int k = 0; k < f.parameter_count(); ++k) {
        const bool is_active = k >= first && k < first + f.active_count();
        EXPECT_EQ(all[static_cast<std::size_t>(k)], is_active ? active[static_cast<std::size_t>(k - first)] : 0.0);
      }
    }
  }
}

/// The spline's own fast basis against the general one of geom, derivatives and extrapolation included.
TEST(RadialFunction, SplineIsTheClampedUniformBSpline) {
  Random random(7);
  for (const int count : {4, 5, 6, 7, 8, 9, 24, 101}) {
    Eigen::VectorXd c(count);
    for (int i = 0; i < count; ++i) c[i] = random.uniform(2.0, 5.0);
    const RadialFunction f = RadialFunction::spline(kLength, c);
    const std::vector<double> knots = uniform_knots(3, count, 0.0, kLength);
    for (int i = -3; i <= 203; ++i) {
      const double s = kLength * i / 200.0;
      const int span = find_span(3, knots, s);
      std::array<double, 3 * (kMaxDegree + 1)> n;
      basis_derivatives(3, knots, span, s, 2, n.data());
      RadialJet expected;
      for (int j = 0; j < 4; ++j) {
        expected.r += n[j] * c[span - 3 + j];
        expected.d1 += n[4 + j] * c[span - 3 + j];
        expected.d2 += n[8 + j] * c[span - 3 + j];
      }
      const RadialJet jet = f.at(s);
      const double h = kLength / (count - 3);
      EXPECT_NEAR(jet.r, expected.r, 1e-11) << count << " " << s;
      EXPECT_NEAR(jet.d1, expected.d1, 1e-11 / h) << count << " " << s;
      // At a knot both sides' spans are right up to round-off in r and r', and r'' is continuous.
      EXPECT_NEAR(jet.d2, expected.d2, 1e-9 / (h * h)) << count << " " << s;
    }
  }
}

TEST(RadialFunction, LeastSquaresSplineReproducesItsOwnSamples) {
  const RadialFunction truth = tools()[10];
  std::vector<Vec2> samples;
  for (int i = 0; i <= 200; ++i) samples.emplace_back(kLength * i / 200.0, truth.at(kLength * i / 200.0).r);
  const RadialFunction fitted = RadialFunction::spline_through(kLength, samples, 8);
  EXPECT_LT((fitted.parameters() - truth.parameters()).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(RadialFunction, LeastSquaresSplineContinuesWhereThereAreNoSamples) {
  std::vector<Vec2> samples;
  for (int i = 0; i <= 50; ++i) samples.emplace_back(kLength * i / 100.0, 2.0 + 0.1 * kLength * i / 100.0);
  const RadialFunction fitted = RadialFunction::spline_through(kLength, samples, 24);
  for (double s = 0.0; s <= kLength; s += 0.5) EXPECT_TRUE(std::isfinite(fitted.at(s).r));
  EXPECT_NEAR(fitted.at(5.0).r, 2.5, 1e-12);
  EXPECT_NEAR(fitted.at(kLength).r, 4.0, 1e-3);
}

TEST(RadialFunction, BarrelIsTheFormulaOfItsArc) {
  const RadialFunction f = tools()[2];
  for (double s = 0.0; s <= kLength; s += 1.0) EXPECT_NEAR(f.at(s).r, 85.0 - std::hypot(80.0, s - 8.0), 1e-12);
}

TEST(RadialFunction, LensHasItsRadiiAtTheMiddleAndTheEnds) {
  for (const int k : {4, 5, 6}) {
    const RadialFunction f = tools()[static_cast<std::size_t>(k)];
    EXPECT_DOUBLE_EQ(f.at(0.5 * kLength).r, f.parameters()[0]);
    EXPECT_DOUBLE_EQ(f.at(0.0).r, f.parameters()[1]);
    EXPECT_DOUBLE_EQ(f.at(kLength).r, f.parameters()[1]);
  }
}

TEST(RadialFunction, TaperedBarrelWithoutTaperIsABarrelAndWithAHugeArcACone) {
  const RadialFunction straight(ToolFamily::kTaperedBarrel, kLength, values({85.0, 5.0, 0.0}));
  const RadialFunction barrel(ToolFamily::kBarrel, kLength, values({85.0, 5.0, 10.0}));
  const RadialFunction flat(ToolFamily::kTaperedBarrel, kLength, values({1e13, 5.0, 0.05}));
  const RadialFunction cone(ToolFamily::kCone, kLength, values({5.0 - 10.0 * std::sin(0.05), 0.05}));
  for (double s = 0.0; s <= kLength; s += 1.0) {
    EXPECT_NEAR(straight.at(s).r, barrel.at(s).r, 1e-13);
    EXPECT_NEAR(flat.at(s).r, cone.at(s).r, 1e-10);
  }
}

TEST(RadialFunction, NamesGoBothWays) {
  for (const ToolFamily family : kToolFamilies) {
    ASSERT_TRUE(family_from_name(family_name(family)));
    EXPECT_EQ(*family_from_name(family_name(family)), family);
    EXPECT_EQ(parameter_names(family).empty(), family == ToolFamily::kSpline);
  }
  EXPECT_FALSE(family_from_name("ball"));
  EXPECT_TRUE(parameter_is_angle(ToolFamily::kCone, 1));
  EXPECT_FALSE(parameter_is_angle(ToolFamily::kCone, 0));
  EXPECT_FALSE(parameter_is_angle(ToolFamily::kSpline, -1));
}

TEST(RadialFunction, WrongUseIsRefused) {
  EXPECT_THROW(RadialFunction(ToolFamily::kCone, kLength, values({1.0})), InternalError);
  EXPECT_THROW(RadialFunction(ToolFamily::kCylinder, 0.0, values({1.0})), InternalError);
  EXPECT_THROW((void)RadialFunction::spline(kLength, values({1.0, 1.0, 1.0})), InternalError);
}

}  // namespace
}  // namespace flank::internal
