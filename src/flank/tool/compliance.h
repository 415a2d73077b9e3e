/// How a tool bends under a force at its tip: an elastic beam, clamped at its upper end.
#pragma once

#include <Eigen/Core>

#include "flank/tool.h"

namespace flank::internal {

/// The integral over the axis of s^2 / r(s)^4 ds, 1/mm, s from the tip: times 4 F / (pi E) it is the deflection of the
/// tip under a force F across it (Euler and Bernoulli; I = pi r^4 / 4). Exact to about 1e-10 of itself for a tool whose
/// radius does not halve within a fiftieth of its length. Infinite if r is not positive somewhere it is evaluated.
[[nodiscard]] double compliance(const RadialFunction& radial);

/// The same with its derivative by the parameters of the radial function.
[[nodiscard]] double compliance(const RadialFunction& radial, Eigen::VectorXd& gradient);

/// Where the tool is clamped: where its holder begins, without a holder at the upper end of its shank, or of its flank. s, mm.
[[nodiscard]] double clamped_at(const Tool& tool);

/// How far a force of one newton across the axis at height `force_at` moves the axis at height `moved_at`, across it too, mm: flank and
/// shank bend as a beam of cemented carbide, clamped at clamped_at(). The same for the two heights exchanged; 0 above the clamp.
[[nodiscard]] double influence_mm(const Tool& tool, double force_at, double moved_at);

/// Slenderness L / d of the cylinder with the same length L and the same compliance c: d / 2 is (L^3 / (3 c))^(1/4).
[[nodiscard]] double slenderness(double length_mm, double compliance_per_mm);

}  // namespace flank::internal
