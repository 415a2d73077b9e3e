#include "flank/io/face_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "flank/error.h"

namespace flank {
using namespace internal;
namespace {

/// The number of the last face of the file.
int last_number(const Part& part) {
  return part.face_count() == 0 ? 0 : parse_face_name(part.face_id(part.face_count() - 1)).number;
}

[[noreturn]] void refuse_name(const Part& part, std::string_view name) {
  const int last = last_number(part);
  const std::string known = last == 1 ? "one face, F1" : fmt::format("F1 to F{}", last);
  throw InputError(fmt::format("{}: no face \"{}\"; the part has {} (see flank inspect)", part.file, name, known));
}

/// The number in "S3", 0 if it is not the name of a solid.
int parse_solid_name(std::string_view text) {
  int number = 0;
  if (text.size() < 2 || (text.front() != 'S' && text.front() != 's')) return 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + 1, end, number);
  return error == std::errc() && stop == end ? std::max(0, number) : 0;
}

/// Faces of S2, or of S2-S4.
std::vector<int> faces_of_solids(const Part& part, const std::string& item, Unread unread) {
  const std::size_t dash = item.find('-');
  const int first = parse_solid_name(std::string_view(item).substr(0, dash));
  const int last = dash == std::string::npos ? first : parse_solid_name(std::string_view(item).substr(dash + 1));
  if (first < 1 || last < first || last > part.solids)
    throw InputError(fmt::format("{}: no solid \"{}\"; {}", part.file, item,
                                 part.solids > 0 ? fmt::format("the part has S1 to S{}", part.solids)
                                                 : "the file has no solids; its faces are F1, F2 and so on"));
  std::vector<int> faces;
  for (std::size_t k = 0; k < part.faces.size(); ++k) {
    const Face& face = part.faces[k];
    const bool named = face.of_solid && face.solid >= first - 1 && face.solid <= last - 1;
    if (named && (unread == Unread::kTaken || !part.is_left_out(static_cast<int>(k))))
      faces.push_back(static_cast<int>(k));
  }
  return faces;
}

void refuse_left_out(const Part& part, int face) {
  if (const auto why = part.left_out.find(face); why != part.left_out.end()) throw InputError(why->second);
}

/// Faces of numbers from `first` to `last`, whole or in pieces.
std::vector<int> numbered(const Part& part, int first, int last) {
  std::vector<int> faces;
  for (int face = 0; face < part.face_count(); ++face) {
    const int number = parse_face_name(part.face_id(face)).number;
    if (number >= first && number <= last) faces.push_back(face);
  }
  return faces;
}

}  // namespace

namespace internal {

FaceName parse_face_name(std::string_view text) {
  FaceName name;
  if (text.size() < 2 || (text.front() != 'F' && text.front() != 'f')) return name;
  int number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + 1, end, number);
  if (error != std::errc() || number < 1) return name;
  for (const char* at = stop; at != end; ++at) {
    const unsigned char letter = static_cast<unsigned char>(*at);
    if (!std::isalpha(letter)) return {};
    name.piece += static_cast<char>(std::tolower(letter));
  }
  name.number = number;
  return name;
}

std::string piece_name(int piece) {
  const std::string last(1, static_cast<char>('a' + piece % 26));
  return piece < 26 ? last : piece_name(piece / 26 - 1) + last;
}

std::vector<std::string> face_list_items(const std::string& list) {
  std::vector<std::string> items;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    std::string_view item = std::string_view(list).substr(begin, end - begin);
    while (!item.empty() && item.front() == ' ') item.remove_prefix(1);
    while (!item.empty() && item.back() == ' ') item.remove_suffix(1);
    items.emplace_back(item);
    begin = end + 1;
  }
  return items;
}

std::vector<int> parse_face_item(const Part& part, const std::string& item, Unread unread) {
  if (!item.empty() && (item.front() == 'S' || item.front() == 's')) return faces_of_solids(part, item, unread);
  const std::size_t dash = item.find('-');
  const FaceName first = parse_face_name(std::string_view(item).substr(0, dash));
  if (first.number < 1 || first.number > last_number(part)) refuse_name(part, item);
  std::vector<int> faces;
  if (dash != std::string::npos) {
    const FaceName last = parse_face_name(std::string_view(item).substr(dash + 1));
    const bool whole = first.piece.empty() && last.piece.empty();
    if (!whole || last.number < first.number || last.number > last_number(part)) refuse_name(part, item);
    faces = numbered(part, first.number, last.number);
  } else if (first.piece.empty()) {
    faces = numbered(part, first.number, first.number);
  } else {
    const std::string id = fmt::format("F{}{}", first.number, first.piece);
    for (int face = 0; face < part.face_count(); ++face)
      if (part.face_id(face) == id) faces.push_back(face);
    if (faces.empty())
      throw InputError(fmt::format("{}: no piece \"{}\" of F{} (see flank inspect)", part.file, item, first.number));
  }
  if (unread == Unread::kRefused)
    for (const int face : faces) refuse_left_out(part, face);
  return faces;
}

std::vector<int> parse_faces(const Part& part, const std::string& list, Unread unread) {
  std::vector<int> faces;
  for (const std::string& item : face_list_items(list)) {
    for (const int face : parse_face_item(part, item, unread)) {
      if (std::find(faces.begin(), faces.end(), face) != faces.end())
        throw InputError(fmt::format("{}: face \"{}\" is named twice in \"{}\"; name each face once", part.file,
                                     part.face_id(face), list));
      faces.push_back(face);
    }
  }
  return faces;
}

}  // namespace internal

std::vector<int> parse_face_list(const Part& part, const std::string& list) {
  return parse_faces(part, list, Unread::kRefused);
}

}  // namespace flank
