// The method of paper A (Bo, Barton, Plakhotnik, Pottmann, CAD 79, 2016), sections 4.1 to 4.5, to the letter: the rival
// that our fit is raced against. It lives here only. Where the paper leaves something open, the choice is marked
// "open:".
#pragma once

#include <cstdint>
#include <vector>

#include "flank/bspline_curve.h"
#include "flank/geom/triangle_bvh.h"
#include "flank/triangle_mesh.h"

namespace flank::internal::bench {

struct PaperAOptions {
  int samples_t = 100, samples_s = 30;
  int control_points = 24;  // open: of each rail
  double mu1 = 1.0, mu2 = 0.1, mu3 = 0.001, mu4 = 0.1;
  double euler_step = 0.001;
  int end_samples = 15;            // at each end: 15 x 15 lines
  int sampling_rounds = 3;         // open: "repeatedly"
  double sampling_radius = 0.01;   // open
  double movability_limit = 1e-2;  // open: the threshold epsilon
  int iterations = 60;             // at most
  double stop = 1e-4;              // open: relative decrease of (12) below which Gauss-Newton ends
  std::uint64_t seed = 1;
};

// Lengths relative to the diagonal of the mesh.
struct PaperAIteration {
  double objective = 0.0;  // (12)
  double error = 0.0;      // root mean square of dist - d_j on its own samples
  double seconds = 0.0;    // since the optimisation began
};

struct PaperAResult {
  BSplineCurve3 a, b;
  Eigen::VectorXd d;
  double axis_length = 0.0;
  double init_seconds = 0.0, optimise_seconds = 0.0;
  int euler_steps = 0;
  std::vector<PaperAIteration> trace;
};

class PaperA {
 public:
  // The mesh must be normalised: diagonal 1.
  PaperA(const TriangleMesh& mesh, const PaperAOptions& options);

  // Line-driven: sampling around both ends, propagation by Euler steps both ways (4.1 to 4.3), optimisation (4.5).
  [[nodiscard]] PaperAResult run(const Vec3& tip, const Vec3& holder) const;
  // Surface-driven: two rails are given (4.4).
  [[nodiscard]] PaperAResult run(const BSplineCurve3& a, const BSplineCurve3& b, double axis_length) const;

 private:
  struct Line {
    Vec3 a, b;
  };
  struct Foot {
    Vec3 point, normal;  // normal: from the footpoint to the sample (5)
    double distance = 0.0;
    bool border = false;
  };
  struct Velocity {
    Vec3 a, b;
    double value = 0.0;
    bool off = false;  // every footpoint on the border
  };

  [[nodiscard]] Foot foot(const Vec3& p) const;
  [[nodiscard]] Velocity movability(const Line& line, const Vec3& previous) const;
  [[nodiscard]] Line sample(const Line& start) const;
  [[nodiscard]] std::vector<Line> propagate(const Line& start, const Vec3& heading) const;
  [[nodiscard]] Eigen::VectorXd initial_distances(const PaperAResult& state) const;
  void optimise(PaperAResult& state) const;

  PaperAOptions options_;
  TriangleBvh tree_;
  std::vector<std::uint8_t>
      border_edges_;  // of each triangle: bit k set if the edge opposite corner k has no neighbour
  std::vector<double> s_;
};

}  // namespace flank::internal::bench
