/// The normal equations of the fit: every motion is a band, the tool that they share is a border.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace flank::internal {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Mat6X = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// What one axis position adds to the normal equations, before its six coordinates (tip, scaled direction) are spread
/// over the four control points that act at its time: sum of w g g', w e g, w g b' with g = de/dpose and b = de/dtool.
struct PoseTerms {
  Mat6 matrix = Mat6::Zero();
  Vec6 gradient = Vec6::Zero();
  Mat6X coupling;  ///< 6 x tool parameters
};

/// The derivative of one residual: by the pose at its time, and by at most four parameters of the tool in a row.
struct ResidualRow {
  int motion = 0, first = 0;  ///< control points first .. first + 3 act
  std::array<double, 4> basis{};
  Vec6 pose = Vec6::Zero();  ///< by tip and scaled direction
  int tool_first = 0, tool_count = 0;
  std::array<double, 4> tool{};
};

/// Symmetric positive system (H + damping D) step = -gradient. Unknowns: motion 0 (six per control point), motion 1,
/// ..., the tool's parameters. Cubic rails: four control points act at a time, so H has 24 sub-diagonals per motion.
class ArrowSystem {
 public:
  ArrowSystem(std::vector<int> control_counts, int tool_parameters);

  void clear();
  /// Spreads the terms of a pose over control points first .. first + 3 with the weights basis[0..3].
  void add_pose(int motion, int first, const double* basis, const PoseTerms& terms, bool couples_tool);

  /// Adds weight J'J of one residual to the matrix and factor J to the gradient.
  void add_row(const ResidualRow& row, double weight, double factor);
  /// J x of one residual.
  [[nodiscard]] double product(const ResidualRow& row, const Eigen::VectorXd& x) const;

  /// Adds damping times the mean diagonal of each motion, and of the tool's own diagonal, to H for good.
  void add_damping(double damping);

  /// step = -(H + damping D)^-1 gradient, D the mean diagonal of each motion and the diagonal of the tool. False if not
  /// positive definite.
  [[nodiscard]] bool solve(double damping, Eigen::VectorXd& step) const;

  [[nodiscard]] int size() const { return offsets_.back() + tool_parameters_; }
  [[nodiscard]] int motion_offset(int motion) const { return offsets_[static_cast<std::size_t>(motion)]; }
  [[nodiscard]] int tool_offset() const { return offsets_.back(); }
  /// Half the directional second derivative: x' H x, for the predicted decrease.
  [[nodiscard]] Eigen::VectorXd multiply(const Eigen::VectorXd& x) const;

  Eigen::VectorXd gradient;
  Eigen::MatrixXd tool_matrix;  ///< tool parameters x tool parameters

 private:
  [[nodiscard]] double mean_diagonal(int first, int last) const;
  /// Whether the control points and the tool parameters of the row are there.
  [[nodiscard]] bool fits(const ResidualRow& row) const;

  static constexpr int kBand = 24;  ///< diagonal and 23 sub-diagonals

  std::vector<int> offsets_;  ///< first unknown of each motion, then of the tool
  int tool_parameters_;
  std::vector<double> band_;  ///< column c: band_[c * kBand + (r - c)], lower triangle
  Eigen::MatrixXd border_;    ///< motion unknowns x tool parameters
};

}  // namespace flank::internal
