/// A face in view.json and faces.json: triangles and borders as blocks of bytes (docs/schema/view.md).
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "flank/results/view_mesh.h"

namespace flank::internal {

/// One face as blocks of bytes: a part has a million numbers, which as decimals would make the page many times
/// larger.
[[nodiscard]] nlohmann::ordered_json body_json(const ViewFace& body);

/// Blocks of the file. All numbers are little-endian, whatever the machine.
/// Bytes as base64 (RFC 4648, with padding).
[[nodiscard]] std::string to_base64(const std::vector<std::uint8_t>& bytes);
/// Points as three 16-bit numbers each: 0 and 65535 are the ends of the box.
[[nodiscard]] std::vector<std::uint8_t> quantised(const std::vector<Vec3>& points, const Box3& box);
/// Indices as differences to the one before, small ones in one byte: zigzag, then 7 bits a byte, low ones first, the
/// high bit set where more follow.
[[nodiscard]] std::vector<std::uint8_t> delta_coded(const std::vector<int>& indices);
/// 32-bit IEEE numbers.
[[nodiscard]] std::vector<std::uint8_t> as_floats(const std::vector<double>& values);

}  // namespace flank::internal
