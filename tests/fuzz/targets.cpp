#include "fuzz/targets.h"

#include <cmath>

#include "flank/error.h"
#include "flank/io/isolated/part_bytes.h"
#include "flank/io/part_format.h"
#include "flank/io/path/path_cls_read.h"
#include "flank/io/text/step_syntax.h"
#include "flank/io/tool/tool_dxf_read.h"
#include "flank/job/job_json.h"
#include "flank/machine/kinematics.h"
#include "flank/machine/model/machine_file.h"
#include "flank/machine/nc/dialects/read_nc.h"
#include "flank/machine/nc/dialects/write_nc.h"
#include "flank/machine/work_setup.h"
#include "flank/manifest/journal_json.h"
#include "flank/manifest/manifest.h"
#include "flank/motion/motion_record.h"
#include "flank/path_file.h"
#include "flank/report/report_file.h"
#include "flank/seed/guide_file.h"
#include "flank/setup/tool_body.h"
#include "flank/tool/radial_record.h"
#include "flank/tool_file.h"
#include "flank/tool_request/tool_spec.h"

namespace flank::fuzz {
namespace {

using namespace internal;

/// What was read must hold what every later step takes for granted.
void require(bool right) {
  if (!right) throw InternalError("read, but not sound");
}

void sound(const TriangleMesh& mesh) {
  const auto count = static_cast<int>(mesh.vertices.size());
  for (const auto& t : mesh.triangles)
    for (const int v : t) require(v >= 0 && v < count);
  for (const Vec3& v : mesh.vertices) require(v.allFinite());
}

void sound(const Tool& tool) { require(tool.radial.axis_length() > 0.0 && std::isfinite(tool.radial.at(0.0).r)); }

void sound(const Path& path) {
  for (const Strip& strip : path.strips)
    for (const Pose& pose : strip.poses) require(pose.tip.allFinite() && std::abs(pose.axis.norm() - 1.0) < 1e-6);
}

/// A machine that was read can hold a tool: its linear joints span space.
void sound(const Machine& machine) {
  const Kinematics kinematics(machine, machine.tool_length);
  require(kinematics.forward(kinematics.joints(Vec3(1, 2, 3), {0.3, 0.4})).tip.allFinite());
}

void sound(const NcProgram& program) {
  require(!program.moves.empty() && !program.moves.front().joined);
  for (const NcMove& m : program.moves) {
    require(m.position.allFinite() && m.orientation.allFinite());
    require(m.kind == NcKind::kFeed ? m.feed > 0.0 && std::isfinite(m.feed) : m.feed == 0.0);
    require(m.strip >= -1 && m.strip < static_cast<std::int32_t>(program.strips.size()));
    if (program.positions == NcPositions::kTipVector) require(std::abs(m.orientation.norm() - 1.0) < 1e-9);
  }
}

/// What was read is sound, and what can be written of it reads back.
void nc(std::string_view bytes, NcDialect dialect) {
  NcProgram program;
  std::string text;
  try {
    program = read_nc(bytes, "f", dialect);
    sound(program);
    text = write_nc(program, dialect);
  } catch (const InputError&) {
    return;
  } catch (const UsageError&) {
    return;
  }
  try {
    require(read_nc(text, "f", dialect).moves.size() == program.moves.size());
  } catch (const InputError& e) {
    throw InternalError(std::string("written, but not read again: ") + e.what());
  }
}

void nc_linuxcnc(std::string_view bytes) {
  NcDialect dialect;
  nc(bytes, dialect);
  dialect.positions = NcPositions::kJoint;
  nc(bytes, dialect);
  dialect.tcp_on = "M428";
  dialect.tcp_off = "M429";
  nc(bytes, dialect);
}

void nc_of(std::string_view bytes, NcLanguage language) {
  NcDialect dialect;
  dialect.language = language;
  nc(bytes, dialect);
}

template <class Read>
void refused_or(const Read& read) {
  try {
    read();
  } catch (const InputError&) {
  } catch (const UsageError&) {
  }
}

/// A value of a finished step, or a refusal.
template <class Value, class Use>
void value_of(const StepValues& values, const Use& use) {
  refused_or([&] {
    StepCodec codec(values);
    Value value;
    code(codec, value);
    codec.end();
    use(value);
  });
}

/// Any step may be taken for any value.
void resume(std::string_view bytes) {
  refused_or([&] {
    const Journal journal = journal_from_json(bytes, "f");
    for (const JournalStep& step : journal.steps()) {
      value_of<RuledMotion>(step.result, [](const RuledMotion& motion) {
        if (motion.tip.count() > 0) (void)motion.jet(0.5);
      });
      value_of<RadialFunction>(step.result, [](const RadialFunction& radial) {
        require(radial.parameters().allFinite());
        if (radial.axis_length() > 0.0) (void)radial.at(0.0);
      });
      value_of<std::vector<std::vector<double>>>(step.result, [](const auto&) {});
    }
  });
}

/// Bytes between the two processes of a CAD file: they are our own, so a refusal is an InternalError.
void part_bytes(std::string_view bytes) {
  try {
    (void)decode_part(bytes);
  } catch (const InternalError&) {
  }
}

}  // namespace

const std::map<std::string, Target>& targets() {
  static const std::map<std::string, Target> kTargets = [] {
    std::map<std::string, Target> all{
        {"tool", [](std::string_view b) { refused_or([&] { sound(tool_from_json(b, "f")); }); }},
        {"path", [](std::string_view b) { refused_or([&] { sound(path_from_json(b, "f")); }); }},
        {"job", [](std::string_view b) { refused_or([&] { (void)job_from_json(std::string(b), "f"); }); }},
        {"view", [](std::string_view b) { refused_or([&] { check_report_file(b, "f", "openflank/view/1"); }); }},
        {"manifest", [](std::string_view b) { refused_or([&] { (void)manifest_from_json(b, "f"); }); }},
        {"resume", resume},
        {"cls", [](std::string_view b) { refused_or([&] { sound(path_from_cls(b, "f")); }); }},
        {"dxf", [](std::string_view b) { refused_or([&] { (void)profile_from_dxf(b, "f"); }); }},
        {"guide", [](std::string_view b) { refused_or([&] { (void)parse_guide("f", b); }); }},
        {"holder", [](std::string_view b) { refused_or([&] { (void)holder_profile(std::string(b)); }); }},
        {"spec", [](std::string_view b) { refused_or([&] { (void)parse_tool_spec(std::string(b), "tool"); }); }},
        {"step", [](std::string_view b) { refused_or([&] { (void)plain_step("f", b); }); }},
        {"part_bytes", part_bytes},
        {"machine", [](std::string_view b) { refused_or([&] { sound(machine_from_toml(b, "f")); }); }},
        {"setup", [](std::string_view b) { refused_or([&] { (void)parse_setup(std::string(b)); }); }},

        {"nc_linuxcnc", nc_linuxcnc},
        {"nc_fanuc", [](std::string_view b) { nc_of(b, NcLanguage::kFanuc); }},
        {"nc_siemens", [](std::string_view b) { nc_of(b, NcLanguage::kSiemens); }},
        {"nc_heidenhain", [](std::string_view b) { nc_of(b, NcLanguage::kHeidenhain); }},
        {"nc_apt", [](std::string_view b) { nc_of(b, NcLanguage::kApt); }},
    };
    for (const PartFormat& format : part_format_rows())
      if (format.read != nullptr)
        all[std::string(format.endings.front().substr(1))] = [&format](std::string_view b) {
          refused_or([&] { sound(format.read("f", b)); });
        };
    return all;
  }();
  return kTargets;
}

}  // namespace flank::fuzz
