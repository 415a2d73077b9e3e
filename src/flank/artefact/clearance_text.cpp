#include "flank/artefact/clearance_text.h"

#include <fmt/format.h>

namespace flank::internal {
namespace {

const char* role_words(ObstacleRole role) {
  return role == ObstacleRole::kTarget ? "the target" : role == ObstacleRole::kPart ? "other faces" : "fixtures";
}

}  // namespace

std::string clearance_text(const ClearanceReport& report) {
  std::string text;
  for (const ClearanceFigure& f : report.figures) {
    const bool enters = f.clearance_mm < 0.0;
    const std::string size = enters ? fmt::format("enters {} by {:.4f} mm", role_words(f.role), -f.clearance_mm)
                                    : fmt::format("keeps {:.4f} mm from {}", f.clearance_mm, role_words(f.role));
    text += fmt::format(
        "  {:<11} {}, true to {:.4f} mm: {} at ({:.3f}, {:.3f}, {:.3f}), strip {}, pose {:.2f}, z {:.2f}{}\n",
        body_name(f.body), size, f.bound_mm, f.obstacle, f.point.x(), f.point.y(), f.point.z(), f.strip + 1, f.t,
        f.z_mm,
        f.kept   ? ""
        : enters ? "  COLLISION"
                 : "  TOO NEAR");
  }
  return text;
}

}  // namespace flank::internal
