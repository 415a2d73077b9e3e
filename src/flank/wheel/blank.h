/// What a wheel is cut from: a turned body, or a file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/feature/wheel_axis.h"
#include "flank/feature/wheel_roles.h"
#include "flank/part.h"
#include "flank/triangle_mesh.h"

namespace flank::internal {

struct WheelBlank {
  TriangleMesh body;  ///< closed, mm, in the part's frame
  /// Along the axis and radius, mm: nothing of the body is outside of it when it is turned about the axis.
  std::vector<Vec2> outline;
};

/// The least that a turned body about the axis must have to hold the part, and `allowance_mm` all round. Faces of `debris` do not count.
[[nodiscard]] WheelBlank turned_blank(const Part& part, const WheelRoles& roles, double allowance_mm);

/// A closed body from a CAD or mesh file, in the part's frame; `unit` of a mesh that states none. Throws InputError for a file that has no faces.
[[nodiscard]] WheelBlank read_blank(const std::string& file, const std::optional<std::string>& unit,
                                    const WheelAxis& axis);

}  // namespace flank::internal
