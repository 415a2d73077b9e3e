#include "flank/bound/part_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "flank/base/atomic_file.h"
#include "flank/bound/contact/contact_map.h"
#include "flank/error.h"
#include "flank/inspect.h"
#include "flank/io/text/json_dump.h"
#include "flank/job/bound_fields.h"
#include "flank/job/input_files.h"
#include "flank/part_page.h"
#include "flank/report.h"
#include "flank/setup/default_tolerance.h"
#include "flank/setup/read_setup.h"
#include "flank/setup/targets.h"
#include "flank/tool_request/tool_spec.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kFewestPoints = 6;      ///< of a face
constexpr double kMostBlocked = 0.5;  ///< of a face's area
constexpr std::array kKinds = {MappedKind::kOnePass, MappedKind::kSeveralPasses, MappedKind::kNotByFlank,
                               MappedKind::kNotExamined};

MappedKind kind_of(const ContactMap& map) {
  if (!map.complete || map.points.empty()) return MappedKind::kNotExamined;
  if (map.blocked_mm2 >= kMostBlocked * map.area_mm2 || map.strips >= kMostFlankPasses) return MappedKind::kNotByFlank;
  return map.strips > 1 || map.blocked_mm2 > 0.0 ? MappedKind::kSeveralPasses : MappedKind::kOnePass;
}

std::unique_ptr<Target> target_of(const Part& part, int face) {
  if (part.is_mesh()) return make_target(extract_mesh(part, {face}));
  return make_target({part.faces[static_cast<std::size_t>(face)]});
}

/// The targets of all faces; null where a face could not be read.
std::vector<std::unique_ptr<Target>> targets_of(const Part& part) {
  std::vector<std::unique_ptr<Target>> all;
  for (int k = 0; k < part.face_count(); ++k) all.push_back(part.is_left_out(k) ? nullptr : target_of(part, k));
  return all;
}

MappedFace mapped(const PartMap& map, int face, const std::vector<std::unique_ptr<Target>>& targets, double total_mm2,
                  const Progress& progress) {
  MappedFace out;
  out.index = face;
  out.id = map.part.face_id(face);
  const Target* target = targets[static_cast<std::size_t>(face)].get();
  if (target == nullptr) return out;
  std::vector<const Target*> others;
  // Faces of the same solid, and whatever stands beside it: a tool must enter none of them.
  for (std::size_t k = 0; k < targets.size(); ++k)
    if (targets[k] && static_cast<int>(k) != face) others.push_back(targets[k].get());
  ContactMapOptions options;
  options.tolerance_mm = *map.job.tolerance_mm;
  const double share = target->area() / total_mm2;
  options.spacing_mm = std::sqrt(target->area() / std::max<double>(kFewestPoints, map.job.points * share));
  options.search.gap = map.job.gap;
  const ContactMap contacts = contact_map(*target, others, map.tool, options, progress);
  out.kind = kind_of(contacts);
  out.area_mm2 = contacts.area_mm2;
  out.not_finished_mm2 = contacts.blocked_mm2;
  out.least_passes = contacts.strips;
  out.points = static_cast<int>(contacts.points.size());
  for (const MapPoint& point : contacts.points) out.longest_mm = std::max(out.longest_mm, point.contact.bound_mm);
  return out;
}

Json face_entry(const MappedFace& face) {
  return {{"face", face.id},
          {"kind", kind_name(face.kind)},
          {"area", face.area_mm2},
          {"not_finished_area", face.not_finished_mm2},
          {"longest_contact", face.longest_mm},
          {"least_passes", face.least_passes},
          {"points", face.points}};
}

/// The page of the faces of a part, with what is proved of each as its kind.
std::string map_page(const PartMap& map) {
  Json page = Json::parse(faces_json(map.part, inspect(map.part)));
  for (Json& row : page["faces"])
    for (const MappedFace& face : map.faces)
      if (row["id"] == face.id) row["type"] = kind_name(face.kind);
  return faces_page(dumped(page) + "\n");
}

}  // namespace

std::string kind_name(MappedKind kind) {
  switch (kind) {
    case MappedKind::kOnePass:
      return "one pass";
    case MappedKind::kSeveralPasses:
      return "several passes";
    case MappedKind::kNotByFlank:
      return "not by flank";
    case MappedKind::kNotExamined:
      break;
  }
  return "not examined";
}

PartMap run_part_map(const BoundJob& request, const Progress& progress) {
  check_fields(request);
  PartMap map;
  map.job = request;
  map.tool = given_tool(request.tool.spec, request.tool.axis_length_mm,
                        "expected a given tool, as cylinder:radius=5 or a tool file", map.notes);
  progress.step("read", 0.0);
  map.part = read_part(request.part.file, request.part.unit);
  const std::vector<std::unique_ptr<Target>> targets = targets_of(map.part);
  double total = 0.0;
  for (const auto& target : targets) total += target ? target->area() : 0.0;
  if (!map.job.tolerance_mm) map.job.tolerance_mm = default_tolerance(map.part.box.diagonal());
  const double count = static_cast<double>(targets.size());
  for (int k = 0; k < map.part.face_count(); ++k) {
    MappedFace face;
    face.index = k;
    face.id = map.part.face_id(k);
    if (!progress.stop()) face = mapped(map, k, targets, total, progress.part(k / count, (k + 1) / count));
    map.complete = map.complete && !progress.stop();
    map.faces.push_back(face);
  }
  for (const std::string& repair : map.part.repairs) map.notes.push_back(repair);
  return map;
}

std::string map_json(const PartMap& map) {
  Json faces = Json::array();
  for (const MappedFace& face : map.faces) faces.push_back(face_entry(face));
  const Json document = {{"schema", "openflank/bound-map/1"},
                         {"units", "mm"},
                         {"command", command_line(map.job)},
                         {"part_sha256", map.part.sha256},
                         {"tool", map.tool.name},
                         {"axis_length", map.tool.radial.axis_length()},
                         {"tolerance", *map.job.tolerance_mm},
                         {"complete", map.complete},
                         {"notes", map.notes},
                         {"faces", faces}};
  return dumped(document, 1) + "\n";
}

std::string map_text(const PartMap& map) {
  std::string text =
      fmt::format("What {} cannot do on {} within {:.4g} mm, face by face, proved at samples\n",
                  map.tool.name.empty() ? "the tool" : map.tool.name, map.part.file, *map.job.tolerance_mm);
  for (const MappedKind kind : kKinds) {
    int count = 0;
    double area = 0.0;
    std::string ids;
    for (const MappedFace& face : map.faces) {
      if (face.kind != kind) continue;
      ++count;
      area += face.area_mm2;
      ids += " " + face.id;
    }
    if (count > 0) text += fmt::format("  {:<15}{:3} faces, {:.4g} mm2:{}\n", kind_name(kind), count, area, ids);
  }
  text += "  one pass: one may be enough; not by flank: half of the face is out of reach, or it needs " +
          std::to_string(kMostFlankPasses) + " passes or more\n";
  for (const std::string& note : map.notes) text += "  note: " + note + "\n";
  return text;
}

void write_part_map(const PartMap& map, const std::string& folder) {
  const ReadFiles inputs = read_files(map.job);
  const Unwritten unwritten(inputs);
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder)) throw InputError(folder + ": is not a folder and cannot be created");
  const auto in = [&](const char* name) { return (fs::path(folder) / name).string(); };
  write_file(in("map.json"), map_json(map));
  write_file(in("map.txt"), map_text(map));
  if (page_is_built()) write_file(in("map.html"), map_page(map));
}

}  // namespace flank::internal
