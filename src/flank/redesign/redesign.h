/// What a redesign found and made, as files (docs/schema/redesign.md).
#pragma once

#include <string>
#include <vector>

#include "flank/io/cad/replace_face.h"
#include "flank/job/redesign_job.h"
#include "flank/redesign/blade_tables.h"
#include "flank/run.h"

namespace flank::internal {

/// Of the size of a face: a tool that leaves it to this leaves it exactly.
inline constexpr double kExactOfSize = 1e-6;

/// How exactly the new tool and motions leave the new faces, by the judge.
struct Exactness {
  double tolerance_mm = 0.0;               ///< kExactOfSize of the diagonal of the first face
  double share = 0.0;                      ///< of the area of the new faces that is left within it
  double overcut_mm = 0.0, left_mm = 0.0;  ///< deepest cut, most material left, anywhere on them
};

struct Redesign {
  RedesignJob job;
  double tolerance_mm = 0.0;  ///< that was used
  std::string part_sha256;
  std::vector<FaceTables> faces;
  std::vector<std::string> new_ids;      ///< of the faces in redesigned.step
  std::vector<double> gap_mm;            ///< of each: its borders as the neighbours have them, from the new surface
  std::vector<double> moved_mm;          ///< of each: its new borders, from the old ones
  std::vector<double> surface_error_mm;  ///< of each: spline from exact envelope
  double largest_c = 0.0;
  std::string not_joined;  ///< why there is no redesigned.step; empty where there is one
  CheckedSolids checked;   ///< of redesigned.step
  int solids_before = 0;   ///< of the part, that the checker finds valid
  Exactness exact;
  double thickness_missed_mm = 0.0;  ///< by which --thickness-min is missed, at most
  std::vector<std::string> notes;
  Result result;  ///< tool and motions, judged against the faces as they were: the map of the deviation
  std::string step, faces_step, guide;  ///< texts of redesigned.step, face.step, guide.txt
  /// A solid where there was one, left exactly, no thinner than was asked for.
  [[nodiscard]] bool met() const;
  [[nodiscard]] bool solid_valid() const {
    return not_joined.empty() && checked.valid >= solids_before && checked.shape_valid;
  }
};

/// redesign.json, a few lines for people, and the tables.
[[nodiscard]] std::string redesign_json(const Redesign& redesign);
[[nodiscard]] std::string redesign_text(const Redesign& redesign);
[[nodiscard]] std::string deviation_csv(const Redesign& redesign);
[[nodiscard]] std::string sections_csv(const Redesign& redesign);

}  // namespace flank::internal
