#include "flank/io/face_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/error.h"
#include "flank/geom/pieces/face_pieces.h"
#include "flank/io/face_names.h"

namespace flank {
using namespace internal;
namespace {

/// Puts pieces in the place of a face: those of higher index move up.
void replace_face(Part& part, int face, std::vector<NamedPiece> pieces) {
  const int more = static_cast<int>(pieces.size()) - 1;
  std::vector<Face> values;
  for (NamedPiece& piece : pieces) values.push_back(std::move(piece.face));
  const std::string type = part.surface_types[static_cast<std::size_t>(face)];
  part.faces.erase(part.faces.begin() + face);
  part.faces.insert(part.faces.begin() + face, values.begin(), values.end());
  part.surface_types.insert(part.surface_types.begin() + face, static_cast<std::size_t>(more), type);
  std::map<int, std::string> left_out;
  for (auto& [k, why] : part.left_out) left_out[k > face ? k + more : k] = std::move(why);
  part.left_out = std::move(left_out);
}

bool has_two_sides(const Part& part, int face) {
  if (part.is_mesh() || !parse_face_name(part.face_id(face)).piece.empty()) return false;
  const Face& whole = part.faces[static_cast<std::size_t>(face)];
  return goes_all_round(whole, face_pieces(whole));
}

}  // namespace

namespace internal {

std::vector<NamedPiece> pieces_of_face(const Part& part, int face) {
  if (part.is_mesh() || part.is_left_out(face)) return {};
  const Face& whole = part.faces[static_cast<std::size_t>(face)];
  if (!parse_face_name(whole.id).piece.empty()) return {};
  std::vector<NamedPiece> named;
  for (FacePiece& piece : face_pieces(whole)) {
    piece.face.id = whole.id + piece_name(static_cast<int>(named.size()));
    named.push_back({std::move(piece.face), piece.edge});
  }
  return named;
}

void split_two_sided(Part& part, const std::string& list) {
  std::vector<int> faces = parse_face_list(part, list);
  std::sort(faces.rbegin(), faces.rend());  // those behind a face that is replaced move up
  for (const int face : faces)
    if (has_two_sides(part, face)) replace_face(part, face, pieces_of_face(part, face));
}

}  // namespace internal

void split_faces(Part& part, const std::string& list) {
  for (const std::string& item : face_list_items(list)) {
    const FaceName name = parse_face_name(item);
    if (name.number < 1 || name.piece.empty()) continue;
    const std::string id = fmt::format("F{}", name.number);
    for (int face = 0; face < part.face_count(); ++face) {
      if (part.face_id(face) != id) continue;
      if (part.is_left_out(face)) throw InputError(part.left_out.at(face));
      std::vector<NamedPiece> pieces = pieces_of_face(part, face);
      if (pieces.empty())
        throw InputError(fmt::format("{}: {} has no piece \"{}\": it does not wrap round an edge; name the whole face",
                                     part.file, id, item));
      replace_face(part, face, std::move(pieces));
      break;
    }
  }
}

}  // namespace flank
