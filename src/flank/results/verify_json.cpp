#include "flank/results/verify_json.h"

#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "flank/error.h"
#include "flank/io/text/json_dump.h"
#include "flank/results/cavity/stock_json.h"

namespace flank::internal {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kSchema = "openflank/verify/1";

/// The one list of names: writing and reading both look here, so that they cannot differ.
constexpr std::array<std::pair<Verdict, std::string_view>, 5> kVerdicts{{{Verdict::kNotRun, "not_run"},
                                                                         {Verdict::kPass, "pass"},
                                                                         {Verdict::kOvercut, "overcut"},
                                                                         {Verdict::kGouge, "gouge"},
                                                                         {Verdict::kUnproved, "unproved"}}};

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::string_view kMinusInfinity = "-infinity", kNoNumber = "nan";

/// JSON has no infinity: null stands for it, because distances of what nothing comes near are infinite. What else is not
/// finite is a fault of ours that must not be read as that.
Json number(double value) {
  if (std::isnan(value)) return kNoNumber;
  if (value == -kInfinity) return kMinusInfinity;
  return value == kInfinity ? Json(nullptr) : Json(value);
}

/// The other way round.
double to_number(const Json& j) {
  if (j.is_null()) return kInfinity;
  if (!j.is_string()) return j.get<double>();
  const auto word = j.get<std::string>();
  if (word == kMinusInfinity) return -kInfinity;
  if (word == kNoNumber) return std::numeric_limits<double>::quiet_NaN();
  throw InputError("\"" + word + "\" is not a figure");
}

Json point(const Vec3& p) { return {number(p.x()), number(p.y()), number(p.z())}; }

Vec3 to_point(const Json& p) { return {to_number(p.at(0)), to_number(p.at(1)), to_number(p.at(2))}; }

/// Strips are counted from 1 in files, as people count, and from 0 in reports; null is no strip.
Json to_json(const WorstPlace& w) {
  return {{"face", w.face},      {"point", point(w.point)},
          {"f_mm", number(w.f)}, {"strip", w.strip < 0 ? Json(nullptr) : Json(w.strip + 1)},
          {"t", number(w.t)},    {"s_mm", number(w.s)}};
}

Json to_json(const BendingReport& b) {
  return {{"overcut_mm", number(b.overcut_mm)},           {"undercut_mm", number(b.undercut_mm)},
          {"bent_overcut_mm", number(b.bent_overcut_mm)}, {"bent_undercut_mm", number(b.bent_undercut_mm)},
          {"least_added_mm", number(b.least_mm)},         {"most_added_mm", number(b.most_mm)},
          {"most_added_point", point(b.most_point)},      {"samples", b.samples}};
}

BendingReport bending_from(const Json& j) {
  return {.overcut_mm = to_number(j.at("overcut_mm")),
          .undercut_mm = to_number(j.at("undercut_mm")),
          .bent_overcut_mm = to_number(j.at("bent_overcut_mm")),
          .bent_undercut_mm = to_number(j.at("bent_undercut_mm")),
          .least_mm = to_number(j.at("least_added_mm")),
          .most_mm = to_number(j.at("most_added_mm")),
          .most_point = to_point(j.at("most_added_point")),
          .samples = j.at("samples").get<std::size_t>()};
}

/// at() throws for a field that is missing, get() for one of the wrong type: verify_from_json names the file.
WorstPlace place_from(const Json& j) {
  WorstPlace w;
  w.face = j.at("face").get<std::string>();
  w.point = to_point(j.at("point"));
  w.f = to_number(j.at("f_mm"));
  w.strip = j.at("strip").is_null() ? -1 : j.at("strip").get<int>() - 1;
  w.t = to_number(j.at("t"));
  w.s = to_number(j.at("s_mm"));
  return w;
}

Json to_json(const BuriedStrip& b) { return {{"strip", b.strip + 1}, {"point", point(b.point)}}; }

BuriedStrip buried_from(const Json& j) {
  const Json& p = j.at("point");
  return {j.at("strip").get<int>() - 1, {to_number(p.at(0)), to_number(p.at(1)), to_number(p.at(2))}};
}

SheetSide sheet_side_from(const Json& j) {
  const auto point = [&](const char* key) {
    const Json& p = j.at(key);
    return Vec3(to_number(p.at(0)), to_number(p.at(1)), to_number(p.at(2)));
  };
  const auto side = j.at("side").get<std::string>();
  if (side != "+" && side != "-") throw InputError("\"" + side + "\" is not a side; expected + or -");
  return {j.at("faces").get<std::string>(),
          side == "-" ? -1 : +1,
          j.at("asked").get<bool>(),
          point("towards"),
          point("place"),
          j.at("reason").get<std::string>()};
}

Json to_json(const FaceVerdict& f) {
  Json j = {{"face", f.face},
            {"target", f.target},
            {"area_mm2", number(f.area_mm2)},
            {"samples", f.samples},
            {"spacing_mm", number(f.spacing_mm)},
            {"overcut_mm", number(f.overcut_mm)},
            {"undercut_mm", number(f.undercut_mm)},
            {"undercut_point", point(f.undercut_point)},
            {"undercut_covered_mm", number(f.undercut_covered_mm)},
            {"rms_mm", number(f.rms_mm)},
            {"coverage", number(f.coverage)},
            {"reachable_share", number(f.reachable_share)},
            {"coverage_reachable", number(f.coverage_reachable)},
            {"coverage_bound", number(f.coverage_bound)},
            {"coverage_reachable_bound", number(f.coverage_reachable_bound)},
            {"uncovered_point", point(f.uncovered_point)},
            {"cover_cells", f.cover_cells},
            {"sampling_bound_mm", number(f.sampling_bound_mm)},
            {"overcut_bound_mm", number(f.overcut_bound_mm)},
            {"bound_point", point(f.bound_point)},
            {"proof_cells", f.proof_cells}};
  if (f.copies > 1) j["copies"] = f.copies;
  // Absent where nothing is cut: there is no deepest place then.
  if (f.deepest) j["deepest"] = to_json(*f.deepest);
  return j;
}

FaceVerdict face_from(const Json& j) {
  FaceVerdict f;
  f.face = j.at("face").get<std::string>();
  f.target = j.at("target").get<bool>();
  f.area_mm2 = to_number(j.at("area_mm2"));
  f.copies = j.value("copies", 1);
  f.samples = j.at("samples").get<std::size_t>();
  f.spacing_mm = to_number(j.at("spacing_mm"));
  f.overcut_mm = to_number(j.at("overcut_mm"));
  f.undercut_mm = to_number(j.at("undercut_mm"));
  if (j.contains("undercut_point")) f.undercut_point = to_point(j.at("undercut_point"));
  f.undercut_covered_mm = to_number(j.at("undercut_covered_mm"));
  f.rms_mm = to_number(j.at("rms_mm"));
  f.coverage = to_number(j.at("coverage"));
  f.reachable_share = to_number(j.at("reachable_share"));
  f.coverage_reachable = to_number(j.at("coverage_reachable"));
  if (j.contains("coverage_bound")) {
    f.coverage_bound = to_number(j.at("coverage_bound"));
    f.coverage_reachable_bound = to_number(j.at("coverage_reachable_bound"));
    f.uncovered_point = to_point(j.at("uncovered_point"));
    f.cover_cells = j.at("cover_cells").get<std::size_t>();
  }
  f.sampling_bound_mm = to_number(j.at("sampling_bound_mm"));
  f.overcut_bound_mm = to_number(j.at("overcut_bound_mm"));
  f.bound_point = to_point(j.at("bound_point"));
  f.proof_cells = j.at("proof_cells").get<std::size_t>();
  if (j.contains("deepest")) f.deepest = place_from(j.at("deepest"));
  return f;
}

Json to_json(const ClearanceFigure& f) {
  return {{"body", body_name(f.body)},
          {"against", role_name(f.role)},
          {"clearance_mm", number(f.clearance_mm)},
          {"bound_mm", number(f.bound_mm)},
          {"required_mm", number(f.required_mm)},
          {"kept", f.kept},
          {"obstacle", f.obstacle},
          {"point", point(f.point)},
          {"strip", f.strip < 0 ? Json(nullptr) : Json(f.strip + 1)},
          {"t", number(f.t)},
          {"z_mm", number(f.z_mm)},
          {"rho_mm", number(f.rho_mm)}};
}

Json to_json(const ClearanceReport& report) {
  Json list = Json::array();
  for (const ClearanceFigure& f : report.figures) list.push_back(to_json(f));
  return list;
}

/// The value of an enumeration whose name this is: by asking each for its name, which is written in one place only.
template <class Name, class Value, std::size_t N>
Value value_named(const std::string& name, const std::array<Value, N>& values, const Name& name_of) {
  for (Value value : values)
    if (name_of(value) == name) return value;
  throw InputError("clearance: \"" + name + "\" is not known here");
}

ClearanceFigure clearance_from(const Json& j) {
  ClearanceFigure f;
  f.body = value_named(j.at("body").get<std::string>(),
                       std::array{ToolBody::kFlank, ToolBody::kShank, ToolBody::kHolder, ToolBody::kAxis}, body_name);
  f.role = value_named(j.at("against").get<std::string>(),
                       std::array{ObstacleRole::kTarget, ObstacleRole::kPart, ObstacleRole::kFixture}, role_name);
  f.clearance_mm = to_number(j.at("clearance_mm"));
  f.bound_mm = to_number(j.at("bound_mm"));
  f.required_mm = to_number(j.at("required_mm"));
  f.kept = j.at("kept").get<bool>();
  f.obstacle = j.at("obstacle").get<std::string>();
  f.point = to_point(j.at("point"));
  f.strip = j.at("strip").is_null() ? -1 : j.at("strip").get<int>() - 1;
  f.t = to_number(j.at("t"));
  f.z_mm = to_number(j.at("z_mm"));
  f.rho_mm = to_number(j.at("rho_mm"));
  return f;
}

Verdict verdict_from(const std::string& name) {
  for (const auto& [verdict, known] : kVerdicts)
    if (known == name) return verdict;
  throw InputError("verdict \"" + name + "\"; expected not_run, pass, overcut, gouge or unproved");
}

DepthProof depth_from(const std::string& name) {
  for (DepthProof depth : {DepthProof::kSampled, DepthProof::kProved})
    if (name == depth_name(depth)) return depth;
  throw InputError("depth \"" + name + "\"; expected proved or sampled");
}

VerifyReport report_from(const Json& j) {
  const auto schema = j.at("schema").get<std::string>();
  // Fields of another version may have the same names and other meanings.
  if (schema != kSchema) throw InputError("schema \"" + schema + "\"; expected " + std::string(kSchema));
  if (j.value("units", "mm") != "mm") throw InputError("units: expected \"mm\"");
  VerifyReport r;
  r.verdict = verdict_from(j.at("verdict").get<std::string>());
  r.tolerance_mm = to_number(j.at("tolerance_mm"));
  if (j.contains("allowance_mm")) r.allowance_mm = to_number(j.at("allowance_mm"));
  r.coverage = to_number(j.at("coverage"));
  r.reachable_share = to_number(j.at("reachable_share"));
  r.coverage_reachable = to_number(j.at("coverage_reachable"));
  if (j.contains("coverage_bound")) {
    r.coverage_bound = to_number(j.at("coverage_bound"));
    r.coverage_reachable_bound = to_number(j.at("coverage_reachable_bound"));
  }
  r.reach_radius_mm = to_number(j.at("reach_radius_mm"));
  r.overcut_mm = to_number(j.at("overcut_mm"));
  r.undercut_mm = to_number(j.at("undercut_mm"));
  r.undercut_covered_mm = to_number(j.at("undercut_covered_mm"));
  r.rms_mm = to_number(j.at("rms_mm"));
  r.gouge_mm = to_number(j.at("gouge_mm"));
  r.sampling_bound_mm = to_number(j.at("sampling_bound_mm"));
  r.depth = depth_from(j.at("depth").get<std::string>());
  r.overcut_bound_mm = to_number(j.at("overcut_bound_mm"));
  r.gouge_bound_mm = to_number(j.at("gouge_bound_mm"));
  for (const Json& f : j.at("faces")) r.faces.push_back(face_from(f));
  for (const Json& w : j.at("worst_places")) r.worst.push_back(place_from(w));
  for (const Json& e : j.at("histogram").at("edges_mm")) r.histogram_edges_mm.push_back(to_number(e));
  for (const Json& a : j.at("histogram").at("area_mm2")) r.histogram_area_mm2.push_back(to_number(a));
  // Who draws a bin takes its two edges without asking.
  if (!r.histogram_edges_mm.empty() && r.histogram_edges_mm.size() != r.histogram_area_mm2.size() + 1)
    throw InputError("a histogram of " + std::to_string(r.histogram_area_mm2.size()) + " bins with " +
                     std::to_string(r.histogram_edges_mm.size()) + " edges; expected one edge more than bins");
  // Files of results without shank, holder or fixtures have none; nor is there a stock where no cavity was replayed.
  if (j.contains("clearance"))
    for (const Json& c : j.at("clearance")) r.clearance.figures.push_back(clearance_from(c));
  if (j.contains("sides"))
    for (const Json& s : j.at("sides")) r.sheet_sides.push_back(sheet_side_from(s));
  if (j.contains("buried"))
    for (const Json& b : j.at("buried")) r.buried.push_back(buried_from(b));
  if (j.contains("unread_faces"))
    for (const Json& f : j.at("unread_faces"))
      r.unread_faces.push_back({f.at("face").get<std::string>(), f.at("why").get<std::string>()});
  if (j.contains("hold")) {
    const Json& hold = j.at("hold");
    r.hold.emplace().axis = clearance_from(hold.at("axis"));
    if (hold.contains("as_thick")) r.hold->as_thick = clearance_from(hold.at("as_thick"));
  }
  if (j.contains("least_left")) {
    const Json& left = j.at("least_left");
    r.least_left = {left.at("face").get<std::string>(), to_point(left.at("point")), to_number(left.at("left_mm")),
                    to_number(left.at("radius_mm")), to_number(left.at("bound_mm"))};
  }
  if (j.contains("finer_reach"))
    r.finer_reach = {to_number(j.at("finer_reach").at("radius_mm")),
                     to_number(j.at("finer_reach").at("reachable_share"))};
  if (j.contains("turn")) {
    const Json& turn = j.at("turn");
    r.turn = {to_number(turn.at("angle_deg")), turn.at("strip").get<std::size_t>() - 1, to_point(turn.at("point"))};
  }
  if (j.contains("stock")) r.stock = stock_from_json(j.at("stock"));
  if (j.contains("bending")) r.bending = bending_from(j.at("bending"));
  return r;
}

}  // namespace

std::string_view verdict_name(Verdict verdict) {
  for (const auto& [known, name] : kVerdicts)
    if (known == verdict) return name;
  return "not_run";
}

std::string_view depth_name(DepthProof depth) { return depth == DepthProof::kProved ? "proved" : "sampled"; }

Json clearance_to_json(const ClearanceReport& report) { return to_json(report); }

Json sheet_side_to_json(const SheetSide& s) {
  return {{"faces", s.faces},        {"side", s.side > 0 ? "+" : "-"},
          {"asked", s.asked},        {"towards", point(s.towards)},
          {"place", point(s.place)}, {"reason", s.reason}};
}

std::string verify_to_json(const VerifyReport& r, const Acceptance& acceptance) {
  // Over all faces; written for people, and not read back, since the faces have their own.
  std::size_t samples = 0;
  for (const FaceVerdict& f : r.faces) samples += f.samples;
  Json j = {{"schema", kSchema},
            {"units", "mm"},
            {"verdict", verdict_name(r.verdict)},
            {"pass", acceptance.pass()},
            {"reasons", Json::array()},
            {"cautions", Json::array()},
            {"tolerance_mm", number(r.tolerance_mm)},
            {"coverage", number(r.coverage)},
            {"reachable_share", number(r.reachable_share)},
            {"coverage_reachable", number(r.coverage_reachable)},
            {"reach_radius_mm", number(r.reach_radius_mm)},
            {"overcut_mm", number(r.overcut_mm)},
            {"undercut_mm", number(r.undercut_mm)},
            {"undercut_covered_mm", number(r.undercut_covered_mm)},
            {"rms_mm", number(r.rms_mm)},
            {"gouge_mm", number(r.gouge_mm)},
            {"sampling_bound_mm", number(r.sampling_bound_mm)},
            {"depth", depth_name(r.depth)},
            {"overcut_bound_mm", number(r.overcut_bound_mm)},
            {"gouge_bound_mm", number(r.gouge_bound_mm)},
            {"samples", samples},
            {"faces", Json::array()},
            {"worst_places", Json::array()},
            {"histogram", {{"edges_mm", Json::array()}, {"area_mm2", Json::array()}}}};
  if (r.allowance_mm > 0.0) j["allowance_mm"] = number(r.allowance_mm);
  if (r.coverage_bound && r.coverage_reachable_bound) {
    j["coverage_bound"] = number(*r.coverage_bound);
    j["coverage_reachable_bound"] = number(*r.coverage_reachable_bound);
  }
  for (const Shortfall& reason : acceptance.reasons)
    j["reasons"].push_back({{"figure", reason.figure}, {"text", reason.text}});
  for (const Shortfall& caution : acceptance.cautions)
    j["cautions"].push_back({{"figure", caution.figure}, {"text", caution.text}});
  for (const FaceVerdict& f : r.faces) j["faces"].push_back(to_json(f));
  for (const WorstPlace& w : r.worst) j["worst_places"].push_back(to_json(w));
  for (double e : r.histogram_edges_mm) j["histogram"]["edges_mm"].push_back(number(e));
  for (double a : r.histogram_area_mm2) j["histogram"]["area_mm2"].push_back(number(a));
  for (const BuriedStrip& b : r.buried) j["buried"].push_back(to_json(b));
  for (const UnjudgedFace& f : r.unread_faces) j["unread_faces"].push_back({{"face", f.face}, {"why", f.why}});
  for (const SheetSide& s : r.sheet_sides) j["sides"].push_back(sheet_side_to_json(s));
  if (!r.clearance.figures.empty()) j["clearance"] = to_json(r.clearance);
  if (r.hold) {
    j["hold"] = {{"axis", to_json(r.hold->axis)}};
    if (r.hold->as_thick) j["hold"]["as_thick"] = to_json(*r.hold->as_thick);
  }
  if (r.finer_reach)
    j["finer_reach"] = {{"radius_mm", number(r.finer_reach->radius_mm)},
                        {"reachable_share", number(r.finer_reach->reachable_share)}};
  if (r.least_left)
    j["least_left"] = {{"face", r.least_left->face},
                       {"point", point(r.least_left->point)},
                       {"left_mm", number(r.least_left->left_mm)},
                       {"radius_mm", number(r.least_left->radius_mm)},
                       {"bound_mm", number(r.least_left->bound_mm)}};
  if (r.turn)
    j["turn"] = {
        {"angle_deg", number(r.turn->angle_deg)}, {"strip", r.turn->strip + 1}, {"point", point(r.turn->point)}};
  if (r.stock) j["stock"] = stock_to_json(*r.stock);
  if (r.bending) j["bending"] = to_json(*r.bending);
  return dumped(j, 2) + "\n";
}

namespace {

/// What `read` makes of the text, and every fault of it with the name of the file.
template <class Read>
auto read_from(const std::string& text, const std::string& source, const Read& read) {
  try {
    return read(Json::parse(text));
  } catch (const InputError& e) {
    // What is wrong was found within the text, which does not know where it came from.
    throw InputError(source + ": " + e.what());
  } catch (const nlohmann::json::exception& e) {
    throw InputError(source + ": not a verify.json of schema " + std::string(kSchema) + " (" + e.what() + ")");
  }
}

std::vector<Shortfall> shortfalls_from(const Json& j, const char* key) {
  std::vector<Shortfall> list;
  if (j.contains(key))
    for (const Json& one : j.at(key))
      list.push_back({one.at("figure").get<std::string>(), one.at("text").get<std::string>()});
  return list;
}

Acceptance acceptance_from(const Json& j) {
  Acceptance acceptance{shortfalls_from(j, "reasons"), shortfalls_from(j, "cautions")};
  if (!j.at("pass").get<bool>() && acceptance.pass()) add_reason(acceptance, Figure::kVerdict, "does not pass");
  return acceptance;
}

}  // namespace

VerifyReport verify_from_json(const std::string& text, const std::string& source) {
  return read_from(text, source, report_from);
}

Acceptance acceptance_from_json(const std::string& text, const std::string& source) {
  return read_from(text, source, acceptance_from);
}

void keep_planned(const std::string& summary, const std::string& source, Acceptance& acceptance) {
  nlohmann::json json;
  std::vector<Shortfall> planned;
  try {
    json = nlohmann::json::parse(summary);
    planned = shortfalls_from(json, "reasons");
  } catch (const nlohmann::json::exception& e) {
    throw InputError(source + ": not a summary.json (" + e.what() + ")");
  }
  for (Shortfall& reason : planned)
    if (reason.figure == figure_name(Figure::kCycles) || reason.figure == figure_name(Figure::kEngagement))
      acceptance.reasons.push_back(std::move(reason));
}

}  // namespace flank::internal
