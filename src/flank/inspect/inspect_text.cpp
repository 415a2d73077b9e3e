#include "flank/inspect/inspect_text.h"
#include "flank/io/text/json_dump.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

namespace flank::internal {
namespace {

/// A size with so many decimals, and at least two figures: a part in metres that says millimetres is not 0.0 across.
std::string figures(double size, int decimals) {
  if (size < 1e-9 || size >= 9.5 * std::pow(0.1, decimals)) return fmt::format("{:.{}f}", size, decimals);
  return fmt::format("{:.2g}", size);
}

/// Edges of the box, mm.
std::string size_of(const Box3& box) {
  const Vec3 size = box.high - box.low;
  return figures(size.x(), 1) + " x " + figures(size.y(), 1) + " x " + figures(size.z(), 1);
}

/// Of a face the lengths of its two middle lines, of a mesh region its box: triangles have no parameters.
std::string extent_of(const InspectRow& row) {
  return row.triangles > 0 ? size_of(row.box) : figures(row.length_u_mm, 2) + " x " + figures(row.length_v_mm, 2);
}

/// Degrees and counts of poles, which tell why a face is slow or hard to fit.
std::string form_of(const InspectRow& row) {
  if (row.triangles > 0) return fmt::format("{} triangles", row.triangles);
  return fmt::format("{}x{} {}x{}{}", row.degree_u, row.degree_v, row.poles_u, row.poles_v,
                     row.rational ? " rational" : "");
}

std::string trims_of(const InspectRow& row) {
  if (row.triangles > 0) return "-";
  if (row.trims == 0) return "whole";
  return row.holes == 0 ? "trimmed" : fmt::format("trimmed, {} hole{}", row.holes, row.holes == 1 ? "" : "s");
}

/// "convex", or "convex 62% saddle 38%" where it is mixed.
std::string bend_of(const InspectRow& row) {
  if (row.bend != "mixed") return row.bend;
  static constexpr std::array<const char*, 4> kNames = {"flat", "convex", "concave", "saddle"};
  std::string text;
  for (std::size_t i = 0; i < kNames.size(); ++i)
    // What would be shown as 0 % is left out.
    if (row.bend_share[i] >= 0.005)
      text += fmt::format("{}{} {:.0f}%", text.empty() ? "" : " ", kNames[i], 100.0 * row.bend_share[i]);
  return text;
}

/// A number with so many decimals; zero has no sign.
std::string plain(double value, int decimals) {
  const double least = 0.5 * std::pow(0.1, decimals);
  return fmt::format("{:.{}f}", std::abs(value) < least ? 0.0 : value, decimals);
}

/// "12.3, -4.5, 0.0"; more decimals of what is smaller than a millimetre.
std::string place_of(const InspectRow& row) {
  const int decimals = row.box.diagonal() < 1.0 ? 4 : 1;
  return plain(row.centre.x(), decimals) + ", " + plain(row.centre.y(), decimals) + ", " +
         plain(row.centre.z(), decimals);
}

/// "-" where it points nowhere.
std::string normal_of(const InspectRow& row) {
  if (row.normal.isZero()) return "-";
  return plain(row.normal.x(), 2) + ", " + plain(row.normal.y(), 2) + ", " + plain(row.normal.z(), 2);
}

/// One line of the table.
void add_line(const InspectRow& row, std::string& text) {
  if (!row.why.empty()) {
    fmt::format_to(std::back_inserter(text), "{:<5} {:<10} {}\n", row.id, row.type, row.why);
    return;
  }
  const std::string radius =
      std::isfinite(row.smallest_concave_radius_mm) ? figures(row.smallest_concave_radius_mm, 3) : "-";
  const std::string of = row.solid >= 0 ? fmt::format("solid {}", row.solid + 1) : "sheet";
  fmt::format_to(std::back_inserter(text),
                 "{:<5} {:<10} {:<21} {:>10}  {:<22} {:<37} {:>12}  {:<22} {:<19} {:<17} {}\n", row.id, row.type,
                 form_of(row), figures(row.area_mm2, 2), extent_of(row), bend_of(row), radius, place_of(row),
                 normal_of(row), trims_of(row), of);
}

nlohmann::json box_json(const Box3& box) {
  return {{"low", {box.low.x(), box.low.y(), box.low.z()}}, {"high", {box.high.x(), box.high.y(), box.high.z()}}};
}

/// One face with all its figures; what does not apply to its kind has no key, and "none" is null.
nlohmann::json row_json(const InspectRow& row) {
  if (!row.why.empty()) return {{"id", row.id}, {"type", row.type}, {"why", row.why}};
  nlohmann::json json = {{"id", row.id}, {"type", row.type}, {"area", row.area_mm2}, {"box", box_json(row.box)}};
  if (row.triangles > 0) {
    json["triangles"] = row.triangles;
  } else {
    json["degree"] = {row.degree_u, row.degree_v};
    json["poles"] = {row.poles_u, row.poles_v};
    json["rational"] = row.rational;
    json["length"] = {row.length_u_mm, row.length_v_mm};
    json["trims"] = row.trims;
    json["holes"] = row.holes;
  }
  json["bend"] = row.bend;
  json["bend_share"] = {{"flat", row.bend_share[0]},
                        {"convex", row.bend_share[1]},
                        {"concave", row.bend_share[2]},
                        {"saddle", row.bend_share[3]}};
  json["smallest_concave_radius"] =
      std::isfinite(row.smallest_concave_radius_mm) ? nlohmann::json(row.smallest_concave_radius_mm) : nlohmann::json();
  json["centre"] = {row.centre.x(), row.centre.y(), row.centre.z()};
  json["normal"] =
      row.normal.isZero() ? nlohmann::json() : nlohmann::json{row.normal.x(), row.normal.y(), row.normal.z()};
  for (const InspectRow& piece : row.pieces) json["pieces"].push_back(row_json(piece));
  json["solid"] = row.solid >= 0 ? nlohmann::json(row.solid + 1) : nlohmann::json();
  return json;
}

}  // namespace

std::string to_table(const InspectReport& report) {
  std::string text = fmt::format("{}: {}, unit {}, {} solid{}, {} face{}, {} mm\n\n", report.file, report.format,
                                 report.unit, report.solids, report.solids == 1 ? "" : "s", report.rows.size(),
                                 report.rows.size() == 1 ? "" : "s", size_of(report.box));
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{:<5} {:<10} {:<21} {:>10}  {:<22} {:<37} {:>12}  {:<22} {:<19} {:<17} {}\n", "face", "type",
                 "degree, poles", "area mm2", "size mm", "bend", "concave r mm", "centre mm", "normal", "trims", "of");
  for (const InspectRow& row : report.rows) {
    add_line(row, text);
    for (const InspectRow& piece : row.pieces) add_line(piece, text);
  }
  if (!report.repairs.empty()) text += "\nnotes\n";
  for (const std::string& repair : report.repairs) fmt::format_to(out, "- {}\n", repair);
  return text;
}

std::string inspect_to_json(const InspectReport& report) {
  nlohmann::json rows = nlohmann::json::array();
  for (const InspectRow& row : report.rows) rows.push_back(row_json(row));
  const nlohmann::json json = {{"schema", "openflank/inspect/1"},
                               {"units", "mm"},
                               {"file", report.file},
                               {"format", report.format},
                               {"unit", report.unit},
                               {"solids", report.solids},
                               {"box", box_json(report.box)},
                               {"faces", std::move(rows)},
                               {"repairs", report.repairs}};
  return dumped(json, 2) + "\n";
}

}  // namespace flank::internal
