/// Roughing of the channels.
#pragma once

#include <vector>

#include "flank/wheel/wheel_work.h"

namespace flank::internal {

/// How far roughing may let a blade stand free on one side alone, mm: thicknesses of the thinnest one; 0: as far as it likes.
[[nodiscard]] double most_free_mm(const WheelRequest& job, const WheelRoles& roles);

/// Layers over the hub, from the tips' outline down, in all channels of one sector, with a larger tool where one fits between the blades.
/// They keep off the part by an allowance, and by how far the blades differ; the other sectors are turned copies. An operation is as many
/// layers as a blade may stand free: it is run in all sectors before the next one. What is engaged and what stands free is the
/// judge's to tell (pipeline/folder/judge_roughing.h).
[[nodiscard]] std::vector<WheelOperation> rough_operations(WheelWork& work);

}  // namespace flank::internal
