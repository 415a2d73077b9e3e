/// Jets at all vertices of a mesh.
#pragma once

#include <vector>

#include "flank/geom/mesh_topology.h"
#include "flank/surface/mesh/jet.h"

namespace flank::internal {

/// From which neighbours a jet is fitted.
struct JetOptions {
  /// Of the polynomials, 1 to Jet::kDegree.
  int degree = 4;
  /// Whole rings of neighbours are taken until at least this many points are there. 30: three rings inside, four to
  /// five at a corner.
  int points = 30;
  /// Weights fall to exp(-falloff) at the farthest point. 12 follows exact data closely, 0 averages noise best.
  double falloff = 12.0;
  /// A jet may miss the vertices next to its own one by this much, mm, besides a share of their distance; several times
  /// the noise.
  double allowance = 0.0;
};

/// Collects rings of vertices around a vertex; keep one per thread.
class RingCollector {
 public:
  /// Keeps references: mesh, topology and vertex normals must outlive it.
  RingCollector(const TriangleMesh& mesh, const MeshTopology& topology, const std::vector<Vec3>& normals);

  /// `vertex` and whole rings around it, until `least` points are there or no more can be reached. Vertices whose
  /// normal turns more than 60 degrees away from the first one's are passed over: a height field could not hold them.
  const std::vector<int>& collect(int vertex, int least);
  /// `vertex` and those within `radius` of it that hang together with it.
  const std::vector<int>& collect_within(int vertex, double radius);
  /// Places of those collected last.
  [[nodiscard]] const std::vector<Vec3>& points() const { return points_; }

 private:
  void start(int vertex);
  /// Adds the neighbours of found_[begin, end) that are accepted and not yet found.
  template <class Accept>
  void add_ring(std::size_t begin, std::size_t end, const Accept& accept);

  const TriangleMesh& mesh_;
  const MeshTopology& topology_;
  const std::vector<Vec3>& normals_;
  /// A vertex is found already if its stamp is now_: nothing has to be cleared between calls.
  std::vector<int> stamp_;
  int now_ = 0;
  std::vector<int> found_;
  std::vector<Vec3> points_;
};

/// One fit a vertex, independent of the number of threads. `normals`: of the vertices.
[[nodiscard]] std::vector<JetFit> fit_jets(const TriangleMesh& mesh, const MeshTopology& topology,
                                           const std::vector<Vec3>& normals, const JetOptions& options = {});

}  // namespace flank::internal
