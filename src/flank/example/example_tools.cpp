#include "flank/example/example_tools.h"

#include "flank/error.h"

namespace flank::internal {
namespace {

RadialFunction radial(std::string_view name) {
  if (name == "barrel") return {ToolFamily::kBarrel, 40.0, Eigen::Vector3d(80.0, 6.5, 18.0)};  // arc, radius, s0
  if (name == "hyperbolic") return {ToolFamily::kHyperbolic, 42.0, Eigen::Vector3d(4.0, 0.05, 0.006)};
  if (name == "cone") return {ToolFamily::kCone, 50.0, Eigen::Vector2d(3.5, 0.105)};  // radius, angle: 6 degrees
  if (name == "spline") return RadialFunction::spline(36.0, Eigen::Vector4d(3.5, 7.5, 3.8, 6.5));
  throw InternalError("no example tool is called " + std::string(name));
}

}  // namespace

Tool example_tool(std::string_view name) {
  Tool tool;
  tool.radial = radial(name);
  tool.name = std::string(name);
  return tool;
}

}  // namespace flank::internal
