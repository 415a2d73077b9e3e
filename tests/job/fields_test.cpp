// The table of fields: every member of the jobs is in it once, and ranges are kept.
#include "flank/job/fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "flank/error.h"
#include "flank/job/check_fields.h"
#include "flank/job/field_text.h"
#include "job/random_jobs.h"

namespace flank::internal {
namespace {

using Addresses = std::vector<const void*>;

template <class... Members>
void add(Addresses& all, const Members&... members) {
  (all.push_back(&members), ...);
}

// A new member of a job does not compile here until it is named, and then has to be in the table.
void add_members(const PartRequest& request, Addresses& all) {
  // `facing` is set by the library, not by a user; `allowance` belongs to some jobs only.
  const auto& [file, unit, faces, skin, side, facing, allowance] = request;
  add(all, file, unit, faces, skin, side);
}
void add_members(const ToolRequest& request, Addresses& all) {
  const auto& [spec, axis_length] = request;
  add(all, spec, axis_length);
}
void add_members(const RadiusRequest& request, Addresses& all) {
  const auto& [min, max, slope, slenderness, profile, neck, wheel] = request;
  add(all, min, max, slope, slenderness, profile, neck, wheel);
}
void add_members(const ObstacleRequest& request, Addresses& all) {
  const auto& [check, ignore, shank, shank_radius, shank_length, holder, fixtures, unit, clearance] = request;
  add(all, check, ignore, shank, shank_radius, shank_length, holder, fixtures, unit, clearance);
}
void add_members(const JudgeRequest& request, Addresses& all) {
  const auto& [coverage, whole, sample, reach, turn] = request;  // the last of fit and cover alone
  add(all, coverage, whole, sample, reach);
}
void add_members(const ChoiceRequest& request, Addresses& all) {
  const auto& [catalogue, finalists, feed, rapid] = request;
  add(all, catalogue, finalists, feed, rapid);
}
Addresses members(const FitJob& job) {
  const auto& [part, tool, radius, obstacles, judge, tolerance, start, guide, cut, strips, avoid, effort, curve, bend] =
      job;
  Addresses all;
  add_members(part, all), add_members(tool, all), add_members(radius, all), add_members(obstacles, all);
  add(all, part.allowance_mm);
  add_members(judge, all);
  add(all, tolerance, start, guide, cut, strips, avoid, effort, curve, bend, judge.most_turn_deg);
  return all;
}
Addresses members(const CoverJob& job) {
  const auto& [part, tool, choice, obstacles, judge, tolerance, cut, strategy, seed, seeds, most_strips, price] = job;
  Addresses all;
  add_members(part, all), add_members(tool, all), add_members(choice, all), add_members(obstacles, all);
  add(all, part.allowance_mm);
  add_members(judge, all);
  add(all, tolerance, cut, strategy, seed, seeds, most_strips, price, judge.most_turn_deg);
  return all;
}
void add_members(const NcRequest& request, Addresses& all) {
  const auto& [file, machine, setup, tool, faces, offset, number, follow] = request;
  add(all, file, machine, setup, tool, faces, offset, number, follow);
}
Addresses members(const TrochoidJob& job) {
  const auto& [part, left, right, floor, tool, radius, cycles, obstacles, judge, tolerance, effort, avoid] = job;
  const auto& [file, unit, faces, skin, side, facing, allowance] = part;
  const auto& [engagement, cut, layers, entry, ramp, strategy, feed, rapid, cell] = cycles;
  Addresses all;
  add_members(tool, all), add_members(radius, all), add_members(obstacles, all), add_members(judge, all);
  add(all, file, left, right, floor, engagement, cut, layers, entry, ramp, strategy, feed, rapid, cell, tolerance,
      effort, avoid, allowance);
  return all;
}
Addresses members(const PostJob& job) {
  const auto& [folder, more, operations, copies, axis, coolant, clamp, machine, part, setup, feed, speed, most,
               deviation, tool_length, clearance, lift, order, spindle, dry, force, material, flutes, helix,
               finish_stock, most_force, most_power, most_deflection] = job;
  Addresses all;
  add(all, folder, more, operations, copies, axis, coolant, clamp, machine, part, setup, feed, speed, most, deviation,
      tool_length, clearance, lift, order, spindle, dry, force, material, flutes, helix, finish_stock, most_force,
      most_power, most_deflection);
  return all;
}
Addresses members(const DesignJob& job) {
  const auto& [part, tools, source, shape, length, avoid, radius, choice, obstacles, judge, tolerance, change] = job;
  const auto& [file, unit, faces, skin, side, facing, allowance] = part;
  Addresses all;
  add_members(radius, all), add_members(choice, all), add_members(obstacles, all), add_members(judge, all);
  add(all, file, unit, faces, side, tools, source, shape, length, avoid, tolerance, change);
  return all;
}
Addresses members(const BoundJob& job) {
  const auto& [part, tool, radius, checked, ignored, tolerance, map, points, gap] = job;
  Addresses all;
  add_members(part, all), add_members(tool, all);
  add(all, radius, checked, ignored, tolerance, map, points, gap);
  return all;
}
Addresses members(const CorrectJob& job) {
  const auto& [folder, profile, measured, datum, limit] = job;
  Addresses all;
  add(all, folder, profile, measured, datum, limit);
  return all;
}
Addresses members(const RedesignJob& job) {
  const auto& [part, tool, radius, weight, thickness, nearest, heights, effort, checked, ignored, tolerance] = job;
  Addresses all;
  add_members(part, all), add_members(tool, all), add_members(radius, all);
  add(all, weight, thickness, nearest, heights, effort, checked, ignored, tolerance);
  return all;
}
Addresses members(const VerifyJob& job) {
  const auto& [folder, more, nc, part, tolerance, sample, reach, cell, side, obstacles, bending] = job;
  const auto& [on, material, flutes, helix, finish_stock] = bending;
  Addresses all;
  add_members(nc, all);
  add_members(obstacles, all);
  add(all, folder, more, part, tolerance, sample, reach, cell, side, on, material, flutes, helix, finish_stock);
  return all;
}
Addresses members(const WheelRequest& job) {
  // The folder is given beside the fields, as of the other jobs.
  const auto& [part, folder, unit, tolerance, coverage, effort, tool, holder, tools, sample, rough, edges, blank,
               allowance, engagement, balance, machine, tilt, hub, blades, splitters, count] = job;
  Addresses all;
  add(all, part, unit, tolerance, coverage, effort, tool, holder, tools, sample, rough, edges, blank, allowance,
      engagement, balance, machine, tilt, hub, blades, splitters, count);
  return all;
}

template <class Job>
class Fields : public testing::Test {};
using Jobs = testing::Types<FitJob, CoverJob, TrochoidJob, VerifyJob, PostJob, DesignJob, BoundJob, CorrectJob,
                            RedesignJob, WheelRequest>;
TYPED_TEST_SUITE(Fields, Jobs);

TYPED_TEST(Fields, EveryMemberIsInTheTableOnce) {
  const TypeParam job;
  Addresses visited;
  visit_fields(job, [&](const FieldInfo&, const auto& value) { visited.push_back(&value); });
  Addresses all = members(job);
  std::sort(visited.begin(), visited.end());
  std::sort(all.begin(), all.end());
  EXPECT_EQ(visited, all);
}

TYPED_TEST(Fields, KeysFlagsAndNamesAreUniqueAndEveryFieldHasHelp) {
  std::set<std::string> keys, flags, names;
  const TypeParam usual_job;
  visit_fields(usual_job, [&](const FieldInfo& info, const auto&) {
    EXPECT_TRUE(keys.insert(std::string(info.key)).second) << info.key;
    EXPECT_TRUE(flags.insert(flag_of(info)).second) << info.key;
    EXPECT_TRUE(names.insert(field_name(info)).second) << info.key;
    EXPECT_FALSE(info.help.empty()) << info.key;
    const bool ranged = info.accepted.number || info.accepted.text;
    EXPECT_EQ(ranged, !info.accepted.words.empty()) << info.key << ": a range without words, or words without a range";
  });
}

TYPED_TEST(Fields, DefaultsAndRandomValuesAreAccepted) {
  EXPECT_NO_THROW(check_fields(TypeParam{}));
  Random random(7);
  for (int k = 0; k < 200; ++k) EXPECT_NO_THROW(check_fields(jobs::random_job<TypeParam>(random)));
}

TYPED_TEST(Fields, WordsReadBackAsTheSameValue) {
  Random random(11);
  for (int k = 0; k < 200; ++k) {
    const TypeParam job = jobs::random_job<TypeParam>(random);
    std::vector<std::vector<std::string>> words;
    visit_fields(job, [&](const FieldInfo& info, const auto& value) { words.push_back(field_words(info, value)); });
    TypeParam back;
    std::size_t at = 0;
    visit_fields(back, [&](const FieldInfo& info, auto& value) {
      for (const std::string& word : words[at]) read_word(info, word, value);
      ++at;
    });
    EXPECT_EQ(back, job);
  }
}

TEST(FieldNames, TheFlagComesFromTheKeyAndTheNameHasTheUnit) {
  const FieldInfo length{"axis_length", "mm", "", "help"};
  EXPECT_EQ(flag_of(length), "--axis-length");
  EXPECT_EQ(field_name(length), "axis_length_mm");
  EXPECT_EQ(field_name({"feed", "mm/min", "", "help"}), "feed_mm_min");
  EXPECT_EQ(field_name({"strategy", "", "", "help"}), "strategy");
}

template <class Job>
std::string refusal(const Job& job) {
  try {
    check_fields(job);
  } catch (const UsageError& e) {
    EXPECT_EQ(std::string(e.what()).rfind(e.field(), 0), 0u) << e.what();
    return e.what();
  }
  return "accepted";
}

TEST(CheckFields, RefusesWhatIsOutOfRangeAndNamesTheField) {
  const auto fit = [](auto change) {
    FitJob job;
    change(job);
    return refusal(job);
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(fit([](FitJob& job) { job.tolerance_mm = 0.0; }), "tolerance_mm 0: expected a length > 0 mm");
  for (double wrong : {-1.0, kNan, kInfinity}) {
    EXPECT_NE(fit([&](FitJob& job) { job.tolerance_mm = wrong; }).find("tolerance_mm"), std::string::npos);
    EXPECT_NE(fit([&](FitJob& job) { job.tool.axis_length_mm = wrong; }).find("axis_length_mm"), std::string::npos);
    EXPECT_NE(fit([&](FitJob& job) { job.judge.sample_mm = wrong; }).find("sample_mm"), std::string::npos);
    EXPECT_NE(fit([&](FitJob& job) { job.judge.reach_radius_mm = wrong; }).find("reach_radius_mm"), std::string::npos);
    EXPECT_NE(fit([&](FitJob& job) { job.obstacles.clearance_mm = wrong; }).find("clearance_mm"), std::string::npos);
  }
  EXPECT_EQ(fit([](FitJob& job) { job.obstacles.clearance_mm = 0.0; }), "accepted");
  EXPECT_NE(fit([](FitJob& job) { job.strips = -1; }).find("auto or a number from 1 to 64"), std::string::npos);
  EXPECT_EQ(fit([](FitJob& job) { job.strips = 64; }), "accepted");
  EXPECT_NE(fit([](FitJob& job) { job.strips = 65; }), "accepted");
  EXPECT_NE(fit([](FitJob& job) { job.radius.slope_max = 1.0; }), "accepted");
  EXPECT_NE(fit([](FitJob& job) { job.judge.least_coverage = 1.01; }), "accepted");
  EXPECT_NE(fit([](FitJob& job) { job.part.side = 0; }).find("expected + or -"), std::string::npos);
  EXPECT_NE(fit([](FitJob& job) { job.part.unit = "furlong"; }).find("mm, cm, m or in"), std::string::npos);
  CoverJob cover;
  cover.strategy = "guess";
  EXPECT_EQ(refusal(cover), "strategy guess: must be grow or curves");
  cover = {};
  cover.choice.feed_mm_min = 0.0;
  EXPECT_EQ(refusal(cover), "feed_mm_min 0: expected a rate > 0 mm/min");
}

TEST(ReadWord, RefusesWhatIsNoValue) {
  const FieldInfo plain{"finalists", "", "", "help"}, side{"side", "", "", "help", {}, Spelling::kSign};
  const FieldInfo strips{"strips", "", "", "help", {}, Spelling::kAutoOrCount};
  int count = 0;
  for (const char* word : {"", "3.5", "three", "3 ", "99999999999", "+"})
    EXPECT_THROW(read_word(plain, word, count), UsageError) << word;
  read_word(plain, "+3", count);
  EXPECT_EQ(count, 3);
  for (const char* word : {"0", "-1", "many"}) EXPECT_THROW(read_word(strips, word, count), UsageError) << word;
  read_word(strips, "auto", count);
  EXPECT_EQ(count, 0);
  EXPECT_THROW(read_word(side, "1", count), UsageError);
  read_word(side, "-", count);
  EXPECT_EQ(count, -1);
  double number = 0.0;
  for (const char* word : {"", "1,5", "1mm", "0x10", "1e999"})
    EXPECT_THROW(read_word(plain, word, number), UsageError) << word;
  std::uint64_t seed = 0;
  for (const char* word : {"-1", "1.5", "18446744073709551616"})
    EXPECT_THROW(read_word(plain, word, seed), UsageError) << word;
  bool on = false;
  EXPECT_THROW(read_word(plain, "yes", on), UsageError);
}

}  // namespace
}  // namespace flank::internal
