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
  py::class_<Result, std::shared_ptr<Result>>(module, "Result", "A tool, its path and the verdict about them.")
      .def_readonly("tool", &Result::tool, "The tool.")
      .def_readonly("path", &Result::path, "The path.")
      .def_readonly("motions", &Result::motions, "Motion k is strip k of the path; of a cavity: the side paths.")
      .def_readonly("report", &Result::verify, "What the judge found.")
      .def_readonly("notes", &Result::notes, "Repairs of the part, warnings.")
      .def_readonly("complete", &Result::complete, "False: stopped early, what is here is unfinished.")
      .def_readonly("part_sha256", &Result::part_sha256, "Of the part that was read.")
      .def_readonly("chord_bound_mm", &Result::chord_bound_mm, "Between the motions and the joined poses, mm: proved.")
      .def_readonly("largest_c", &Result::largest_c, "Largest |c| where the tool touches; below 1 it moves regularly.")
      .def_property_readonly(
          "passed", [](const Result& r) { return r.acceptance().pass(); }, "Whether it meets the request.")
      .def_property_readonly(
          "reasons", [](const Result& r) { return pairs_of(r.acceptance().reasons); },
          "Why it does not: (figure of verify.json, one line). Empty if it does.")
      .def_property_readonly(
          "cautions", [](const Result& r) { return pairs_of(r.acceptance().cautions); },
          "What the verdict says nothing about: (figure, one line).")
      .def_property_readonly("text", &summary_text, "The summary as a table for a terminal.")
      .def_property_readonly("summary_json", &summary_json, "The text of summary.json.")
      .def(
          "write",
          [](const Result& r, const std::filesystem::path& folder) {
            const py::gil_scoped_release release;
            write_result(r, folder.string());
          },
          py::arg("folder"),
          "Writes all files of the result into a folder, at once, as the command does. Raises InputError.")
      .def("__repr__", [](const Result& r) {
        return "<openflank.Result, " + std::to_string(r.path.strips.size()) + " strips, " +
               (r.acceptance().pass() ? "meets its request>" : "does not meet its request>");
      });
}

void bind_verification(py::module_& module) {
  py::class_<Verification, std::shared_ptr<Verification>>(module, "Verification", "What verify found in a folder.")
      .def_readonly("report", &Verification::report, "What the judge found.")
      .def_readonly("notes", &Verification::notes, "Warnings.")
      .def_property_readonly(
          "passed", [](const Verification& v) { return v.acceptance.pass(); }, "Whether it meets the request.")
      .def_property_readonly(
          "reasons", [](const Verification& v) { return pairs_of(v.acceptance.reasons); },
          "Why it does not: (figure of verify.json, one line). Empty if it does.")
      .def_property_readonly(
          "cautions", [](const Verification& v) { return pairs_of(v.acceptance.cautions); },
          "What the verdict says nothing about: (figure, one line).")
      .def_property_readonly("text", &verify_text, "The verdict as a table for a terminal.");
  py::class_<PostOutcome, std::shared_ptr<PostOutcome>>(module, "Program", "A program of a machine and what it does.")
      .def_readonly("program", &PostOutcome::program,
                    "The program's text; empty where it does not pass and force is not given.")
      .def_readonly("machine", &PostOutcome::machine, "Name of the machine.")
      .def_readonly("setup", &PostOutcome::setup, "Where the part sits: x,y,z,a,b,c; mm, degrees.")
      .def_readonly("poses", &PostOutcome::poses, "Planned poses of strips.")
      .def_readonly("moves", &PostOutcome::moves, "Blocks that move.")
      .def_readonly("deviation_mm", &PostOutcome::deviation_mm,
                    "The control's motion is nowhere farther off, mm: proved.")
      .def_readonly("minutes", &PostOutcome::minutes, "Machining time.")
      .def_readonly("notes", &PostOutcome::notes, "Warnings.")
      .def_property_readonly(
          "passed", [](const PostOutcome& p) { return p.acceptance.pass(); },
          "Whether its links cut and hit nothing, and its digits keep the tolerance.")
      .def_property_readonly(
          "reasons", [](const PostOutcome& p) { return pairs_of(p.acceptance.reasons); },
          "Why it does not: (figure, one line).")
      .def_property_readonly(
          "cautions", [](const PostOutcome& p) { return pairs_of(p.acceptance.cautions); },
          "What the verdict says nothing about: (figure, one line).")
      .def_property_readonly("text", &post_text, "The figures as a table for a terminal.")
      .def_property_readonly("figures_json", &post_json, "The figures as JSON.");
}

void bind_fields(py::module_& module) {
  py::class_<JobField>(module, "JobField", "A line of the library's table of fields.")
      .def_readonly("name", &JobField::name, "The keyword, with its unit: tolerance_mm.")
      .def_readonly("option", &JobField::option, "Of the command line: --tolerance.")
      .def_readonly("unit", &JobField::unit, "mm, mm/min; empty: none.")
      .def_readonly("group", &JobField::group, "Of the help text; empty: the first.")
      .def_readonly("help", &JobField::help, "What it means.")
      .def_readonly("accepted", &JobField::accepted, "Values that it takes; empty: any.")
      .def_property_readonly(
          "kind", [](const JobField& f) { return kind_name(f.kind); },
          "text, texts, number, count, auto or count, sign, switch.")
      .def_readonly("needed", &JobField::needed, "Whether it has no default and must be given.")
      .def_readonly("usual", &JobField::usual, "The default as a word; None: not set.");
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
