// The commands as functions: fields of the table in, results out.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>

#include "arrays.h"
#include "bindings.h"
#include "flank/job.h"
#include "flank/report.h"
#include "flank/run.h"
#include "progress.h"

namespace flank::python {
namespace {

/// Fields by their names in the table, each with its words.
using Fields = std::vector<std::pair<std::string, std::vector<std::string>>>;

template <class Job>
Job job_of(const Fields& fields) {
  Job job;
  for (const auto& [name, words] : fields) set_field(job, name, words);
  return job;
}

/// A result, finished or not, and what stopped it, or None.
py::tuple run(const std::string& command, const Fields& fields, const py::object& callback) {
  PythonProgress stop(callback);
  const Progress progress = stop.progress();
  const auto result = std::make_shared<Result>();
  {
    const py::gil_scoped_release release;
    if (command == "fit")
      *result = run_fit(job_of<FitJob>(fields), progress);
    else if (command == "cover")
      *result = run_cover(job_of<CoverJob>(fields), progress);
    else if (command == "trochoid")
      *result = run_trochoid(job_of<TrochoidJob>(fields), progress);
    else
      throw UsageError("command", command, "must be fit, cover or trochoid");
  }
  return py::make_tuple(result, stop.reason());
}

std::string kind_name(FieldKind kind) {
  switch (kind) {
    case FieldKind::kText:
      return "text";
    case FieldKind::kTexts:
      return "texts";
    case FieldKind::kNumber:
      return "number";
    case FieldKind::kCount:
      return "count";
    case FieldKind::kAutoOrCount:
      return "auto or count";
    case FieldKind::kSign:
      return "sign";
    case FieldKind::kSwitch:
      return "switch";
  }
  return "";
}

std::vector<std::pair<std::string, std::string>> pairs_of(const std::vector<Shortfall>& shortfalls) {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const Shortfall& shortfall : shortfalls) pairs.emplace_back(shortfall.figure, shortfall.text);
  return pairs;
}

void bind_result(py::module_& module) {
  py::class_<Result, std::shared_ptr<Result>>(module, "Result", "A tool, its path and their verdict.")
      .def_readonly("tool", &Result::tool, "The tool.")
      .def_readonly("path", &Result::path, "The path.")
      .def_readonly("motions", &Result::motions,
                    "The motion of each pass of the path; of a cavity, those of the two side paths.")
      .def_readonly("report", &Result::verify, "The figures of the check.")
      .def_readonly("notes", &Result::notes, "Notes: repairs of the part, warnings.")
      .def_readonly("complete", &Result::complete, "False: the run was stopped early, and the result is unfinished.")
      .def_readonly("part_sha256", &Result::part_sha256, "SHA-256 of the part's file.")
      .def_readonly(
          "chord_bound_mm", &Result::chord_bound_mm,
          "Proved bound of the chord error, mm: the distance of the motions from the lines that join the CL points.")
      .def_readonly("largest_c", &Result::largest_c,
                    "Largest axial slip |c| where the tool touches the face; at 1 it moves along its own axis.")
      .def_property_readonly(
          "passed", [](const Result& r) { return r.acceptance().pass(); }, "Whether the result meets the request.")
      .def_property_readonly(
          "reasons", [](const Result& r) { return pairs_of(r.acceptance().reasons); },
          "Why it does not meet the request: pairs (figure of verify.json, sentence). Empty if it does.")
      .def_property_readonly(
          "cautions", [](const Result& r) { return pairs_of(r.acceptance().cautions); },
          "Cautions, which do not change the verdict: pairs (figure, sentence).")
      .def_property_readonly("text", &summary_text, "The summary as a table for a terminal.")
      .def_property_readonly("summary_json", &summary_json, "The text of summary.json.")
      .def(
          "write",
          [](const Result& r, const std::filesystem::path& folder) {
            const py::gil_scoped_release release;
            write_result(r, folder.string());
          },
          py::arg("folder"),
          "Writes all files of the result into a folder, all or none, as the command does. Raises InputError.")
      .def("__repr__", [](const Result& r) {
        return "<openflank.Result, " + std::to_string(r.path.strips.size()) + " strips, " +
               (r.acceptance().pass() ? "meets its request>" : "does not meet its request>");
      });
}

void bind_verification(py::module_& module) {
  py::class_<Verification, std::shared_ptr<Verification>>(module, "Verification", "The result of verify.")
      .def_readonly("report", &Verification::report, "The figures of the check.")
      .def_readonly("notes", &Verification::notes, "Warnings.")
      .def_property_readonly(
          "passed", [](const Verification& v) { return v.acceptance.pass(); }, "Whether the result meets the request.")
      .def_property_readonly(
          "reasons", [](const Verification& v) { return pairs_of(v.acceptance.reasons); },
          "Why it does not meet the request: pairs (figure of verify.json, sentence). Empty if it does.")
      .def_property_readonly(
          "cautions", [](const Verification& v) { return pairs_of(v.acceptance.cautions); },
          "Cautions, which do not change the verdict: pairs (figure, sentence).")
      .def_property_readonly("text", &verify_text, "The verdict as a table for a terminal.");
  py::class_<PostOutcome, std::shared_ptr<PostOutcome>>(module, "Program", "An NC program and its figures.")
      .def_readonly("program", &PostOutcome::program,
                    "Text of the program; empty if it does not pass and force is not set.")
      .def_readonly("machine", &PostOutcome::machine, "Name of the machine.")
      .def_readonly("setup", &PostOutcome::setup, "Set-up of the part on the table: x,y,z,a,b,c; mm, degrees.")
      .def_readonly("poses", &PostOutcome::poses, "Number of CL points of the passes.")
      .def_readonly("moves", &PostOutcome::moves, "Number of blocks that move the tool.")
      .def_readonly("deviation_mm", &PostOutcome::deviation_mm,
                    "Proved bound of the control's deviation from the path, mm.")
      .def_readonly("minutes", &PostOutcome::minutes, "Machining time.")
      .def_readonly("notes", &PostOutcome::notes, "Warnings.")
      .def_property_readonly(
          "passed", [](const PostOutcome& p) { return p.acceptance.pass(); },
          "Whether its links neither gouge nor collide, and the rounding of its numbers keeps the tolerance.")
      .def_property_readonly(
          "reasons", [](const PostOutcome& p) { return pairs_of(p.acceptance.reasons); },
          "Why it does not pass: pairs (figure, sentence).")
      .def_property_readonly(
          "cautions", [](const PostOutcome& p) { return pairs_of(p.acceptance.cautions); },
          "Cautions, which do not change the verdict: pairs (figure, sentence).")
      .def_property_readonly("text", &post_text, "The figures as a table for a terminal.")
      .def_property_readonly("figures_json", &post_json, "The figures as JSON.");
}

void bind_fields(py::module_& module) {
  py::class_<JobField>(module, "JobField", "A field of the library's table of fields.")
      .def_readonly("name", &JobField::name, "The keyword, with its unit: tolerance_mm.")
      .def_readonly("option", &JobField::option, "Name on the command line: --tolerance.")
      .def_readonly("unit", &JobField::unit, "Unit: mm, mm/min; empty: none.")
      .def_readonly("group", &JobField::group, "Group of the help text; empty: the first.")
      .def_readonly("help", &JobField::help, "What the field means.")
      .def_readonly("accepted", &JobField::accepted, "Values that it takes; empty: any.")
      .def_property_readonly(
          "kind", [](const JobField& f) { return kind_name(f.kind); },
          "Kind of value: text, texts, number, count, auto or count, sign, switch.")
      .def_readonly("needed", &JobField::needed, "Whether it has no default and must be given.")
      .def_readonly("usual", &JobField::usual, "The default as a text; None: not set.");
  module.def("job_fields", &job_fields, py::arg("command"),
             "The table of fields of fit, cover, trochoid, verify, post or design.");
}

}  // namespace

void bind_jobs(py::module_& module) {
  bind_result(module);
  bind_verification(module);
  bind_fields(module);
  module.def("run", &run, py::arg("command"), py::arg("fields"), py::arg("progress"),
             "Runs fit, cover or trochoid on fields [(name, [word, ...]), ...]: (Result, what stopped it or None).");
  module.def(
      "run_verify",
      [](const Fields& fields) {
        const py::gil_scoped_release release;
        return std::make_shared<Verification>(flank::run_verify(job_of<VerifyJob>(fields)));
      },
      py::arg("fields"), "Runs verify on fields [(name, [word, ...]), ...].");
  module.def(
      "run_post",
      [](const Fields& fields) {
        const py::gil_scoped_release release;
        return std::make_shared<PostOutcome>(flank::run_post(job_of<PostJob>(fields)));
      },
      py::arg("fields"), "Runs post on fields [(name, [word, ...]), ...].");
  module.def(
      "write_report",
      [](const std::filesystem::path& folder, const std::optional<std::filesystem::path>& file) {
        const py::gil_scoped_release release;
        return std::filesystem::path(write_report(folder.string(), file ? file->string() : std::string()));
      },
      py::arg("folder"), py::arg("file") = py::none(),
      "Writes the HTML page of a folder of results: report.html in it, or the file. The page's path. Raises "
      "InputError.");
}

}  // namespace flank::python
