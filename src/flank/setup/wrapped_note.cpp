#include "flank/setup/wrapped_note.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "flank/io/face_groups.h"
#include "flank/io/face_names.h"

namespace flank::internal {

std::string wrapped_note(const Part& part, const std::vector<int>& targets) {
  constexpr std::size_t kNamed = 4;
  std::vector<std::string> notes;
  std::map<int, std::vector<std::string>> in_pieces;  // by number of the face
  for (const int face : targets) {
    const FaceName name = parse_face_name(part.face_id(face));
    if (!name.piece.empty()) in_pieces[name.number].push_back(part.face_id(face));
    std::vector<std::string> pieces;
    for (const NamedPiece& piece : pieces_of_face(part, face)) pieces.push_back(piece.face.id);
    if (!pieces.empty())
      notes.push_back(fmt::format("{} goes round an edge; to machine its pieces one by one: --face {}",
                                  part.face_id(face), fmt::join(pieces, ",")));
  }
  for (const auto& [number, pieces] : in_pieces)
    if (pieces.size() > 2)
      notes.push_back(fmt::format("F{} goes round an edge and is machined in pieces, {}; flank inspect shows them",
                                  number, fmt::join(pieces, ", ")));
  notes.resize(std::min(notes.size(), kNamed));
  return fmt::format("{}", fmt::join(notes, "; "));
}

}  // namespace flank::internal
