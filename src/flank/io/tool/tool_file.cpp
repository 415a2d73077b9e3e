#include "flank/tool_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/atomic_file.h"
#include "flank/error.h"
#include "flank/io/text/json_input.h"

namespace flank {
using namespace internal;

namespace {

constexpr std::string_view kSchema = "openflank/tool/1";
constexpr int kSplineCoefficients = 2000;  ///< most that a file may have

/// Angles carry their unit in the key.
std::string parameter_key(ToolFamily family, int index) {
  const std::string name(parameter_names(family)[static_cast<std::size_t>(index)]);
  return parameter_is_angle(family, index) ? name + "_rad" : name;
}

/// Points as JSON pairs in full digits.
std::string pair_list(const std::vector<Vec2>& points, std::string_view separator) {
  std::vector<std::string> rows;
  rows.reserve(points.size());
  for (const Vec2& p : points) rows.push_back(fmt::format("[{}, {}]", exact_number(p.x()), exact_number(p.y())));
  return fmt::format("{}", fmt::join(rows, separator));
}

std::string parameters_text(const RadialFunction& radial) {
  std::vector<std::string> entries;
  for (int k = 0; k < radial.parameter_count(); ++k) {
    const std::string number = exact_number(radial.parameters()[k]);
    const bool named = radial.family() != ToolFamily::kSpline;
    entries.push_back(named ? fmt::format("\"{}\": {}", parameter_key(radial.family(), k), number) : number);
  }
  const std::string all = fmt::format("{}", fmt::join(entries, ", "));
  return radial.family() == ToolFamily::kSpline ? "{\"coefficients\": [" + all + "]}" : "{" + all + "}";
}

/// At least kToolSamples, and four per knot span, so that a reader that has only the samples gets the same tool.
std::vector<Vec2> samples_of(const RadialFunction& radial) {
  const int steps = std::max(kToolSamples - 1, 4 * (radial.parameter_count() - 3));
  std::vector<Vec2> samples(static_cast<std::size_t>(steps + 1));
  for (int i = 0; i <= steps; ++i) {
    const double s = i == steps ? radial.axis_length() : radial.axis_length() * i / steps;
    samples[static_cast<std::size_t>(i)] = {s, radial.at(s).r};
  }
  return samples;
}

/// Every parameter is needed, and no other key is accepted: a misspelt one must not be ignored.
RadialFunction family_from_parameters(const JsonInput& file, ToolFamily family, double length) {
  const JsonInput parameters = file.member("parameters");
  const int count = static_cast<int>(parameter_names(family).size());
  std::vector<std::string> known;
  Eigen::VectorXd values(count);
  for (int k = 0; k < count; ++k) {
    known.push_back(parameter_key(family, k));
    values[k] = parameters.member(known.back()).number();
  }
  for (const std::string& key : parameters.keys())
    if (std::find(known.begin(), known.end(), key) == known.end())
      parameters.refuse(
          fmt::format("unknown key \"{}\"; a {} has: {}", key, family_name(family), fmt::join(known, ", ")));
  return {family, length, values};
}

/// A clamped uniform cubic spline is its coefficients alone: knots follow from their number and the length.
RadialFunction spline_from_coefficients(const JsonInput& file, double length) {
  const JsonInput parameters = file.member("parameters");
  parameters.allow_keys({"coefficients"});
  const JsonInput list = parameters.member("coefficients");
  if (list.size() < 4 || list.size() > kSplineCoefficients)
    list.refuse(fmt::format("has {} entries; a spline has 4 to {}", list.size(), kSplineCoefficients));
  const std::vector<double> values = list.numbers(list.size());
  return RadialFunction::spline(length,
                                Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<int>(values.size())));
}

/// Largest distance between the radial function and the samples, mm.
double largest_error(const RadialFunction& radial, const std::vector<Vec2>& samples) {
  double largest = 0.0;
  for (const Vec2& p : samples) largest = std::max(largest, std::abs(radial.at(p.x()).r - p.y()));
  return largest;
}

/// Samples (s, r) that grow in s from 0 to L.
std::vector<Vec2> checked_samples(const JsonInput& list, double length) {
  const std::vector<Vec2> samples = list.pairs();
  if (samples.size() < 4) list.refuse("expected at least 4 pairs [s, r]");
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!(samples[i].y() > 0.0)) list.element(i).refuse(fmt::format("r is {}; must be > 0", samples[i].y()));
    if (i > 0 && !(samples[i].x() > samples[i - 1].x()))
      list.element(i).refuse("s must increase from sample to sample");
  }
  // Rounded files: the ends may be off in their last digit.
  const double slack = 1e-6 * length;
  if (std::abs(samples.front().x()) > slack || std::abs(samples.back().x() - length) > slack)
    list.refuse(fmt::format("s runs from {} to {}; it must run from 0 to axis_length = {}", samples.front().x(),
                            samples.back().x(), length));
  return samples;
}

/// The spline of fewest coefficients that reproduces the samples to the finest accuracy at which it is a tool: samples
/// that were rounded or measured must not be followed into their last digit, or r'' turns to noise.
RadialFunction spline_from_samples(const JsonInput& list, const std::vector<Vec2>& samples, double length) {
  constexpr std::array<double, 5> kAccuracies = {1e-9, 1e-7, 1e-5, 1e-4, kToolSplineErrorMm};
  std::vector<RadialFunction> splines;
  std::vector<double> errors;
  const int most = std::min<int>(static_cast<int>(samples.size()), 403);
  for (int count = 4; count <= most;
       // An eighth more each time: 40 least-squares problems at most instead of 400.
       count = count == most ? most + 1 : std::min(most, count + std::max(1, count / 8))) {
    splines.push_back(RadialFunction::spline_through(length, samples, count));
    errors.push_back(largest_error(splines.back(), samples));
    if (errors.back() <= kAccuracies.front()) break;
  }
  std::string why;
  for (const double accuracy : kAccuracies) {
    const auto found = std::find_if(errors.begin(), errors.end(), [&](double e) { return e <= accuracy; });
    if (found == errors.end()) continue;
    const RadialFunction& spline = splines[static_cast<std::size_t>(found - errors.begin())];
    const Legitimacy verdict = check_legitimacy(spline);
    if (verdict.legitimate) return spline;
    why = verdict.reason;
  }
  if (!why.empty()) list.refuse("the spline through them is not a tool, " + why);
  list.refuse(
      fmt::format("no cubic spline reproduces them to {} mm; give more or smoother samples", kToolSplineErrorMm));
}

/// Family and parameters go before samples; if both are there, they must agree.
RadialFunction radial_from(const JsonInput& file) {
  const double length = file.member("axis_length").positive();
  const bool has_parameters = file.has("parameters"), has_samples = file.has("samples");
  if (!has_parameters && !has_samples) file.refuse("\"samples\" is missing (or \"family\" with \"parameters\")");
  std::vector<Vec2> samples;
  if (has_samples) samples = checked_samples(file.member("samples"), length);
  if (!has_parameters) return spline_from_samples(file.member("samples"), samples, length);
  const JsonInput name = file.member("family");
  const std::optional<ToolFamily> family = family_from_name(name.text());
  if (!family) {
    std::vector<std::string_view> names;
    for (const ToolFamily f : kToolFamilies) names.push_back(family_name(f));
    name.refuse(fmt::format("is \"{}\"; accepted: {}", name.text(), fmt::join(names, ", ")));
  }
  const RadialFunction radial = *family == ToolFamily::kSpline ? spline_from_coefficients(file, length)
                                                               : family_from_parameters(file, *family, length);
  // Two statements of one tool that differ: which of them a machinist has ground is not for us to guess.
  if (const double error = largest_error(radial, samples); !(error <= kToolSampleErrorMm))
    file.member("samples").refuse(fmt::format(
        "they are up to {:.3g} mm from what \"family\" and \"parameters\" say; leave out one of the two", error));
  return radial;
}

/// A profile (z, radius) above the flank: z does not fall, radii are not negative.
void check_profile(const JsonInput& list, const std::vector<Vec2>& profile) {
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (profile[i].y() < 0.0) list.element(i).refuse("the radius must be >= 0");
    if (i > 0 && profile[i].x() < profile[i - 1].x()) list.element(i).refuse("z must not decrease from point to point");
  }
  if (profile.size() == 1) list.refuse("expected at least two points [z, radius]");
}

/// A profile, or a cylinder on top of the flank.
std::vector<Vec2> shank_from(const JsonInput& shank, const RadialFunction& radial) {
  shank.allow_keys({"profile", "diameter", "length"});
  if (shank.has("profile")) {
    if (shank.has("diameter") || shank.has("length"))
      shank.refuse("must have either \"profile\" or \"diameter\" and \"length\"");
    const std::vector<Vec2> profile = shank.member("profile").pairs();
    check_profile(shank.member("profile"), profile);
    return profile;
  }
  if (!shank.has("diameter") && !shank.has("length")) return {};
  const double radius = 0.5 * shank.member("diameter").positive(), length = shank.member("length").positive();
  const double top = meridian_point(radial, radial.axis_length()).x();
  return {{top, radius}, {top + length, radius}};
}

}  // namespace

std::string tool_to_json(const Tool& tool) {
  const RadialFunction& radial = tool.radial;
  std::string text = "{\n";
  text += fmt::format("  \"schema\": \"{}\",\n  \"units\": \"mm\",\n", kSchema);
  if (!tool.name.empty()) text += fmt::format("  \"name\": {},\n", json_string(tool.name));
  text += fmt::format("  \"axis_length\": {},\n", exact_number(radial.axis_length()));
  text += fmt::format("  \"family\": \"{}\",\n", family_name(radial.family()));
  text += fmt::format("  \"parameters\": {},\n", parameters_text(radial));
  text += fmt::format("  \"samples\": [\n    {}\n  ]", pair_list(samples_of(radial), ",\n    "));
  if (!tool.shank.empty()) text += fmt::format(",\n  \"shank\": {{\"profile\": [{}]}}", pair_list(tool.shank, ", "));
  if (!tool.holder.empty()) text += fmt::format(",\n  \"holder\": [{}]", pair_list(tool.holder, ", "));
  return text + "\n}\n";
}

Tool tool_from_json(std::string_view text, const std::string& file) {
  const JsonInput in(file, text);
  in.require_schema(kSchema);
  in.allow_keys({"schema", "units", "name", "axis_length", "family", "parameters", "samples", "shank", "holder"});
  Tool tool;
  tool.radial = radial_from(in);
  if (const Legitimacy verdict = check_legitimacy(tool.radial); !verdict.legitimate)
    in.refuse("not a tool, " + verdict.reason);
  if (in.has("name")) tool.name = in.member("name").text();
  if (in.has("shank")) tool.shank = shank_from(in.member("shank"), tool.radial);
  if (in.has("holder")) {
    tool.holder = in.member("holder").pairs();
    check_profile(in.member("holder"), tool.holder);
  }
  return tool;
}

Tool read_tool(const std::string& file) { return tool_from_json(read_file(file), file); }

void write_tool(const Tool& tool, const std::string& file) { write_file(file, tool_to_json(tool)); }

}  // namespace flank
