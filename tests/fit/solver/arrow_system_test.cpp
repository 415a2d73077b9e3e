// The arrow matrix against dense matrices that are assembled from the same residuals one by one.
#include "flank/fit/solver/arrow_system.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

constexpr int kMotions = 2, kTool = 5;
const std::vector<int> kCounts = {6, 9};

/// Two motions of different length and five parameters of the tool.
ArrowSystem empty_system() { return {kCounts, kTool}; }

ResidualRow random_row(Random& random) {
  ResidualRow row;
  row.motion = static_cast<int>(random.next() % kMotions);
  const auto places = static_cast<std::uint64_t>(kCounts[static_cast<std::size_t>(row.motion)] - 3);
  row.first = static_cast<int>(random.next() % places);
  for (double& b : row.basis) b = random.uniform();
  for (double& x : row.pose) x = random.normal();
  row.tool_count = 1 + static_cast<int>(random.next() % 4);
  row.tool_first = static_cast<int>(random.next() % static_cast<std::uint64_t>(kTool - row.tool_count + 1));
  for (int k = 0; k < row.tool_count; ++k) row.tool[static_cast<std::size_t>(k)] = random.normal();
  return row;
}

/// The row as it stands in the Jacobian.
Eigen::VectorXd dense_row(const ResidualRow& row, const ArrowSystem& system) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(system.size());
  for (int k = 0; k < 4; ++k)
    out.segment<6>(system.motion_offset(row.motion) + 6 * (row.first + k)) +=
        row.basis[static_cast<std::size_t>(k)] * row.pose;
  for (int k = 0; k < row.tool_count; ++k)
    out[system.tool_offset() + row.tool_first + k] += row.tool[static_cast<std::size_t>(k)];
  return out;
}

Eigen::MatrixXd dense_matrix(const ArrowSystem& system) {
  Eigen::MatrixXd dense(system.size(), system.size());
  for (int k = 0; k < system.size(); ++k) dense.col(k) = system.multiply(Eigen::VectorXd::Unit(system.size(), k));
  return dense;
}

/// 400 weighted residuals, in the system and as a dense matrix and gradient.
struct Filled {
  ArrowSystem system = empty_system();
  Eigen::MatrixXd matrix;
  Eigen::VectorXd gradient;
};
Filled filled_system(std::uint64_t seed) {
  Random random(seed);
  Filled out;
  const int n = out.system.size();
  out.matrix.setZero(n, n);
  out.gradient.setZero(n);
  for (int k = 0; k < 400; ++k) {
    const ResidualRow row = random_row(random);
    const double weight = random.uniform(0.1, 2.0), factor = random.normal();
    out.system.add_row(row, weight, factor);
    const Eigen::VectorXd j = dense_row(row, out.system);
    out.matrix += weight * j * j.transpose();
    out.gradient += factor * j;
  }
  return out;
}

/// The diagonal that a damping of one adds: the mean of each motion's diagonal, the tool's own.
Eigen::VectorXd damping_diagonal(const ArrowSystem& system, const Eigen::MatrixXd& matrix) {
  Eigen::VectorXd diagonal = matrix.diagonal();
  for (int m = 0; m < kMotions; ++m) {
    const int count = 6 * kCounts[static_cast<std::size_t>(m)];
    auto part = diagonal.segment(system.motion_offset(m), count);
    part.setConstant(part.mean());
  }
  return diagonal;
}

TEST(ArrowSystem, RowsAddUpToTheDenseNormalEquations) {
  const Filled filled = filled_system(1);
  EXPECT_EQ(filled.system.size(), 6 * (6 + 9) + kTool);
  EXPECT_EQ(filled.system.motion_offset(1), 36);
  EXPECT_EQ(filled.system.tool_offset(), 90);
  EXPECT_LT((dense_matrix(filled.system) - filled.matrix).norm(), 1e-13 * filled.matrix.norm());
  EXPECT_LT((filled.system.gradient - filled.gradient).norm(), 1e-13 * filled.gradient.norm());
}

TEST(ArrowSystem, ProductIsTheRowTimesTheVector) {
  Random random(5);
  const ArrowSystem system = empty_system();
  Eigen::VectorXd x(system.size());
  for (double& value : x) value = random.normal();
  for (int k = 0; k < 50; ++k) {
    const ResidualRow row = random_row(random);
    EXPECT_NEAR(system.product(row, x), dense_row(row, system).dot(x), 1e-12);
  }
}

TEST(ArrowSystem, APoseIsTheSumOfItsRows) {
  Random random(7);
  ArrowSystem rows = empty_system(), poses = empty_system();
  for (int place = 0; place < 6; ++place) {
    const std::array<double, 4> basis = {random.uniform(), random.uniform(), random.uniform(), random.uniform()};
    PoseTerms terms;
    terms.gradient.setZero();
    terms.coupling.setZero(6, kTool);
    for (int k = 0; k < 7; ++k) {
      ResidualRow row = random_row(random);
      row.motion = 1;
      row.first = place;
      row.basis = basis;
      const double weight = random.uniform(0.1, 2.0), factor = random.normal();
      rows.add_row(row, weight, factor);
      terms.matrix += weight * row.pose * row.pose.transpose();
      terms.gradient += factor * row.pose;
      // What belongs to the tool alone is not a pose's matter.
      for (int l = 0; l < row.tool_count; ++l) {
        const double by_tool = row.tool[static_cast<std::size_t>(l)];
        terms.coupling.col(row.tool_first + l) += weight * by_tool * row.pose;
        poses.gradient[poses.tool_offset() + row.tool_first + l] += factor * by_tool;
        for (int q = 0; q < row.tool_count; ++q)
          poses.tool_matrix(row.tool_first + l, row.tool_first + q) +=
              weight * by_tool * row.tool[static_cast<std::size_t>(q)];
      }
    }
    poses.add_pose(1, place, basis.data(), terms, true);
  }
  const Eigen::MatrixXd expected = dense_matrix(rows);
  EXPECT_LT((dense_matrix(poses) - expected).norm(), 1e-13 * expected.norm());
  EXPECT_LT((poses.gradient - rows.gradient).norm(), 1e-13 * rows.gradient.norm());
}

TEST(ArrowSystem, SolvesTheDampedSystemAsADenseOneDoes) {
  for (const double damping : {0.0, 1e-9, 1e-3, 1.0, 1e4}) {
    const Filled filled = filled_system(2);
    Eigen::MatrixXd damped = filled.matrix;
    damped.diagonal() += damping * damping_diagonal(filled.system, filled.matrix);
    const Eigen::VectorXd expected = -damped.ldlt().solve(filled.gradient);
    Eigen::VectorXd step;
    ASSERT_TRUE(filled.system.solve(damping, step));
    EXPECT_LT((step - expected).norm(), 1e-9 * expected.norm()) << damping;
  }
}

TEST(ArrowSystem, DampingForGoodIsTheDampingOfASolve) {
  Filled filled = filled_system(3);
  Eigen::VectorXd damped, added;
  ASSERT_TRUE(filled.system.solve(0.03, damped));
  filled.system.add_damping(0.03);
  ASSERT_TRUE(filled.system.solve(0.0, added));
  EXPECT_LT((damped - added).norm(), 1e-12 * damped.norm());
}

TEST(ArrowSystem, AStepGoesDownhillAndShortensAsTheDampingGrows) {
  const Filled filled = filled_system(4);
  double longest = 1e300;
  for (const double damping : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
    Eigen::VectorXd step;
    ASSERT_TRUE(filled.system.solve(damping, step));
    EXPECT_LT(filled.gradient.dot(step), 0.0);
    EXPECT_LT(step.norm(), longest);
    longest = step.norm();
  }
  EXPECT_LT(longest, 1e-4);
}

TEST(ArrowSystem, WithoutToolParametersOnlyTheMotionsAreSolved) {
  Random random(9);
  ArrowSystem system({6, 9}, 0);
  const int n = system.size();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (int k = 0; k < 300; ++k) {
    ResidualRow row = random_row(random);
    row.tool_count = row.tool_first = 0;
    system.add_row(row, 1.0, random.normal());
    const Eigen::VectorXd j = dense_row(row, system);
    matrix += j * j.transpose();
  }
  Eigen::VectorXd step;
  ASSERT_TRUE(system.solve(0.0, step));
  const Eigen::VectorXd expected = -matrix.ldlt().solve(system.gradient);
  EXPECT_LT((step - expected).norm(), 1e-9 * expected.norm());
}

TEST(ArrowSystem, SaysSoIfTheMatrixIsNotPositiveDefinite) {
  Eigen::VectorXd step;
  EXPECT_FALSE(empty_system().solve(1e-3, step)) << "nothing but zeros";
  Filled filled = filled_system(6);
  Random random(8);
  filled.system.add_row(random_row(random), -1e4, 0.0);
  EXPECT_FALSE(filled.system.solve(0.0, step)) << "a direction of negative curvature in the motions";
  Filled bent = filled_system(6);
  bent.system.tool_matrix(2, 2) -= 1e4;
  EXPECT_FALSE(bent.system.solve(0.0, step)) << "a direction of negative curvature in the tool";
}

TEST(ArrowSystem, ClearLeavesNothingBehind) {
  Filled filled = filled_system(10);
  filled.system.clear();
  EXPECT_EQ(dense_matrix(filled.system).norm(), 0.0);
  EXPECT_EQ(filled.system.gradient.norm(), 0.0);
  EXPECT_EQ(filled.system.size(), 95);
}

}  // namespace
}  // namespace flank::internal
