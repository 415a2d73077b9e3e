#include "flank/results/view_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include "flank/base/parallel.h"
#include "flank/geom/tessellate.h"

namespace flank::internal {
namespace {

constexpr double kCoarseChord = 4e-4;  ///< of the part's diagonal
constexpr double kTargetChord = 1e-4;  // likewise, of what is looked at closely
constexpr int kCoarsenings = 6;        // of four times the chord each: in the last it is 0.4 diagonals

/// Of all triangles, mm^2.
double area(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[t[0]];
    sum += 0.5 * (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm();
  }
  return sum;
}

bool is_target(const std::vector<int>& targets, std::size_t k) {
  return std::find(targets.begin(), targets.end(), static_cast<int>(k)) != targets.end();
}

void tessellate_into(ViewFace& body, const Face& face, double chord, double edge) {
  Tessellation pieces = tessellate(face, {.chord_mm = chord, .edge_mm = edge});
  body.mesh = std::move(pieces.mesh);
  body.borders = std::move(pieces.borders);
}

std::size_t triangles_of_others(const std::vector<ViewFace>& bodies) {
  std::size_t count = 0;
  for (const ViewFace& body : bodies)
    if (!body.target) count += body.mesh.triangles.size();
  return count;
}

/// Coarsely at first, targets too: their areas are needed for the length of their edges (refine).
void tessellate_all(const Part& part, std::vector<ViewFace>& bodies) {
  const double diagonal = std::max(part.box.diagonal(), 1e-9);
  double chord = kCoarseChord * diagonal;
  // Four times the chord is a half to a quarter of the triangles of a curved face; faces of a file may need many of
  // them whatever the chord, so the number of rounds is bounded.
  for (int k = 0; k < kCoarsenings; ++k, chord *= 4.0) {
    parallel_for(bodies.size(), [&](std::size_t i) {
      if (part.is_left_out(static_cast<int>(i))) return;
      if (k == 0 || !bodies[i].target) tessellate_into(bodies[i], part.faces[i], chord, 0.2 * diagonal);
    });
    if (triangles_of_others(bodies) <= static_cast<std::size_t>(kOtherTriangles)) break;
  }
}

/// Replaces the coarse triangles of the bodies that `chosen` names by about `count` equal ones.
template <class Chosen>
void refine(const Part& part, std::vector<ViewFace>& bodies, int count, const Chosen& chosen) {
  const double diagonal = std::max(part.box.diagonal(), 1e-9);
  double sum = 0.0;
  for (const ViewFace& body : bodies)
    if (chosen(body)) sum += area(body.mesh);
  // Right triangles of two equal sides have the area edge^2 / 2. The least edge is for faces of no area.
  const double edge = std::max(std::sqrt(2.0 * sum / count), 1e-6 * diagonal);
  parallel_for(bodies.size(), [&](std::size_t i) {
    if (chosen(bodies[i])) tessellate_into(bodies[i], part.faces[i], kTargetChord * diagonal, edge);
  });
}

/// Every triangle in four.
TriangleMesh refined(const TriangleMesh& mesh) {
  TriangleMesh out;
  out.vertices = mesh.vertices;
  // Both triangles of a side get the same middle, or gaps would show.
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [entry, is_new] =
        middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(out.vertices.size()));
    if (is_new) out.vertices.push_back(0.5 * (mesh.vertices[a] + mesh.vertices[b]));
    return entry->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    // The three corners, then the one in the middle, all turned as the whole one is.
    for (const auto& t : {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c}, std::array{ab, bc, ca}})
      out.triangles.push_back(t);
  }
  return out;
}

/// The mesh with its vertices drawn together in cubes of side `cell`: the first vertex of each stands for all.
TriangleMesh clustered(const TriangleMesh& mesh, double cell) {
  TriangleMesh out;
  std::map<std::array<std::int64_t, 3>, int> cubes;
  std::vector<int> index;
  for (const Vec3& p : mesh.vertices) {
    const auto at = [&](int k) { return static_cast<std::int64_t>(std::floor(p[k] / cell)); };
    const auto [entry, is_new] = cubes.try_emplace({at(0), at(1), at(2)}, static_cast<int>(out.vertices.size()));
    if (is_new) out.vertices.push_back(p);
    index.push_back(entry->second);
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::array<int, 3> t{index[a], index[b], index[c]};
    // What was drawn together to a line or a point is not seen.
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) out.triangles.push_back(t);
  }
  return out;
}

/// Coarsens all bodies alike until they have at most kMostMeshTriangles together.
void thin_out(std::vector<ViewFace>& bodies) {
  const auto count = [&] {
    std::size_t sum = 0;
    for (const ViewFace& body : bodies) sum += body.mesh.triangles.size();
    return sum;
  };
  if (count() <= static_cast<std::size_t>(kMostMeshTriangles)) return;
  double whole = 0.0;
  for (const ViewFace& body : bodies) whole += area(body.mesh);
  // A surface has about two triangles for each cube that it meets.
  double cell = std::sqrt(2.0 * whole / kMostMeshTriangles);
  // Shapes differ from that rule: the cubes grow until it is enough.
  for (; count() > static_cast<std::size_t>(kMostMeshTriangles) && cell > 0.0; cell *= 1.25)
    for (ViewFace& body : bodies) body.mesh = clustered(body.mesh, cell);
}

/// A mesh keeps its own triangles where they are not too many; those of a coarse target are divided, so that the colours
/// have where to change.
void extract_all(const Part& part, std::vector<ViewFace>& bodies) {
  std::size_t target_triangles = 0;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    bodies[k].mesh = extract_mesh(part, {static_cast<int>(k)});
    if (bodies[k].target) target_triangles += bodies[k].mesh.triangles.size();
  }
  // As long as four times as many are still not too many.
  for (; target_triangles > 0 && 4 * target_triangles <= static_cast<std::size_t>(kTargetTriangles);
       target_triangles *= 4)
    for (ViewFace& body : bodies)
      if (body.target) body.mesh = refined(body.mesh);
  thin_out(bodies);
}

}  // namespace

std::vector<ViewFace> view_faces(const Part& part, const std::vector<int>& targets,
                                 const std::set<std::string>& entered) {
  std::vector<ViewFace> bodies(static_cast<std::size_t>(part.face_count()));
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    bodies[k].face = part.face_id(static_cast<int>(k));
    bodies[k].target = is_target(targets, k);
  }
  if (part.is_mesh()) {
    extract_all(part, bodies);
    return bodies;
  }
  tessellate_all(part, bodies);
  // Colours are drawn between vertices: the judge's error needs them dense where it is shown.
  refine(part, bodies, kTargetTriangles, [](const ViewFace& body) { return body.target; });
  refine(part, bodies, kEnteredTriangles,
         [&](const ViewFace& body) { return !body.target && entered.contains(body.face); });
  return bodies;
}

std::vector<ViewFace> view_fixture(const Part& fixture) {
  std::vector<ViewFace> bodies = view_faces(fixture, {}, {});
  if (!fixture.is_mesh()) {
    refine(fixture, bodies, kFixtureTriangles, [](const ViewFace& body) { return !body.mesh.triangles.empty(); });
    return bodies;
  }
  for (std::size_t count = triangles_of_others(bodies);
       count > 0 && 4 * count <= static_cast<std::size_t>(kFixtureTriangles); count *= 4)
    for (ViewFace& body : bodies) body.mesh = refined(body.mesh);
  return bodies;
}

}  // namespace flank::internal
