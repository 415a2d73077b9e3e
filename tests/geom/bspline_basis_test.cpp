// B-spline basis functions against their recursive definition, and what every basis has.
#include "flank/bspline_basis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

constexpr int kMostOrder = 4;
using Values = std::array<double, (kMostOrder + 1) * (kMaxDegree + 1)>;

/// Cox and de Boor, straight from the definition; 0 / 0 counts as 0. The last non-empty span is closed on the right.
double recursive(int i, int degree, const std::vector<double>& t, double u) {
  const auto k = static_cast<std::size_t>(i), p = static_cast<std::size_t>(degree);
  if (degree == 0) {
    const bool last = t[k] < t[k + 1] && t[k + 1] == t.back();
    return (t[k] <= u && u < t[k + 1]) || (last && u == t.back()) ? 1.0 : 0.0;
  }
  const double left = t[k + p] - t[k], right = t[k + p + 1] - t[k + 1];
  return (left > 0.0 ? (u - t[k]) / left * recursive(i, degree - 1, t, u) : 0.0) +
         (right > 0.0 ? (t[k + p + 1] - u) / right * recursive(i + 1, degree - 1, t, u) : 0.0);
}

/// Derivative of order `order` by the recursion of the derivatives.
double recursive_derivative(int i, int degree, const std::vector<double>& t, double u, int order) {
  if (order == 0) return recursive(i, degree, t, u);
  if (degree == 0) return 0.0;
  const auto k = static_cast<std::size_t>(i), p = static_cast<std::size_t>(degree);
  const double left = t[k + p] - t[k], right = t[k + p + 1] - t[k + 1];
  return degree * ((left > 0.0 ? recursive_derivative(i, degree - 1, t, u, order - 1) / left : 0.0) -
                   (right > 0.0 ? recursive_derivative(i + 1, degree - 1, t, u, order - 1) / right : 0.0));
}

/// Clamped knots over [-1, 2] with inner knots of random multiplicity up to the degree.
std::vector<double> random_knots(int degree, Random& random) {
  std::vector<double> knots(static_cast<std::size_t>(degree) + 1, -1.0);
  double u = -1.0;
  for (int k = 0; k < 5; ++k) {
    u += random.uniform(0.1, 0.6);
    const int multiplicity = degree == 0 ? 1 : 1 + static_cast<int>(random.uniform() * degree);
    knots.insert(knots.end(), static_cast<std::size_t>(multiplicity), u);
  }
  knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, u + 0.3);
  return knots;
}

Values basis(int degree, const std::vector<double>& knots, double u, int order, int& span) {
  Values n{};
  span = find_span(degree, knots, u);
  basis_derivatives(degree, knots, span, u, order, n.data());
  return n;
}

double at(const Values& n, int degree, int order, int j) {
  return n[static_cast<std::size_t>(order * (degree + 1) + j)];
}

TEST(BSplineBasis, EqualsTheRecursiveDefinition) {
  Random random(1);
  for (int degree = 0; degree <= 6; ++degree)
    for (int trial = 0; trial < 6; ++trial) {
      const std::vector<double> knots = random_knots(degree, random);
      const int count = static_cast<int>(knots.size()) - degree - 1;
      for (int k = 0; k < 20; ++k) {
        const double u = k == 0 ? knots.front() : k == 1 ? knots.back() : random.uniform(knots.front(), knots.back());
        int span = 0;
        const Values n = basis(degree, knots, u, 0, span);
        for (int i = 0; i < count; ++i) {
          const bool active = i >= span - degree && i <= span;
          EXPECT_NEAR(active ? at(n, degree, 0, i - span + degree) : 0.0, recursive(i, degree, knots, u), 1e-13)
              << "degree " << degree << ", function " << i << ", u = " << u;
        }
      }
    }
}

TEST(BSplineBasis, DerivativesEqualTheirRecursion) {
  Random random(2);
  for (int degree = 0; degree <= 5; ++degree)
    for (int trial = 0; trial < 4; ++trial) {
      const std::vector<double> knots = random_knots(degree, random);
      for (int k = 0; k < 10; ++k) {
        const double u = random.uniform(knots.front(), knots.back());
        int span = 0;
        const Values n = basis(degree, knots, u, kMostOrder, span);
        for (int order = 1; order <= kMostOrder; ++order)
          for (int j = 0; j <= degree; ++j) {
            const double expected = recursive_derivative(span - degree + j, degree, knots, u, order);
            EXPECT_NEAR(at(n, degree, order, j), expected, 1e-12 * (1.0 + std::abs(expected)))
                << "degree " << degree << ", order " << order;
          }
      }
    }
}

TEST(BSplineBasis, DerivativesAboveTheDegreeAreZero) {
  for (int degree = 0; degree < kMostOrder; ++degree) {
    int span = 0;
    const std::vector<double> knots = uniform_knots(degree, degree + 3);
    Values n;
    n.fill(7.0);
    span = find_span(degree, knots, 0.4);
    basis_derivatives(degree, knots, span, 0.4, kMostOrder, n.data());
    for (int order = degree + 1; order <= kMostOrder; ++order)
      for (int j = 0; j <= degree; ++j) EXPECT_EQ(at(n, degree, order, j), 0.0);
  }
}

TEST(BSplineBasis, SumsToOneAndIsNowhereNegativeUpToTheLargestDegree) {
  Random random(3);
  for (int degree = 1; degree <= kMaxDegree; ++degree) {
    const std::vector<double> knots = random_knots(degree, random);
    for (int k = 0; k < 40; ++k) {
      int span = 0;
      const double u = random.uniform(knots.front(), knots.back());
      const Values n = basis(degree, knots, u, 2, span);
      std::array<double, 3> sum{}, size{};
      for (int order = 0; order <= 2; ++order)
        for (int j = 0; j <= degree; ++j) {
          sum[static_cast<std::size_t>(order)] += at(n, degree, order, j);
          size[static_cast<std::size_t>(order)] += std::abs(at(n, degree, order, j));
        }
      EXPECT_NEAR(sum[0], 1.0, 1e-13);
      EXPECT_NEAR(sum[1], 0.0, 1e-13 * size[1]);
      EXPECT_NEAR(sum[2], 0.0, 1e-13 * size[2]);
      for (int j = 0; j <= degree; ++j) EXPECT_GE(at(n, degree, 0, j), 0.0);
    }
  }
}

TEST(BSplineBasis, OutsideItsSpanItIsTheSamePolynomial) {
  const int degree = 3;
  const std::vector<double> knots = uniform_knots(degree, 8);
  const int span = find_span(degree, knots, 0.5);
  const double a = knots[static_cast<std::size_t>(span)], b = knots[static_cast<std::size_t>(span) + 1];
  for (const double u : {a - 0.3, b + 0.3}) {
    Values far;
    basis_derivatives(degree, knots, span, u, 0, far.data());
    // Lagrange through four places within the span.
    std::array<double, 4> expected{};
    for (int k = 0; k < 4; ++k) {
      const double x = a + (b - a) * k / 3.0;
      double weight = 1.0;
      for (int m = 0; m < 4; ++m)
        if (m != k) weight *= (u - (a + (b - a) * m / 3.0)) / ((b - a) * (k - m) / 3.0);
      Values inside;
      basis_derivatives(degree, knots, span, x, 0, inside.data());
      for (std::size_t j = 0; j < 4; ++j) expected[j] += weight * inside[j];
    }
    for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(far[j], expected[j], 1e-11);
  }
}

TEST(BSplineBasis, ReversedKnotsReverseTheBasis) {
  Random random(4);
  for (int degree = 1; degree <= 5; ++degree) {
    const std::vector<double> knots = random_knots(degree, random);
    std::vector<double> reversed(knots.rbegin(), knots.rend());
    for (double& k : reversed) k = -k;
    const int count = static_cast<int>(knots.size()) - degree - 1;
    for (int k = 0; k < 20; ++k) {
      const double u = random.uniform(knots.front(), knots.back());
      int span = 0, mirrored = 0;
      const Values a = basis(degree, knots, u, 1, span), b = basis(degree, reversed, -u, 1, mirrored);
      EXPECT_EQ(span - degree, count - 1 - mirrored);
      for (int j = 0; j <= degree; ++j) {
        EXPECT_NEAR(at(a, degree, 0, j), at(b, degree, 0, degree - j), 1e-12);
        EXPECT_NEAR(at(a, degree, 1, j), -at(b, degree, 1, degree - j), 1e-10);
      }
    }
  }
}

TEST(BSplineBasis, FindsTheSpanByItsDefinition) {
  Random random(5);
  for (int degree = 1; degree <= 4; ++degree) {
    const std::vector<double> knots = random_knots(degree, random);
    std::vector<double> places(knots);
    for (int k = 0; k < 50; ++k) places.push_back(random.uniform(knots.front(), knots.back()));
    for (const double u : places) {
      const auto span = static_cast<std::size_t>(find_span(degree, knots, u));
      EXPECT_LT(knots[span], knots[span + 1]) << "a span that is not empty";
      EXPECT_LE(knots[span], u);
      EXPECT_TRUE(u < knots[span + 1] || u == knots.back());
    }
    EXPECT_EQ(find_span(degree, knots, -50.0), degree);
    EXPECT_EQ(find_span(degree, knots, 50.0), static_cast<int>(knots.size()) - degree - 2);
    EXPECT_EQ(find_span(degree, knots, knots.back()), static_cast<int>(knots.size()) - degree - 2);
  }
}

TEST(BSplineBasis, UniformKnotsAreClampedAndEven) {
  EXPECT_EQ(uniform_knots(2, 5, 1.0, 4.0), (std::vector<double>{1, 1, 1, 2, 3, 4, 4, 4}));
  EXPECT_EQ(uniform_knots(3, 4), (std::vector<double>{0, 0, 0, 0, 1, 1, 1, 1}));
  const std::vector<double> knots = uniform_knots(3, 13, 0.1, 0.7);
  ASSERT_EQ(knots.size(), 17u);
  EXPECT_EQ(knots.back(), 0.7) << "the end is met exactly";
  for (std::size_t k = 4; k < 13; ++k) EXPECT_NEAR(knots[k] - knots[k - 1], 0.06, 1e-15);
}

}  // namespace
}  // namespace flank::internal
