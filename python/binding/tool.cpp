// Tools: made of a family, read, written, evaluated.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <numbers>

#include "arrays.h"
#include "bindings.h"
#include "flank/tool.h"
#include "flank/tool_file.h"

namespace flank::python {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

/// The keyword of a parameter: angles say that they are in degrees here.
std::string keyword(ToolFamily family, int index) {
  return std::string(parameter_names(family)[static_cast<std::size_t>(index)]) +
         (parameter_is_angle(family, index) ? "_deg" : "");
}

std::string keywords(ToolFamily family) {
  std::string text;
  for (int k = 0; k < static_cast<int>(parameter_names(family).size()); ++k)
    text += (k > 0 ? ", " : "") + keyword(family, k);
  return text;
}

/// "cylinder (radius), cone (radius, angle_deg), ..."
std::string families_with_keywords() {
  std::string text;
  for (const ToolFamily family : kToolFamilies)
    if (!parameter_names(family).empty())
      text += (text.empty() ? "" : ", ") + std::string(family_name(family)) + " (" + keywords(family) + ")";
  return text;
}

Tool checked(Tool tool) {
  const Legitimacy legitimacy = check_legitimacy(tool.radial);
  if (!legitimacy.legitimate) throw InputError("tool " + tool.name + ": " + legitimacy.reason);
  return tool;
}

void require_length(double axis_length_mm) {
  if (!(axis_length_mm > 0.0 && axis_length_mm < 1e300)) throw UsageError("axis_length_mm", "expected a length > 0 mm");
}

Tool make_tool(const std::string& name, double axis_length_mm, const Doubles& shank, const Doubles& holder,
               const py::kwargs& given) {
  const std::optional<ToolFamily> family = family_from_name(name);
  if (!family || parameter_names(*family).empty())
    throw UsageError("family", name, "expected " + tool_families() + "; Tool.spline and Tool.load make others");
  require_length(axis_length_mm);
  Eigen::VectorXd parameters(static_cast<Eigen::Index>(parameter_names(*family).size()));
  for (int k = 0; k < parameters.size(); ++k) {
    const std::string key = keyword(*family, k);
    if (!given.contains(key)) throw UsageError(key, "must be given; a " + name + " has " + keywords(*family));
    parameters[k] = given[key.c_str()].cast<double>() * (parameter_is_angle(*family, k) ? kRadiansPerDegree : 1.0);
  }
  for (const auto& [key, unused] : given) {
    bool known = false;
    for (int k = 0; k < parameters.size(); ++k) known = known || key.cast<std::string>() == keyword(*family, k);
    if (!known)
      throw UsageError(key.cast<std::string>(), "is no parameter of a " + name + "; it has " + keywords(*family));
  }
  Tool tool;
  tool.radial = RadialFunction(*family, axis_length_mm, std::move(parameters));
  tool.name = name;
  tool.shank = profile_of(shank, "shank");
  tool.holder = profile_of(holder, "holder");
  return checked(std::move(tool));
}

Tool make_spline(double axis_length_mm, const Doubles& coefficients, const std::string& name) {
  require_length(axis_length_mm);
  const std::span<const double> c = numbers_of(coefficients, "coefficients");
  if (c.size() < 4) throw UsageError("coefficients", "expected at least 4 numbers");
  Tool tool;
  tool.radial = RadialFunction::spline(
      axis_length_mm, Eigen::Map<const Eigen::VectorXd>(c.data(), static_cast<Eigen::Index>(c.size())));
  tool.name = name;
  return checked(std::move(tool));
}

py::dict parameters_of(const Tool& tool) {
  py::dict parameters;
  const ToolFamily family = tool.radial.family();
  for (int k = 0; k < static_cast<int>(parameter_names(family).size()); ++k)
    parameters[keyword(family, k).c_str()] =
        tool.radial.parameters()[k] / (parameter_is_angle(family, k) ? kRadiansPerDegree : 1.0);
  return parameters;
}

/// One column of the radial function's jets at s, in the shape of s.
py::array at_all(const Tool& tool, const Doubles& s, double RadialJet::*value) {
  py::array_t<double> out(std::vector<py::ssize_t>(s.shape(), s.shape() + s.ndim()));
  double* to = out.mutable_data();
  for (py::ssize_t k = 0; k < s.size(); ++k) to[k] = tool.radial.at(s.data()[k]).*value;
  return out;
}

py::array meridian_array(const Tool& tool, int count) {
  if (count < 2) throw UsageError("count", "expected at least 2 points");
  auto* points = new std::vector<Vec2>(meridian(tool.radial, count));
  const py::capsule owner(points, [](void* p) { delete static_cast<std::vector<Vec2>*>(p); });
  return points_view(*points, owner);
}

void bind_members(py::class_<Tool, std::shared_ptr<Tool>>& type) {
  type.def_readonly("name", &Tool::name, "Name of the tool.")
      .def_property_readonly(
          "family", [](const Tool& t) { return std::string(family_name(t.radial.family())); },
          "\"cylinder\", \"cone\", ..., \"spline\".")
      .def_property_readonly(
          "axis_length_mm", [](const Tool& t) { return t.radial.axis_length(); }, "Length L of the axis, mm.")
      .def_property_readonly("parameters", &parameters_of,
                             "Parameters of the family by name: mm, angles in degrees. Empty for a spline.")
      .def_property_readonly(
          "coefficients",
          [](const py::object& self) {
            const Eigen::VectorXd& p = self.cast<const Tool&>().radial.parameters();
            return view(p.data(), {static_cast<py::ssize_t>(p.size())}, self);
          },
          "Parameters in the family's order, of a spline its coefficients (n,): mm, angles in radians. No copy.")
      .def_property_readonly(
          "shank", [](const py::object& self) { return points_view(self.cast<const Tool&>().shank, self); },
          "Profile of the shank, N x 2: z along the axis from s = 0, radius; mm. No copy.")
      .def_property_readonly(
          "holder", [](const py::object& self) { return points_view(self.cast<const Tool&>().holder, self); },
          "Profile of the holder, N x 2: z along the axis from s = 0, radius; mm. No copy.")
      .def_property_readonly(
          "smallest_radius_mm", [](const Tool& t) { return t.radial.smallest(); },
          "Smallest radius of an inscribed sphere, mm; exact.")
      .def_property_readonly(
          "largest_radius_mm", [](const Tool& t) { return t.radial.largest(); },
          "Largest radius of an inscribed sphere, mm; exact.")
      .def_property_readonly(
          "slenderness", [](const Tool& t) { return stiffness(t).slenderness; },
          "Length over the diameter of the cylinder that bends as much.")
      .def_property_readonly(
          "deflection_um", [](const Tool& t) { return stiffness(t).deflection_um; },
          "Deflection of the tip under 100 N, in cemented carbide, micrometres.");
}

}  // namespace

void bind_tool(py::module_& module) {
  py::class_<Tool, std::shared_ptr<Tool>> type(
      module, "Tool",
      "A tool: the radial function r(s) of its flank, s in [0, L] from the tip, and shank and holder above it.");
  const py::array_t<double> none(std::vector<py::ssize_t>{0, 2});
  type.def(py::init(&make_tool), py::arg("family"), py::arg("axis_length_mm"), py::arg("shank") = none,
           py::arg("holder") = none,
           ("A tool of a family with its parameters as keywords, mm and degrees: " + families_with_keywords() +
            ". shank, holder: profiles N x 2 (z from s = 0, radius), mm. Raises UsageError for wrong keywords and "
            "InputError "
            "if it is no tool.")
               .c_str());
  type.def_static(
      "spline", &make_spline, py::arg("axis_length_mm"), py::arg("coefficients"), py::arg("name") = "spline",
      "A tool whose r(s) is a clamped cubic B-spline with equal knots over [0, L]; coefficients (n,), n >= 4, "
      "mm. Raises InputError if it is no tool.");
  type.def_static(
      "load", [](const std::filesystem::path& file) { return read_tool(file.string()); }, py::arg("file"),
      "Reads a tool.json. Raises InputError naming file and key.");
  type.def(
      "save", [](const Tool& tool, const std::filesystem::path& file) { write_tool(tool, file.string()); },
      py::arg("file"), "Writes a tool.json, whole or not at all. Raises InputError.");
  type.def("to_json", &tool_to_json, "The text of tool.json; its numbers are read back exactly.");
  type.def_static(
      "from_json", [](const std::string& text) { return tool_from_json(text, "text"); }, py::arg("text"),
      "The tool of a tool.json's text. Raises InputError naming the key.");
  type.def(
      "radius", [](const Tool& t, const Doubles& s) { return at_all(t, s, &RadialJet::r); }, py::arg("s"),
      "r(s), mm, for an array of arc lengths s, mm; in the shape of s.");
  type.def(
      "slope", [](const Tool& t, const Doubles& s) { return at_all(t, s, &RadialJet::d1); }, py::arg("s"),
      "r'(s) for an array of arc lengths s, mm; in the shape of s.");
  type.def("meridian", &meridian_array, py::arg("count") = 201,
           "Profile of the flank, count x 2: z along the axis from s = 0, distance from it; mm, at equal steps of s.");
  bind_members(type);
  type.def(py::pickle([](const Tool& t) { return tool_to_json(t); },
                      [](const std::string& text) { return tool_from_json(text, "pickle"); }));
  type.def("__eq__", [](const Tool& a, const py::object& b) {
    return py::isinstance<Tool>(b) && tool_to_json(a) == tool_to_json(b.cast<const Tool&>());
  });
  type.def("__repr__", [](const Tool& t) {
    return "<openflank.Tool " + t.name + ", " + std::string(family_name(t.radial.family())) + ", axis length " +
           py::str(py::float_(t.radial.axis_length())).cast<std::string>() + " mm>";
  });
}

}  // namespace flank::python
