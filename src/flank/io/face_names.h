/// Names of faces as users write them: F3, F3b, F5-F9; S2, S2-S4 for all faces of solids.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "flank/part.h"

namespace flank::internal {

/// "F12b": number 12, piece "b"; "F12": no piece. Number 0: not the name of a face.
struct FaceName {
  int number = 0;
  std::string piece;
};

/// Either case of letters.
[[nodiscard]] FaceName parse_face_name(std::string_view text);

/// "a", "b", ..., "z", "aa", ... for 0, 1, ...
[[nodiscard]] std::string piece_name(int piece);

/// The items of a list, separated by commas, without blanks around them.
[[nodiscard]] std::vector<std::string> face_list_items(const std::string& list);

/// Whether a list may name faces that could not be read: only one of faces that nobody is to ask for may.
enum class Unread { kRefused, kTaken };

/// Indices of what one item of a list means: F3, F3b, F5-F9, S2, S2-S4. Throws InputError as parse_face_list does.
[[nodiscard]] std::vector<int> parse_face_item(const Part& part, const std::string& item,
                                               Unread unread = Unread::kRefused);

/// parse_face_list, and a choice.
[[nodiscard]] std::vector<int> parse_faces(const Part& part, const std::string& list, Unread unread);

}  // namespace flank::internal
