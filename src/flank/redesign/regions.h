/// Which border of a face is root, tip, leading and trailing edge, and how much deviation counts near it.
#pragma once

#include <string>
#include <vector>

#include "flank/part.h"
#include "flank/radial_function.h"
#include "flank/ruled_motion.h"
#include "flank/target.h"

namespace flank::internal {

/// "le" and 10 of "le=10".
struct WeightRequest {
  std::string border;  ///< le, te, root, tip, or the id of a neighbouring face
  double factor = 1.0;
};

/// Reads "le=10,root=0.2,F7=3". Throws UsageError of the field `weight`.
[[nodiscard]] std::vector<WeightRequest> parse_weights(const std::string& text);

/// One of the four sides of a face, seen from the tool that machines it.
struct BorderSide {
  std::vector<Vec3> points;
  std::vector<std::string> faces;  ///< neighbours along it
  double radius_mm = 0.0;  ///< typical least radius of curvature of these neighbours there; 0: no neighbour, or flat
};

/// Root is where the tip of the tool runs, tip where its upper end does; of the other two sides the leading edge is the blunter one.
struct FaceBorders {
  BorderSide root, tip, leading, trailing;
  bool edges_alike = false;  ///< leading and trailing edge are about as blunt: which is which is a guess
  std::vector<std::pair<std::string, std::vector<Vec3>>> neighbours;  ///< each with the border that it shares
};

/// `motion`, `radial`: what machines the face. `face`: index of it in the part.
[[nodiscard]] FaceBorders find_borders(const Part& part, int face, const Target& target, const RuledMotion& motion,
                                       const RadialFunction& radial);

/// How much a deviation counts at a point of a face: 1, and near a border the factor that was asked for.
class FaceWeights {
 public:
  /// Throws UsageError of the field `weight` for what the face does not have.
  FaceWeights(const std::vector<WeightRequest>& requests, const FaceBorders& borders, double size_mm);
  [[nodiscard]] double at(const Vec3& p) const;

 private:
  struct Near {
    std::vector<Vec3> points;
    double factor = 1.0;
  };
  std::vector<Near> near_;
  double width_mm_;
};

}  // namespace flank::internal
