/// Kinds of strips that are told apart (Strip::kind).
#pragma once

namespace flank::internal {

/// The way through the air between two strips of a program.
inline constexpr const char* kLinkKind = "link";

}  // namespace flank::internal
