/// The judge (MATH section 9): what a tool really leaves when it runs along a path, from tool, poses and part alone.
/// It shares no code with the planner above `tool` and `path`.
///
/// The order of use: samples of every face that matters (sample_face, sample_mesh), judge() over all of them, and
/// beside it judge_clearance for shank, holder and fixtures (clearance_verdict.h) and reachable_shares (reach.h). All
/// lengths in mm, in the part's frame. All of it gives the same bits for any number of threads.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "flank/clearance.h"
#include "flank/face.h"
#include "flank/path.h"
#include "flank/tool.h"
#include "flank/triangle_mesh.h"

namespace flank {

/// Sample points of one face of the part, the judge's own. The vectors are as long as `points`, or empty if they may
/// be.
struct FaceSamples {
  std::string face;     ///< "F1"
  bool target = false;  ///< else a check surface
  std::vector<Vec3> points;
  std::vector<double> areas;  ///< mm^2 that each point stands for
  /// No point of the face is farther than this from a sample, except in cells cut by the border
  double spacing_mm = 0.0;
  std::vector<double> reaches_mm;         ///< of each sample: the farthest point of its cell; empty: spacing_mm
  std::vector<double> curvatures_per_mm;  ///< of each sample: largest |normal curvature|; empty: not known
  std::vector<Vec3>
      normals;            ///< of each sample: unit, away from the material where `of_solid`; of a target towards the
                          ///< side that is machined; empty: not known
  bool of_solid = false;  ///< the face bounds a solid; else it is a sheet, whose normals may point either way
  std::vector<double> reachable;  ///< of each sample: share of its cell that is reachable (reach.h); empty: all of it
  /// Of each sample: not 0 if no border and no kink of the face comes into its cell; empty: not known
  std::vector<char> smooth;
  /// Of each sample: its cell, from-to in u and in v; of a mesh triangle, corner u and v, and size; empty: not known
  std::vector<std::array<double, 4>> cells;
};

/// Samples a trimmed face at cells of about `spacing_mm` (centres of cells), by the judge's own code; points outside
/// the trim are left out. Throws UsageError for a spacing that is not > 0, InputError for a control point that is not
/// finite. The area is that of the face up to the second order in the spacing; cells on the trim count with their share
/// inside.
[[nodiscard]] FaceSamples sample_face(const Face& face, double spacing_mm, bool target);
/// Samples a mesh (or some of its triangles) likewise: each triangle cut into n^2 similar ones, and their centroids.
/// Areas are exact. Curvatures stay unknown, so the sampling bound is of first order. Throws as sample_face.
[[nodiscard]] FaceSamples sample_mesh(const std::string& id, const TriangleMesh& mesh, double spacing_mm, bool target);

/// f(x) = min over strips, t and s of |x - R(s,t)| - r(s), continuous in t and s, and where it is taken.
struct SweptDistance {
  double f = 0.0;  ///< mm; negative: overcut, positive: material left
  int strip = -1;  ///< 0-based; -1: nothing below the horizon
  double t = 0.0;  ///< pose index + fraction
  double s = 0.0;  ///< arc length on the axis, mm, in [0, L]
};

/// Answers f(x) for many points; immutable after construction, so many threads may ask at once. Tool and path are
/// copied. Throws InputError for poses that are none (pose_tree.h) and for a radial function that is none
/// (radial_table.h).
class SweptVolume {
 public:
  SweptVolume(const Tool& tool, const Path& path);
  /// The same tool along another path. What depends on the tool alone is shared: most of the time that a short path takes.
  SweptVolume(const SweptVolume& of_tool, const Path& path);
  ~SweptVolume();
  SweptVolume(SweptVolume&&) noexcept;
  /// Exact to about 1e-9 mm for |f| below `horizon_mm`; farther points return some value >= horizon_mm (or <= -horizon
  /// is exact too).
  [[nodiscard]] SweptDistance distance(const Vec3& x, double horizon_mm = 1e300) const;
  /// The same for many points into out[i]; faster when each point lies close to the one before it. Where two places of
  /// the path are equally near the one named may differ from distance()'s.
  void distances(std::span<const Vec3> points, double horizon_mm, std::span<SweptDistance> out) const;
  /// The same with a horizon for each point.
  void distances(std::span<const Vec3> points, std::span<const double> horizons_mm, std::span<SweptDistance> out) const;
  /// A place of the path whose ball is near x, by descent from `near`, a place that is near a point beside x: f of that
  /// ball alone, so never below distance(x).f, and mostly the same. Fast.
  [[nodiscard]] SweptDistance distance_from(const Vec3& x, const SweptDistance& near) const;
  /// The tool's ball at a place of the path (strip >= 0).
  struct Ball {
    Vec3 center = Vec3::Zero();
    double radius = 0.0;  ///< mm
  };
  [[nodiscard]] Ball ball(const SweptDistance& place) const;
  /// The same ball as it goes from one pose to the next: at each place of the straight way from `from` to `from` + `along` there is one of
  /// this radius or a larger one, but for `off`, mm, by which its centre is beside that way at most.
  struct BallWay {
    Vec3 from = Vec3::Zero(), along = Vec3::Zero();
    double radius = 0.0, off = 0.0;
  };
  [[nodiscard]] BallWay ball_way(const SweptDistance& place) const;
  /// The same over as many poses of its pass as lie within `reach_mm` of the place and keep `off` below `most_off_mm`, its own segment in
  /// any case.
  [[nodiscard]] BallWay ball_way(const SweptDistance& place, double reach_mm, double most_off_mm) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

/// f at every sample of a face, in parallel; the same bits for any number of threads.
[[nodiscard]] std::vector<SweptDistance> swept_distances(const SweptVolume& volume, const FaceSamples& face,
                                                         double horizon_mm);
/// Indices of the samples with |f| <= tolerance.
[[nodiscard]] std::vector<std::size_t> covered_samples(const SweptVolume& volume, const FaceSamples& face,
                                                       double tolerance_mm);

/// Smallest radius of the flank, mm: RadialFunction::smallest().
[[nodiscard]] double smallest_radius(const Tool& tool);

/// How hard a proof tries. The limits are counts, not seconds, so that the answer does not depend on the machine.
struct ProofOptions {
  /// Of the tolerance (of the depth where that is larger): so near does the bound come to the deepest place that was
  /// found, where that costs no more than the proof itself.
  double gap_share = 0.02;
  std::size_t evaluations = 4'000'000;  ///< of f on one face, at most about so many
  std::size_t cells = 1'000'000;        ///< held at once, about 150 bytes each
  /// Of the area: so near does the proved coverage come to the measured one, where the limits allow
  double cover_gap_share = 1e-4;
  std::size_t cover_evaluations = 12;  ///< of a ball, at most about so many for each sample
};

/// How the depth of cuts was judged.
enum class DepthProof {
  kSampled,  ///< at the samples only: what lies between them is bounded, but was not looked at
  kProved,   ///< up to a bound that holds everywhere on the faces, up to their borders
};

struct JudgeOptions {
  double tolerance_mm = 0.01;  ///< > 0
  /// > 0: material left is measured up to this; beyond it is "not machined" and reads as the horizon. A few millimetres
  /// save most of the time on targets that are mostly not machined; coverage and overcut do not depend on it above the
  /// tolerance.
  double horizon_mm = 1e300;
  int histogram_bins = 41;                 ///< >= 1, over [-2, 2] tolerances, ends open; odd: one bin is centred at 0
  int worst_places = 5;                    ///< most of them, of each face and of all together, >= 0
  DepthProof depth = DepthProof::kProved;  ///< kProved needs the faces' shapes
  ProofOptions proof = {};
};

/// A place that is cut too deep, as SweptDistance names it.
struct WorstPlace {
  std::string face;
  Vec3 point = Vec3::Zero();  ///< the sample
  double f = 0.0;             ///< mm, negative
  int strip = -1;
  double t = 0.0, s = 0.0;
};

/// What was found on one face. Figures that say (target) are 0 on a check surface.
struct FaceVerdict {
  std::string face;
  bool target = false;
  double area_mm2 = 0.0;
  int copies = 1;  ///< equal faces that it stands for, itself among them: coverage of all targets counts it so often
  std::size_t samples = 0;
  double overcut_mm = 0.0;             ///< max(0, -f) over the face
  double undercut_mm = 0.0;            ///< max(0, f) over the face (target)
  Vec3 undercut_point = Vec3::Zero();  ///< where that is
  double undercut_covered_mm = 0.0;    ///< largest f over the samples that a strip sweeps past (see judge.md)
  double rms_mm = 0.0;                 ///< of f over the samples that a strip sweeps past
  double coverage = 0.0;               ///< area share with |f| <= tolerance
  double reachable_share = 0.0;        ///< of the area (target)
  double coverage_reachable = 0.0;     ///< the same share of the reachable area alone; 0 where nothing is reachable
  /// Lower bounds of `coverage` and `coverage_reachable`, proved cell by cell (target; needs the face's shape). Areas and
  /// reachable shares are measured.
  double coverage_bound = 0.0, coverage_reachable_bound = 0.0;
  Vec3 uncovered_point =
      Vec3::Zero();             ///< in the cell with the largest area that is measured covered and not proved so
  std::size_t cover_cells = 0;  ///< cells that the proof of coverage looked at
  double spacing_mm = 0.0;
  double sampling_bound_mm = 0.0;  ///< overcut between samples exceeds overcut_mm by no more (judge.md)
  /// Nothing of the face, its borders included, is cut deeper: proved. Of samples alone: overcut_mm + sampling_bound_mm.
  double overcut_bound_mm = 0.0;
  Vec3 bound_point = Vec3::Zero();    ///< about where the face may be cut so deep, if overcut_bound_mm > overcut_mm
  std::size_t proof_cells = 0;        ///< places that the proof looked at
  std::optional<WorstPlace> deepest;  ///< where overcut_mm is; none: nothing is cut
};

/// A cut that was found decides; without one, proofs do.
enum class Verdict {
  kNotRun,
  kPass,      ///< overcut_bound <= tolerance on every face
  kOvercut,   ///< overcut > tolerance on a target, or a strip inside the material
  kGouge,     ///< overcut > tolerance on a check surface
  kUnproved,  ///< no deeper place was found, nor was it proved that there is none
};

/// A strip that runs inside the material, and a place of its axis there, or of the sheet that it is behind.
struct BuriedStrip {
  int strip = -1;  ///< 0-based
  Vec3 point = Vec3::Zero();
};

/// What the strips of one kind did in the replay of a program.
struct StockKind {
  std::string kind;             ///< entry, ramp, plunge, front, back, side, link, ...
  double engagement_deg = 0.0;  ///< the largest, over poses and contact circles
  int strip = -1;               ///< where: 0-based
  std::size_t pose = 0;
  double s = 0.0;  ///< mm, along the axis
  double way_mm = 0.0, volume_mm3 = 0.0;
  /// Entries into full material: their engagement is that of a slot or a hole, and held to no limit.
  [[nodiscard]] bool cuts_a_slot() const { return kind == "ramp" || kind == "plunge"; }
};

/// A whole program replayed in a stock of lines of material, in its order (docs/algorithms/judge.md).
struct StockReport {
  double cell_mm = 0.0;         ///< between lines
  double resolution_deg = 0.0;  ///< what a cell is as engagement at the limit, where the tool is thinnest
  double before_mm3 = 0.0, left_mm3 = 0.0;
  std::vector<StockKind> kinds;
  double uncut_mm = 0.0;  ///< longest stretch of material on a ray from a covered place of a target to mid-cavity
  Vec3 uncut_point = Vec3::Zero();                     ///< where that ray begins
  double entered_mm = 0.0;                             ///< deepest that the stock's surface lies inside a judged face
  std::vector<double> strip_deg, strip_mm3, strip_mm;  ///< of every strip: largest engagement, volume, way
  /// The largest of cycles and entries: kinds front, back and entry.
  [[nodiscard]] double cycles_deg() const;
};

/// A face that is in the file of the part, or of a fixture, and could not be read: nothing is known of what enters it.
struct UnjudgedFace {
  std::string face;  ///< "F3"
  std::string why;   ///< a sentence that names file and face
};

/// A ball that reaches more of the targets than the one that was asked about.
struct FinerReach {
  double radius_mm = 0.0;
  double reachable_share = 0.0;  ///< of the targets' area, by few samples
};

/// The target of which most is left, and what is proved of other tools on it.
struct LeastLeft {
  std::string face;           ///< "F1"
  Vec3 point = Vec3::Zero();  ///< of it: where that is proved
  double left_mm = 0.0;       ///< the most material left of it
  double radius_mm = 0.0;     ///< of tools that have no smaller radius,
  double bound_mm = 0.0;      ///< every one leaves or cuts at least this much there: proved (docs/algorithms/bound.md)
};

/// On which side of targets that bound no material the tool belongs, and why (docs/algorithms/side.md).
struct SheetSide {
  std::string faces;            ///< "F1" or "F1,F2": joined, with one side
  int side = +1;                ///< +1: along the normals of the file, -1: against them
  bool asked = false;           ///< the request says so; else the part's geometry does
  Vec3 towards = Vec3::Zero();  ///< unit, from the sheet to the tool
  Vec3 place = Vec3::Zero();    ///< where that is so: in the middle of the sheet
  std::string reason;           ///< "where the normal of the file points"
};

/// How sharply a motion turns: the largest angle between two of its directions within a stretch of 1 % of the diagonal of the face that
/// the strip names (Strip::face; the largest of several, and of all targets where it names none), tip and upper end of the axis being one
/// curve of six numbers.
struct TurnFigure {
  double angle_deg = 0.0;
  std::size_t strip = 0;      ///< 0-based
  Vec3 point = Vec3::Zero();  ///< the tip where it turns, mm
};

/// What a tool leaves where it bends under the forces of the cut, beside what a stiff one leaves (docs/algorithms/machine.md). By samples of the
/// targets, and only where a load is known.
struct BendingReport {
  double overcut_mm = 0.0, undercut_mm = 0.0;            ///< of a stiff tool
  double bent_overcut_mm = 0.0, bent_undercut_mm = 0.0;  ///< of this one
  double least_mm = 0.0, most_mm = 0.0;                  ///< what bending adds to f
  Vec3 most_point = Vec3::Zero();                        ///< of the face: where it adds most
  std::size_t samples = 0;
};

/// Coverage and undercut have no part in the verdict: how much is enough is for the caller to say.
struct VerifyReport {
  Verdict verdict = Verdict::kNotRun;
  double tolerance_mm = 0.0;
  /// Left on purpose: every f of the report is from the faces moved outwards by this, mm; not filled by judge()
  double allowance_mm = 0.0;
  double coverage = 0.0;                                   ///< area-weighted over the targets
  double reachable_share = 0.0, coverage_reachable = 0.0;  ///< likewise
  /// Lower bounds of coverage, likewise; none if the faces' shapes were not known
  std::optional<double> coverage_bound, coverage_reachable_bound;
  double reach_radius_mm = 0.0;  ///< of the ball that `reachable` of the samples is about; not filled by judge()
  double overcut_mm = 0.0, undercut_mm = 0.0, undercut_covered_mm = 0.0, rms_mm = 0.0;  ///< over the targets
  double gouge_mm = 0.0;           ///< largest overcut on a check surface
  double sampling_bound_mm = 0.0;  ///< the largest of the targets'
  DepthProof depth = DepthProof::kSampled;
  double overcut_bound_mm = 0.0,
         gouge_bound_mm = 0.0;  ///< nothing of the targets, of the check surfaces, is cut deeper
  std::vector<FaceVerdict> faces;
  std::vector<WorstPlace> worst;  ///< most negative f first, over all faces
  std::vector<double> histogram_edges_mm;
  std::vector<double> histogram_area_mm2;  ///< of f over the targets
  /// Strips that run inside a solid or behind a sheet: they may enter no face, so no depth shows them. Not filled by judge()
  std::vector<BuriedStrip> buried;
  std::vector<SheetSide> sheet_sides;  ///< which side of open sheets is machined; not filled by judge()
  /// Faces that nobody could judge and that are not ignored by name. Not filled by judge()
  std::vector<UnjudgedFace> unread_faces;
  ClearanceReport clearance;       ///< of shank, holder and fixtures; not filled by judge()
  std::optional<HoldReport> hold;  ///< whether anything could hold the tool; not filled by judge()
  /// The largest ball, up to that one, that would reach the share of the whole that is asked for, where the path leaves more of it;
  /// not filled by judge()
  std::optional<FinerReach> finer_reach;
  std::optional<LeastLeft>
      least_left;  ///< asked under the same condition; none where nothing is proved; not filled by judge()
  std::optional<TurnFigure> turn;    ///< the sharpest; none where nobody asked; not filled by judge()
  std::optional<StockReport> stock;  ///< of a program with a blank; not filled by judge()
  /// None where nobody asked, or no load is known; not filled by judge()
  std::optional<BendingReport> bending;
};

/// Judges a path by the samples of all its faces, targets and check surfaces. Parallel; the same bits for any number of
/// threads. Throws UsageError for a tolerance that is not > 0 or no bins, InputError for poses or a tool that are none.
/// Does not fill `clearance` and `reach_radius_mm`; `reachable` of the samples is taken as it is.
[[nodiscard]] VerifyReport judge(const Tool& tool, const Path& path, const std::vector<FaceSamples>& faces,
                                 const JudgeOptions& options);

/// A face as it is, for proofs; not owned.
using FaceShape = std::variant<const Face*, const TriangleMesh*>;

/// The same, and a proof of how deep the faces are cut, in cells that hold every place of them, borders included
/// (docs/algorithms/judge.md): shapes[k] is what faces[k] samples. Samples of check surfaces give their area only. Throws
/// InternalError if there are not as many shapes as faces.
[[nodiscard]] VerifyReport judge(const Tool& tool, const Path& path, const std::vector<FaceSamples>& faces,
                                 const std::vector<FaceShape>& shapes, const JudgeOptions& options);

}  // namespace flank
