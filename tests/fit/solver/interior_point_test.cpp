// The interior point method against optima that a search through all sets of active constraints finds exactly.
#include "flank/fit/solver/interior_point.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <optional>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

constexpr int kIterations = 60;
constexpr int kTool = 3;

/// A quadratic in three parameters of the tool and the 24 coordinates of one motion of four control points.
struct Quadratic {
  ArrowSystem system{{4}, kTool};
  Eigen::MatrixXd matrix;
};

/// Convex, its motion and its tool coupled by residuals.
Quadratic random_quadratic(Random& random) {
  Quadratic out;
  const std::array<double, 4> ones = {1.0, 1.0, 1.0, 1.0};
  for (int k = 0; k < 60; ++k) {
    ResidualRow row;
    row.basis = ones;
    for (double& b : row.basis) b = random.normal();
    for (double& x : row.pose) x = random.normal();
    row.tool_count = kTool;
    for (int l = 0; l < kTool; ++l) row.tool[static_cast<std::size_t>(l)] = random.normal();
    out.system.add_row(row, random.uniform(0.2, 1.0), random.normal());
  }
  const int n = out.system.size();
  out.matrix.resize(n, n);
  for (int k = 0; k < n; ++k) out.matrix.col(k) = out.system.multiply(Eigen::VectorXd::Unit(n, k));
  return out;
}

/// The motion at rest (identity, no pull), and |x - wish|^2 / 2 in the tool's parameters.
Quadratic nearest_to(const Eigen::Vector3d& wish) {
  Quadratic out;
  PoseTerms terms;
  terms.matrix = Mat6::Identity();
  for (int k = 0; k < 4; ++k) {
    std::array<double, 4> basis{};
    basis[static_cast<std::size_t>(k)] = 1.0;
    out.system.add_pose(0, 0, basis.data(), terms, false);
  }
  out.system.tool_matrix.setIdentity();
  out.system.gradient.tail<3>() = -wish;
  return out;
}

/// The half space a . x + c >= 0 of the tool's parameters.
void add_half_space(GapProblem& problem, const Eigen::Vector3d& a, double c) {
  ResidualRow row;
  row.tool_count = kTool;
  for (int k = 0; k < kTool; ++k) row.tool[static_cast<std::size_t>(k)] = a[k];
  problem.rows.push_back(row);
  problem.gaps.push_back(c);
}

Eigen::VectorXd dense_row(const ArrowSystem& system, const ResidualRow& row) {
  Eigen::VectorXd out(system.size());
  for (int k = 0; k < system.size(); ++k) out[k] = system.product(row, Eigen::VectorXd::Unit(system.size(), k));
  return out;
}

double value_at(const ArrowSystem& system, const Eigen::VectorXd& x) {
  return 0.5 * x.dot(system.multiply(x)) + system.gradient.dot(x);
}

double least_gap(const GapProblem& problem, const Eigen::VectorXd& x) {
  double least = 1e300;
  for (std::size_t k = 0; k < problem.rows.size(); ++k)
    least = std::min(least, problem.quadratic->product(problem.rows[k], x) + problem.gaps[k]);
  return least;
}

/// The stationary point with exactly these constraints active; nothing if a multiplier is negative or the point breaks
/// another constraint: then it is not the optimum.
std::optional<Eigen::VectorXd> with_active(const GapProblem& problem, const Eigen::MatrixXd& matrix, unsigned active) {
  const int n = problem.quadratic->size();
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < problem.rows.size(); ++k)
    if ((active >> k) & 1u) rows.push_back(k);
  const int m = static_cast<int>(rows.size());
  Eigen::MatrixXd kkt = Eigen::MatrixXd::Zero(n + m, n + m);
  Eigen::VectorXd rhs(n + m);
  kkt.topLeftCorner(n, n) = matrix;
  rhs.head(n) = -problem.quadratic->gradient;
  for (int k = 0; k < m; ++k) {
    const std::size_t r = rows[static_cast<std::size_t>(k)];
    kkt.block(n + k, 0, 1, n) = dense_row(*problem.quadratic, problem.rows[r]).transpose();
    kkt.block(0, n + k, n, 1) = -kkt.block(n + k, 0, 1, n).transpose();
    rhs[n + k] = -problem.gaps[r];
  }
  const Eigen::VectorXd solution = kkt.fullPivLu().solve(rhs);
  if ((kkt * solution - rhs).norm() > 1e-8 * (1.0 + rhs.norm())) return std::nullopt;
  const Eigen::VectorXd x = solution.head(n);
  if (m > 0 && solution.tail(m).minCoeff() < -1e-9) return std::nullopt;
  if (!problem.rows.empty() && least_gap(problem, x) < -1e-9) return std::nullopt;
  return x;
}

std::optional<Eigen::VectorXd> brute_force(const GapProblem& problem, const Eigen::MatrixXd& matrix) {
  for (unsigned active = 0; active < (1u << problem.rows.size()); ++active)
    if (const auto x = with_active(problem, matrix, active)) return x;
  return std::nullopt;
}

TEST(InteriorPoint, WithoutConstraintsItIsTheNewtonStep) {
  Random random(1);
  const Quadratic quadratic = random_quadratic(random);
  const Eigen::VectorXd x = solve_gaps({&quadratic.system, {}, {}}, kIterations);
  const Eigen::VectorXd expected = -quadratic.matrix.ldlt().solve(quadratic.system.gradient);
  EXPECT_LT((x - expected).norm(), 1e-9 * expected.norm());
}

TEST(InteriorPoint, AConstraintThatHoldsAnywayChangesNothing) {
  const Quadratic quadratic = nearest_to({1.0, -2.0, 0.5});
  GapProblem problem{&quadratic.system, {}, {}};
  add_half_space(problem, Eigen::Vector3d::UnitX(), 50.0);
  const Eigen::VectorXd x = solve_gaps(problem, kIterations);
  EXPECT_LT((x.tail<3>() - Eigen::Vector3d(1.0, -2.0, 0.5)).norm(), 1e-6);
  EXPECT_LT(x.head(24).norm(), 1e-9);
}

TEST(InteriorPoint, OnePlaneGivesTheProjection) {
  const Eigen::Vector3d wish(3.0, 1.0, -2.0), normal = Eigen::Vector3d(-1.0, 2.0, 2.0) / 3.0;
  const Quadratic quadratic = nearest_to(wish);
  GapProblem problem{&quadratic.system, {}, {}};
  add_half_space(problem, normal, 0.25);
  const Eigen::Vector3d projection = wish - (normal.dot(wish) + 0.25) * normal;
  EXPECT_LT((solve_gaps(problem, kIterations).tail<3>() - projection).norm(), 1e-6);
}

TEST(InteriorPoint, ThreePlanesMeetInTheirCorner) {
  const Quadratic quadratic = nearest_to({3.0, 4.0, 5.0});
  GapProblem problem{&quadratic.system, {}, {}};
  for (int k = 0; k < 3; ++k) add_half_space(problem, -Eigen::Vector3d::Unit(k), 1.0 + k);
  EXPECT_LT((solve_gaps(problem, kIterations).tail<3>() - Eigen::Vector3d(1.0, 2.0, 3.0)).norm(), 1e-6);
}

TEST(InteriorPoint, ABrokenStartIsMendedAtTheLeastPrice) {
  // x >= 2 although the objective wants zero, and the step starts at zero.
  const Quadratic quadratic = nearest_to(Eigen::Vector3d::Zero());
  GapProblem problem{&quadratic.system, {}, {}};
  add_half_space(problem, Eigen::Vector3d::UnitX(), -2.0);
  add_half_space(problem, Eigen::Vector3d(1.0, 1.0, 0.0), -1.0);
  EXPECT_LT((solve_gaps(problem, kIterations).tail<3>() - Eigen::Vector3d(2.0, 0.0, 0.0)).norm(), 1e-6);
}

TEST(InteriorPoint, AConstraintGivenTwiceCountsOnce) {
  const Quadratic quadratic = nearest_to({3.0, 0.0, 0.0});
  GapProblem problem{&quadratic.system, {}, {}};
  for (int k = 0; k < 4; ++k) add_half_space(problem, -Eigen::Vector3d::UnitX(), 1.0);
  EXPECT_LT((solve_gaps(problem, kIterations).tail<3>() - Eigen::Vector3d::UnitX()).norm(), 1e-6);
}

TEST(InteriorPoint, RandomProblemsEndAtTheOptimumOfBruteForce) {
  Random random(17);
  int bound = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Quadratic quadratic = random_quadratic(random);
    const Eigen::VectorXd inside = -0.5 * quadratic.matrix.ldlt().solve(quadratic.system.gradient);
    GapProblem problem{&quadratic.system, {}, {}};
    for (int k = 0; k < 5; ++k) {
      ResidualRow row;
      for (double& b : row.basis) b = random.uniform();
      for (double& x : row.pose) x = random.normal();
      row.tool_count = 2;
      row.tool_first = k % 2;
      row.tool = {random.normal(), random.normal(), 0.0, 0.0};
      problem.rows.push_back(row);
      // Half-way to the free optimum is inside every constraint, by a little.
      problem.gaps.push_back(-quadratic.system.product(row, inside) + random.uniform(0.001, 0.05));
    }
    const auto best = brute_force(problem, quadratic.matrix);
    ASSERT_TRUE(best.has_value()) << trial;
    const Eigen::VectorXd x = solve_gaps(problem, kIterations);
    const double least = value_at(quadratic.system, *best);
    EXPECT_NEAR(value_at(quadratic.system, x), least, 1e-7 * std::abs(least)) << trial;
    EXPECT_GT(least_gap(problem, x), -1e-8) << trial;
    EXPECT_LT((x - *best).norm(), 1e-3 * best->norm()) << trial;
    bound += least > value_at(quadratic.system, 2.0 * inside) + 1e-9 ? 1 : 0;
  }
  EXPECT_GT(bound, 20) << "too few problems have an active constraint";
}

TEST(InteriorPoint, FromAStartInsideItNeverLeaves) {
  const Quadratic quadratic = nearest_to({30.0, 40.0, -50.0});
  GapProblem problem{&quadratic.system, {}, {}};
  for (const double side : {1.0, -1.0})
    for (int k = 0; k < 3; ++k) add_half_space(problem, side * Eigen::Vector3d::Unit(k), 1.0 + 0.2 * k);
  for (int iterations = 1; iterations <= 25; ++iterations)
    EXPECT_GT(least_gap(problem, solve_gaps(problem, iterations)), 0.0) << iterations;
}

TEST(InteriorPoint, MoreIterationsComeNearer) {
  const Eigen::Vector3d wish(3.0, 4.0, 5.0);
  const Quadratic quadratic = nearest_to(wish);
  GapProblem problem{&quadratic.system, {}, {}};
  for (int k = 0; k < 3; ++k) add_half_space(problem, -Eigen::Vector3d::Unit(k), 1.0);
  EXPECT_EQ(solve_gaps(problem, 0).norm(), 0.0);
  double last = 1e300;
  for (const int iterations : {1, 3, 8, 20}) {
    const Eigen::VectorXd x = solve_gaps(problem, iterations);
    const double error = (x.tail<3>() - Eigen::Vector3d::Ones()).norm();
    EXPECT_LT(error, last) << iterations;
    last = error;
  }
  EXPECT_LT(last, 1e-5);
}

TEST(InteriorPoint, ContradictionsEndWithAFiniteStepBetweenThem) {
  // x >= 1 and x <= -1: no step keeps both.
  const Quadratic quadratic = nearest_to({0.2, 0.3, 0.0});
  GapProblem problem{&quadratic.system, {}, {}};
  add_half_space(problem, Eigen::Vector3d::UnitX(), -1.0);
  add_half_space(problem, -Eigen::Vector3d::UnitX(), -1.0);
  const Eigen::VectorXd x = solve_gaps(problem, kIterations);
  ASSERT_TRUE(x.allFinite());
  EXPECT_LE(std::abs(x[24]), 1.0);
}

TEST(InteriorPoint, AQuadraticThatIsNoneGivesNoStep) {
  const ArrowSystem nothing({4}, kTool);
  GapProblem problem{&nothing, {}, {}};
  add_half_space(problem, Eigen::Vector3d::UnitX(), 1.0);
  EXPECT_EQ(solve_gaps(problem, kIterations).norm(), 0.0);
}

}  // namespace
}  // namespace flank::internal
