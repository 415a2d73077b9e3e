/// What is in a part, face by face: the table that a user chooses faces from.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "flank/part.h"

namespace flank {

/// How a surface bends at a point, seen from the machining side. kFlat: both principal curvatures are below kFlatBow.
/// kConvex: it bends away (the tool may be as large as it likes). kConcave: it bends towards the machining side.
/// kSaddle: one of each (negative Gaussian curvature).
enum class Bend { kFlat, kConvex, kConcave, kSaddle };

/// A curvature is flat when an arc of it over the whole size of the face rises by less than about this share of the
/// size (size * curvature).
inline constexpr double kFlatBow = 1e-4;
/// A face is called convex, concave, ... when this share of its samples is; else it is mixed.
inline constexpr double kPureShare = 0.99;

struct InspectRow {
  std::string id;    ///< F1, F2, ...
  std::string type;  ///< plane, cylinder, ..., B-spline as the file has it; mesh; not read
  std::string why;   ///< of a face that could not be read: a sentence. Nothing else is known of it
  int degree_u = 0, degree_v = 0, poles_u = 0, poles_v = 0;  ///< of the B-spline form; 0 for meshes
  bool rational = false;
  int triangles = 0;      ///< of a mesh face
  double area_mm2 = 0.0;  ///< of the trimmed face
  double length_u_mm = 0.0,
         length_v_mm = 0.0;            ///< of the iso-lines through the middle of the trimmed range; 0 for meshes
  Box3 box;                            ///< of the samples and the border
  Vec3 centre = Vec3::Zero();          ///< mean of the face's area, mm; of a bent face it lies beside the face
  Vec3 normal = Vec3::Zero();          ///< mean of the unit normals on the machining side; zero where they cancel
  std::array<double, 4> bend_share{};  ///< share of the samples, by Bend
  std::string bend;                    ///< flat, convex, concave, saddle or mixed; unknown for small mesh faces
  /// Radius of the largest sphere that fits the surface everywhere locally from the machining side; infinite where it
  /// never is concave.
  double smallest_concave_radius_mm = std::numeric_limits<double>::infinity();
  int trims = 0;  ///< loops; 0: the whole parameter rectangle
  int holes = 0;
  /// Of a face that wraps round an edge: its sides and edges, which can be named like faces. `type` says which.
  std::vector<InspectRow> pieces;
  int solid = -1;  ///< 0-based, -1: a sheet, whose machining side is taken as the side of its own normal
};

struct InspectReport {
  std::string file, format, unit;
  int solids = 0;
  Box3 box;
  std::vector<InspectRow> rows;
  std::vector<std::string> repairs;
};

/// Curvatures of a NURBS face are sampled at kInspectGrid + 1 parameters each way.
inline constexpr int kInspectGrid = 48;

[[nodiscard]] InspectReport inspect(const Part& part);

/// Mean unit normals shorter than this point nowhere: of a whole cylinder.
inline constexpr double kLeastMeanNormal = 0.05;

/// Which rows, in which order. Empty: all of them, and as in the file.
struct InspectOrder {
  std::string type;  ///< "B-spline", in any case
  std::string sort;  ///< "face", "area" (largest first), "radius" (tightest concave first) or "type"
};
/// What an order may be sorted by.
[[nodiscard]] const std::vector<std::string>& inspect_sorts();
/// The rows of a report as an order wants them. Throws UsageError for a type that the part has not, with those that it has,
/// and for another order.
[[nodiscard]] InspectReport in_order(InspectReport report, const InspectOrder& order);

/// For people: a header, one line a face, then what was repaired.
[[nodiscard]] std::string inspect_table(const InspectReport& report);
/// Indented JSON, schema "openflank/inspect/1"; lengths in mm, an infinite radius is null.
[[nodiscard]] std::string inspect_json(const InspectReport& report);

}  // namespace flank
