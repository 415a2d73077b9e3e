#include "flank/pipeline/judge/find_buried.h"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <span>

#include "flank/base/parallel.h"
#include "flank/geom/face_box.h"
#include "flank/geom/mesh_topology.h"
#include "flank/geom/tessellate.h"
#include "flank/verify/buried.h"

namespace flank::internal {
namespace {

/// Deviation of a solid's triangles, of the tool's smallest radius: no nearer to a surface is the middle of an axis that
/// cuts nothing.
constexpr double kRadiusShare = 0.1;

/// By face of a part: whether its cuts are judged.
using IsJudged = std::function<bool(int face)>;

Box3 box_of(const Part& part, const std::vector<int>& faces) {
  Box3 box;
  for (const int face : faces) box.add(internal::box_of(part.faces[static_cast<std::size_t>(face)]));
  return box;
}

/// Whether a strip begins in the box: only then a solid in it matters.
bool begins_in(const Box3& box, const Tool& tool, const Path& path) {
  return std::any_of(path.strips.begin(), path.strips.end(), [&](const Strip& strip) {
    if (strip.poses.empty()) return false;
    const Vec3 x = strip.poses.front().at(0.5 * tool.radial.axis_length());
    return (x.array() >= box.low.array()).all() && (x.array() <= box.high.array()).all();
  });
}

TriangleMesh joined(const Part& part, const std::vector<int>& faces, double chord_mm) {
  std::vector<TriangleMesh> meshes(faces.size());
  parallel_for(meshes.size(), [&](std::size_t k) {
    meshes[k] =
        tessellate(part.faces[static_cast<std::size_t>(faces[k])], {.chord_mm = chord_mm, .edge_mm = 1e300}).mesh;
  });
  TriangleMesh all;
  for (const TriangleMesh& mesh : meshes) append(all, mesh);
  return all;
}

bool is_closed(const TriangleMesh& mesh) {
  bool closed = !mesh.triangles.empty();
  for_each_edge(mesh_edges(mesh), [&](std::span<const EdgeUse> uses) { closed = closed && uses.size() == 2; });
  return closed;
}

/// A mesh that is closed and judged as a whole.
void add_mesh(const Part& part, const IsJudged& is_judged, std::vector<TriangleMesh>& solids) {
  std::vector<int> all;
  for (int face = 0; face < part.face_count(); ++face) {
    if (!is_judged(face)) return;
    all.push_back(face);
  }
  TriangleMesh mesh = extract_mesh(part, all);
  if (is_closed(mesh)) solids.push_back(std::move(mesh));
}

/// The solids all of whose faces are judged, as far as a strip may begin in them.
void add_solids(const Part& part, const IsJudged& is_judged, double chord_mm, const Tool& tool, const Path& path,
                std::vector<TriangleMesh>& solids) {
  if (part.is_mesh()) {
    add_mesh(part, is_judged, solids);
    return;
  }
  std::map<int, std::vector<int>> faces;
  for (int face = 0; face < part.face_count(); ++face) {
    const int solid = part.faces[static_cast<std::size_t>(face)].solid;
    if (solid >= 0) faces[solid].push_back(face);
  }
  for (const auto& [solid, own] : faces) {
    const bool whole =
        std::all_of(own.begin(), own.end(), [&](int face) { return is_judged(face) && !part.is_left_out(face); });
    if (whole && begins_in(box_of(part, own), tool, path)) solids.push_back(joined(part, own, chord_mm));
  }
}

std::vector<TriangleMesh> judged_solids(const Setup& setup, const Tool& tool, const Path& path) {
  std::vector<char> judged(static_cast<std::size_t>(setup.part.face_count()), 0);
  for (const std::vector<int>* faces : {&setup.targets, &setup.checks})
    for (const int face : *faces) judged[static_cast<std::size_t>(face)] = 1;
  std::vector<TriangleMesh> solids;
  const double chord = std::max(setup.tolerance_mm, kRadiusShare * smallest_radius(tool));
  add_solids(
      setup.part, [&](int face) { return judged[static_cast<std::size_t>(face)] != 0; }, chord, tool, path, solids);
  for (const Part& fixture : setup.fixtures)
    add_solids(
        fixture, [](int) { return true; }, chord, tool, path, solids);
  return solids;
}

}  // namespace

std::vector<BuriedStrip> find_buried(const Setup& setup, const Tool& tool, const Path& path,
                                     const std::vector<FaceSamples>& samples) {
  std::vector<BuriedStrip> out = verify::strips_in_solids(judged_solids(setup, tool, path), tool, path);
  std::optional<SweptVolume> volume;  // made for sheets alone
  std::vector<verify::SheetVotes> votes;
  for (const FaceSamples& sheet : samples) {
    if (sheet.of_solid) continue;
    if (!volume) volume.emplace(tool, path);
    votes.push_back(verify::side_votes(*volume, path, sheet, setup.tolerance_mm));
  }
  for (const BuriedStrip& strip : verify::strips_behind(votes)) out.push_back(strip);
  // One reason a strip is enough.
  std::stable_sort(out.begin(), out.end(),
                   [](const BuriedStrip& a, const BuriedStrip& b) { return a.strip < b.strip; });
  out.erase(std::unique(out.begin(), out.end(),
                        [](const BuriedStrip& a, const BuriedStrip& b) { return a.strip == b.strip; }),
            out.end());
  return out;
}

}  // namespace flank::internal
