/// The reachable share of a target (MATH section 9): where a ball can touch it without entering another face, nor the
/// target itself in a corner narrower than the ball.
#pragma once

#include <memory>
#include <vector>

#include "flank/judge.h"
#include "flank/path.h"
#include "flank/tool.h"

namespace flank::internal {

/// A face that is not the target, as triangles; counter-clockwise seen from outside where it belongs to a solid.
struct ReachFace {
  TriangleMesh mesh;
  int solid = -1;       ///< -1: an open sheet, which has no inside
  bool checked = true;  ///< the ball must not enter it; else it only helps to close its solid
  /// The whole face, coarser, where `mesh` is only what a ball may come near: that tells what is inside of its solid. Empty: `mesh` does.
  TriangleMesh closing = {};
};

struct ReachOptions {
  double radius_mm = 1.0;      ///< > 0, of the ball: the tool's smallest radius, or what the user names
  double tolerance_mm = 0.01;  ///< > 0: it may enter other faces by this much
};

/// Faces of a part made ready once, whichever of them is the target: trees over a wheel's faces take hundreds of megabytes.
/// Immutable.
class ReachFaces {
 public:
  explicit ReachFaces(const std::vector<ReachFace>& faces);

 private:
  friend class ReachScene;
  struct Ready;
  std::vector<std::shared_ptr<const Ready>> faces_;  ///< in their order
  struct Solid;
  std::vector<std::shared_ptr<const Solid>> solids_;  ///< of those that have a checked face
};

/// What a ball must keep out of, made ready once for many samples: other faces, and the target's `own` triangles (none: the
/// target has no corners). Immutable, so many threads may ask at once. Throws UsageError for a radius or tolerance that is
/// not > 0.
class ReachScene {
 public:
  /// Of face `target` of `faces` among all others; those of its own solid do not close anything. `corners`: it holds the ball off
  /// itself, too. Shares what `faces` holds.
  ReachScene(const ReachFaces& faces, std::size_t target, bool corners, const ReachOptions& options);
  ReachScene(const std::vector<ReachFace>& others, const TriangleMesh& own, const ReachOptions& options);
  ~ReachScene();
  ReachScene(ReachScene&&) noexcept;

  /// Share of each sample's cell, 0 to 1, whose points x are reachable: the ball about c = x + radius n(x) enters no
  /// checked face by more than the tolerance, and c lies in no solid that has a checked face (a target may run on
  /// inside another solid, which is no place for a tool however far its surface is). `target.normals` point to the
  /// machining side. Cells through which the border of the reachable part runs are measured at 89 places; where the ball
  /// about the middle of a cell enters the target itself deeper than the tolerance, none of the cell counts.
  /// Parallel; the same bits for any number of threads.
  [[nodiscard]] std::vector<double> shares(const FaceSamples& target) const;

  /// Radius of the largest ball, up to the scene's own, that touches the face at each sample and is free in the same sense, mm; 0
  /// where none is. To about a thousandth: the shrinking ball (J. Ma, S. W. Bae, S. Choi, 3D medial axis point approximation using
  /// nearest neighbors and the normal field, The Visual Computer 28, 2012). Parallel; the same bits for any number of threads.
  [[nodiscard]] std::vector<double> largest_balls(const FaceSamples& target) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

/// The same of one set of samples, of a target without corners.
[[nodiscard]] std::vector<double> reachable_shares(const FaceSamples& target, const std::vector<ReachFace>& others,
                                                   const ReachOptions& options);

/// +1 or -1: on which side of a sheet, by its samples' normals, the tool runs where it passes near; +1 if it does not.
[[nodiscard]] int side_of_tool(const Tool& tool, const Path& path, const FaceSamples& sheet);

}  // namespace flank::internal
