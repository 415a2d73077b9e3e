#include "flank/io/mesh/read_ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>

#include "flank/error.h"
#include "flank/io/mesh/add_polygon.h"
#include "flank/io/text/read_bytes.h"
#include "flank/io/text/read_text.h"

namespace flank::internal {
namespace {

/// Types of a property; kSize has their bytes in this order.
enum class Scalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

constexpr std::array<std::size_t, 8> kSize = {1, 1, 2, 2, 4, 4, 4, 8};

/// One column of an element; a list has a count before its values.
struct Property {
  std::string name;
  Scalar type = Scalar::kFloat;
  std::optional<Scalar> count;  ///< of a list
};

/// A table of the file: "vertex", "face", or one that is skipped.
struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  std::string encoding;
  std::vector<Element> elements;
};

/// Both sets of names are in use: those of the first description of the format, and those with sizes.
Scalar scalar(const TextLines& lines, std::string_view name) {
  static const std::array<std::array<std::string_view, 2>, 8> names = {{{"char", "int8"},
                                                                        {"uchar", "uint8"},
                                                                        {"short", "int16"},
                                                                        {"ushort", "uint16"},
                                                                        {"int", "int32"},
                                                                        {"uint", "uint32"},
                                                                        {"float", "float32"},
                                                                        {"double", "float64"}}};
  for (std::size_t i = 0; i < names.size(); ++i)
    if (name == names[i][0] || name == names[i][1]) return static_cast<Scalar>(i);
  lines.refuse(fmt::format("\"{}\" is not a type of a PLY file", name));
}

/// "property TYPE NAME" or "property list COUNT_TYPE TYPE NAME".
Property property(const TextLines& lines) {
  const bool list = lines.word(1) == "list";
  Property p;
  if (list) p.count = scalar(lines, lines.word(2));
  p.type = scalar(lines, lines.word(list ? 3 : 1));
  p.name = lines.word(list ? 4 : 2);
  return p;
}

/// Lines up to "end_header"; comments and unknown words are passed over. Refuses what the body could not be read by.
Header read_header(TextLines& lines) {
  Header header;
  while (lines.next() && lines.word(0) != "end_header") {
    const std::string_view word = lines.word(0);
    if (word == "format") header.encoding = lines.word(1);
    if (word == "element") {
      const long count = lines.integer(2);
      if (count < 0) lines.refuse("an element count is negative");
      header.elements.push_back({std::string(lines.word(1)), static_cast<std::size_t>(count), {}});
    }
    if (word == "property") {
      if (header.elements.empty()) lines.refuse("a property comes before its element");
      header.elements.back().properties.push_back(property(lines));
    }
  }
  if (lines.word(0) != "end_header") lines.refuse("the header does not end with \"end_header\"; the file is truncated");
  if (header.encoding != "ascii" && header.encoding != "binary_little_endian" && header.encoding != "binary_big_endian")
    lines.refuse(fmt::format("format \"{}\" is not supported; accepted: ascii, binary_little_endian, binary_big_endian",
                             header.encoding));
  // Rows of no bytes would never reach the end of the file.
  for (const Element& element : header.elements)
    if (element.properties.empty() && element.count > 0)
      lines.refuse(fmt::format("the element \"{}\" has no properties", element.name));
  return header;
}

/// The values of the body one after another, from text or from bytes.
class Values {
 public:
  Values(const std::string& file, std::string_view content, const TextLines& after_header, const std::string& encoding)
      : file_(file),
        content_(content),
        at_(after_header.position()),
        lines_(after_header),
        text_(encoding == "ascii"),
        swap_((encoding == "binary_big_endian") == (std::endian::native == std::endian::little)) {}

  /// A row of an element; in text it is a line.
  void begin_row(const std::string& element, std::size_t row) {
    element_ = &element;
    row_ = row;
    word_ = 0;
    if (text_ && !lines_.next()) truncated();
  }

  /// Every type fits a double exactly.
  double next(Scalar type) {
    if (text_) {
      if (word_ >= lines_.words().size()) lines_.refuse(fmt::format("too few values for a {}", *element_));
      return lines_.number(word_++);
    }
    const std::size_t size = kSize[static_cast<std::size_t>(type)];
    if (at_ + size > content_.size()) truncated();
    std::array<char, 8> bytes{};
    std::memcpy(bytes.data(), content_.data() + at_, size);
    if (swap_) std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    at_ += size;
    return decode(type, bytes.data());
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(fmt::format("{}, {} {}: {}", file_, *element_, row_ + 1, why));
  }

 private:
  template <class T>
  /// memcpy, because the bytes of a file are not aligned.
  static double as(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
  }
  static double decode(Scalar type, const char* bytes) {
    switch (type) {
      case Scalar::kInt8:
        return as<std::int8_t>(bytes);
      case Scalar::kUint8:
        return as<std::uint8_t>(bytes);
      case Scalar::kInt16:
        return as<std::int16_t>(bytes);
      case Scalar::kUint16:
        return as<std::uint16_t>(bytes);
      case Scalar::kInt32:
        return as<std::int32_t>(bytes);
      case Scalar::kUint32:
        return as<std::uint32_t>(bytes);
      case Scalar::kFloat:
        return as<float>(bytes);
      default:
        return as<double>(bytes);
    }
  }
  [[noreturn]] void truncated() const { refuse("the file ends here and is truncated; copy or export it again"); }

  const std::string& file_;
  std::string_view content_;
  std::size_t at_;
  TextLines lines_;
  bool text_, swap_;
  const std::string* element_ = nullptr;
  std::size_t row_ = 0, word_ = 0;
};

/// x, y and z count; normals, colours and lists are passed over.
void read_vertex(const Element& element, Values& values, TriangleMesh& mesh) {
  Vec3 p = Vec3::Zero();
  for (const Property& q : element.properties) {
    if (q.count) {
      for (double n = values.next(*q.count); n > 0.0; --n) (void)values.next(q.type);
      continue;
    }
    const double x = values.next(q.type);
    if (q.name.size() == 1 && q.name[0] >= 'x' && q.name[0] <= 'z') p[q.name[0] - 'x'] = x;
  }
  if (!p.allFinite()) values.refuse("a coordinate is not a finite number; expected finite coordinates");
  mesh.vertices.push_back(p);
}

/// Polygons become fans of triangles. Indices come as doubles, so 1e9 or -1 is refused before it is used.
void read_face(const Element& element, Values& values, std::vector<int>& corners, TriangleMesh& mesh) {
  for (const Property& q : element.properties) {
    if (!q.count) {
      (void)values.next(q.type);
      continue;
    }
    const double count = values.next(*q.count);
    const bool corner_list = q.name == "vertex_indices" || q.name == "vertex_index";
    corners.clear();
    for (double i = 0.0; i < count; ++i) {
      const double index = values.next(q.type);
      if (!corner_list) continue;
      if (!(index >= 0.0 && index < static_cast<double>(mesh.vertices.size())))
        values.refuse(fmt::format("vertex {} does not exist; there are {}", index, mesh.vertices.size()));
      corners.push_back(static_cast<int>(index));
    }
    if (!corner_list) continue;
    try {
      add_polygon(mesh, corners.data(), static_cast<int>(corners.size()));
    } catch (const InputError& error) {
      values.refuse(error.what());
    }
  }
}

/// An element that means nothing here still has to be read over: its rows can differ in length.
void skip(const Element& element, Values& values) {
  for (const Property& q : element.properties)
    for (double n = q.count ? values.next(*q.count) : 1.0; n > 0.0; --n) (void)values.next(q.type);
}

}  // namespace

bool looks_ply(std::string_view content) {
  const std::string_view text = without_blanks_in_front(content);
  return text.starts_with("ply\n") || text.starts_with("ply\r");
}

TriangleMesh read_ply(const std::string& file, std::string_view content) {
  TextLines lines(file, content);
  const Header header = read_header(lines);
  Values values(file, content, lines, header.encoding);
  TriangleMesh mesh;
  std::vector<int> corners;
  for (const Element& element : header.elements) {
    for (std::size_t row = 0; row < element.count; ++row) {
      values.begin_row(element.name, row);
      if (element.name == "vertex")
        read_vertex(element, values, mesh);
      else if (element.name == "face")
        read_face(element, values, corners, mesh);
      else
        skip(element, values);
    }
  }
  return mesh;
}

}  // namespace flank::internal
