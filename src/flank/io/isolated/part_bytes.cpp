#include "flank/io/isolated/part_bytes.h"

#include <cstdint>
#include <cstring>
#include <type_traits>

#include "flank/error.h"

namespace flank::internal {
namespace {

/// Appends values to bytes.
class Out {
 public:
  static constexpr bool kReads = false;
  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(const T& value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof value); }
  void operator()(const std::string& text) {
    (*this)(static_cast<std::uint64_t>(text.size()));
    bytes_ += text;
  }
  /// Returns the count.
  std::uint64_t count(std::uint64_t count, std::size_t) {
    (*this)(count);
    return count;
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Takes them again, and never more than there are.
class In {
 public:
  static constexpr bool kReads = true;
  explicit In(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(T& value) {
    require(sizeof value <= bytes_.size());
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_.remove_prefix(sizeof value);
  }
  void operator()(std::string& text) {
    const std::uint64_t size = count(0, 1);
    text.assign(bytes_.substr(0, size));
    bytes_.remove_prefix(size);
  }
  /// Of things that take at least so many bytes each.
  std::uint64_t count(std::uint64_t, std::size_t least) {
    std::uint64_t count = 0;
    (*this)(count);
    require(count <= bytes_.size() / least);
    return count;
  }
  [[nodiscard]] bool empty() const { return bytes_.empty(); }
  static void require(bool right) {
    if (!right) throw InternalError("the answer of the CAD reader contradicts itself");
  }

 private:
  std::string_view bytes_;
};

template <class Stream, class List, class Each>
void each(Stream& stream, List& list, std::size_t least, const Each& visit) {
  const std::uint64_t count = stream.count(list.size(), least);
  if constexpr (Stream::kReads) list.resize(count);
  for (auto& item : list) visit(item);
}

template <class Stream, class List>
void numbers(Stream& stream, List& list) {
  each(stream, list, sizeof(double), [&](auto& x) { stream(x); });
}

template <class Stream, class V>
void point(Stream& stream, V& p) {
  for (int k = 0; k < static_cast<int>(p.size()); ++k) stream(p[k]);
}

/// Knots that never fall, as many as degree and control points need.
bool knots_fit(const std::vector<double>& knots, int degree, int count) {
  if (degree < 1 || degree > kMaxDegree || count <= degree) return false;
  if (knots.size() != static_cast<std::size_t>(count) + static_cast<std::size_t>(degree) + 1) return false;
  for (std::size_t k = 1; k < knots.size(); ++k)
    if (!(knots[k - 1] <= knots[k])) return false;
  return true;
}

template <class Stream, class Surface>
void surface(Stream& stream, Surface& s) {
  stream(s.degree_u), stream(s.degree_v), stream(s.count_u), stream(s.count_v);
  numbers(stream, s.knots_u), numbers(stream, s.knots_v), numbers(stream, s.weights);
  each(stream, s.poles, 3 * sizeof(double), [&](auto& p) { point(stream, p); });
  if constexpr (Stream::kReads) {
    if (s.poles.empty()) return;  // a face that was left out
    Stream::require(knots_fit(s.knots_u, s.degree_u, s.count_u) && knots_fit(s.knots_v, s.degree_v, s.count_v));
    Stream::require(s.poles.size() == static_cast<std::size_t>(s.count_u) * static_cast<std::size_t>(s.count_v));
    Stream::require(s.weights.empty() || s.weights.size() == s.poles.size());
  }
}

template <class Stream, class Curve>
void curve(Stream& stream, Curve& c) {
  stream(c.degree);
  numbers(stream, c.knots), numbers(stream, c.weights);
  const std::uint64_t poles = stream.count(static_cast<std::uint64_t>(c.poles.cols()), 2 * sizeof(double));
  if constexpr (Stream::kReads) c.poles.resize(2, static_cast<Eigen::Index>(poles));
  for (Eigen::Index k = 0; k < c.poles.cols(); ++k) stream(c.poles(0, k)), stream(c.poles(1, k));
  if constexpr (Stream::kReads) {
    Stream::require(knots_fit(c.knots, c.degree, c.count()));
    Stream::require(c.weights.empty() || c.weights.size() == poles);
  }
}

template <class Stream, class AnyFace>
void face(Stream& stream, AnyFace& f) {
  stream(f.id), stream(f.reversed), stream(f.of_solid), stream(f.solid);
  surface(stream, f.surface);
  each(stream, f.loops, 8, [&](auto& loop) { each(stream, loop.edges, 8, [&](auto& c) { curve(stream, c); }); });
}

template <class Stream, class AnyPart>
void whole(Stream& stream, AnyPart& part) {
  stream(part.file), stream(part.format), stream(part.unit), stream(part.millimetres_per_unit), stream(part.solids);
  point(stream, part.box.low), point(stream, part.box.high);
  each(stream, part.faces, 8, [&](auto& f) { face(stream, f); });
  each(stream, part.surface_types, 8, [&](auto& text) { stream(text); });
  each(stream, part.repairs, 8, [&](auto& text) { stream(text); });
}

}  // namespace

std::string encode_part(const Part& part) {
  Out out;
  whole(out, part);
  out(static_cast<std::uint64_t>(part.left_out.size()));
  for (const auto& [face, why] : part.left_out) out(face), out(why);
  return out.take();
}

Part decode_part(std::string_view bytes) {
  In in(bytes);
  Part part;
  whole(in, part);
  for (std::uint64_t k = in.count(0, 12); k > 0; --k) {
    int face = 0;
    in(face);
    In::require(face >= 0 && static_cast<std::size_t>(face) < part.faces.size());
    in(part.left_out[face]);
  }
  In::require(in.empty() && part.surface_types.size() == part.faces.size());
  for (std::size_t k = 0; k < part.faces.size(); ++k)
    In::require(!part.faces[k].surface.poles.empty() || part.left_out.count(static_cast<int>(k)) > 0);
  return part;
}

}  // namespace flank::internal
