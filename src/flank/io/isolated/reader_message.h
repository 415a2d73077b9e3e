/// What the child that reads a CAD file and its parent have agreed on: one byte, then a part, or a text.
#pragma once

namespace flank::internal {

inline constexpr int kReaderPipe = 3;         ///< the child's descriptor
inline constexpr char kReaderPart = 'P',      ///< bytes of encode_part
    kReaderRefuses = 'R',                     ///< message of an InputError
    kReaderMemory = 'M', kReaderFault = 'F';  ///< out of memory; what should not happen

}  // namespace flank::internal
