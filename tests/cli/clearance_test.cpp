// Shank, holder, fixtures and clearance on the command line.
#include "cli/cli_fixture.h"
#include "shared_data.h"

namespace flank::cli {
namespace {

using nlohmann::json;

/// A square of two triangles, standing at x = `x` and reaching from z = -200 to 200.
std::string wall(double x) {
  const std::string at = std::to_string(x);
  const auto facet = [&](const char* a, const char* b, const char* c) {
    std::string text = " facet normal 1 0 0\n  outer loop\n";
    for (const char* corner : {a, b, c}) text += "   vertex " + at + " " + corner + "\n";
    return text + "  endloop\n endfacet\n";
  };
  return "solid wall\n" + facet("-200 -200", "200 -200", "200 200") + facet("-200 -200", "200 200", "-200 200") +
         "endsolid wall\n";
}

/// The figure of a body against a role in a list of them.
json figure(const json& list, const std::string& body, const std::string& against) {
  for (const json& f : list)
    if (f.at("body") == body && f.at("against") == against) return f;
  return {};
}

class CliClearance : public Cli {
 protected:
  /// Of the blade that the program makes.
  [[nodiscard]] Outcome fit(std::vector<std::string> more) const {
    std::vector<std::string> words{"fit", make_blade(),  "--face", "F1", "--side",
                                   "+",   "--tolerance", "0.1",    "-o", path("out")};
    words.insert(words.end(), more.begin(), more.end());
    return flank(words);
  }
};

TEST_F(CliClearance, RefusesBadInputBeforeAnyWork) {
  const std::string blade = make_blade();
  const auto refused = [&](std::vector<std::string> more, int code, const std::string& what) {
    SCOPED_TRACE(what);
    std::vector<std::string> words{"fit", blade, "--face", "F1", "-o", path("out")};
    words.insert(words.end(), more.begin(), more.end());
    expect_refused(words, code, what);
  };
  refused({"--fixture", path("vice.step")}, 3, "vice.step");
  refused({"--clearance", "-1", "--shank-length", "30"}, 2, "--clearance");
  refused({"--clearance", "nan", "--shank-length", "30"}, 2, "--clearance");
  refused({"--clearance", "1", "--shank", "none"}, 2, "--shank-length");
  refused({"--shank-radius", "4", "--shank", "none"}, 2, "--shank-length");
  refused({"--shank-length", "0"}, 2, "--shank-length");
  refused({"--shank-length", "30", "--shank-diameter=-8"}, 2, "--shank");
  refused({"--holder", "30:10,20:10"}, 2, "z must not fall");
  refused({"--holder", "30:10,40:-1"}, 2, "negative");
  refused({"--holder", "30:10"}, 2, "pairs");
  refused({"--holder", "30:10,40"}, 2, "pairs");
  refused({"--holder", "30:10,40:wide"}, 2, "wide");
  refused({"--holder", path("holder.txt")}, 3, "holder.txt");
  write_file(root_ / "holder.txt", "30 10\n40 ten\n");
  refused({"--holder", path("holder.txt")}, 2, "ten");
  write_file(root_ / "holder.json", "[[30, 10], [40]]");
  refused({"--holder", path("holder.json")}, 3, "holder.json");
}

class CliClearanceFit : public CliClearance {
 protected:
  void SetUp() override {
    if (kSanitized)
      GTEST_SKIP() << "a whole fit takes minutes under a sanitizer; its parts are tested there one by one";
    Cli::SetUp();
  }
};

TEST_F(CliClearanceFit, ShankOfTheTopRadiusAndAHolderAboveIt) {
  const Outcome free = fit({"--shank-length", "30", "--holder", "30:10,70:10", "--clearance", "0.5"});
  ASSERT_EQ(free.exit_code, 0) << free.out << free.err;
  EXPECT_NE(free.out.find("shank"), std::string::npos) << free.out;
  const json tool = json::parse(read_file(root_ / "out/tool.json"));
  const json& shank = tool.at("shank").at("profile");
  EXPECT_NEAR(shank.at(1).at(0).get<double>() - shank.at(0).at(0).get<double>(), 30.0, 1e-9);
  EXPECT_EQ(tool.at("holder").at(0).at(0), shank.at(1).at(0));
  const json verify = json::parse(read_file(root_ / "out/verify.json"));
  const json holder = figure(verify.at("clearance"), "holder", "target");
  ASSERT_FALSE(holder.is_null());
  EXPECT_TRUE(holder.at("kept"));
  EXPECT_GT(holder.at("clearance_mm").get<double>(), 10.0);
  EXPECT_EQ(holder.at("required_mm"), 0.5);
  EXPECT_EQ(json::parse(read_file(root_ / "out/summary.json")).at("clearance"), verify.at("clearance"));
  // Judged again from the folder alone: the same figures.
  ASSERT_EQ(flank({"verify", path("out")}).exit_code, 0);
  EXPECT_EQ(json::parse(read_file(root_ / "out/verify.json")).at("clearance"), verify.at("clearance"));
}

TEST_F(CliClearanceFit, AFixtureInTheWayIsExitOneAndNamed) {
  write_file(root_ / "far.stl", wall(-300));
  write_file(root_ / "near.stl", wall(20));
  ASSERT_EQ(fit({"--shank-length", "30", "--fixture", path("far.stl"), "--unit", "mm", "--clearance", "5"}).exit_code,
            0);
  const Outcome hit = flank({"verify", path("out"), "--fixture", path("far.stl"), "--fixture", path("near.stl")});
  EXPECT_EQ(hit.exit_code, 1) << hit.err;
  EXPECT_NE(hit.out.find("COLLISION"), std::string::npos) << hit.out;
  EXPECT_NE(hit.out.find("near.stl"), std::string::npos) << hit.out;
  const json list = json::parse(read_file(root_ / "out/verify.json")).at("clearance");
  // The wall stands in the way of the flank; on which side of it the shank ends is the fit's to choose.
  ASSERT_FALSE(figure(list, "shank", "fixture").is_null());
  const json f = figure(list, "flank", "fixture");
  ASSERT_FALSE(f.is_null());
  EXPECT_LT(f.at("clearance_mm").get<double>(), 0.0);
  EXPECT_FALSE(f.at("kept"));
  EXPECT_NEAR(f.at("point").at(0).get<double>(), 20.0, 1e-9);
  // A mesh without a unit is refused like any other.
  write_file(root_ / "out/job.json", [&] {
    json job = json::parse(read_file(root_ / "out/job.json"));
    job.erase("unit");
    return job.dump();
  }());
  fs::rename(root_ / "out", root_ / "judged");
  expect_refused({"verify", path("judged")}, 3, "give --fixture-unit: mm");
  // The job was changed by hand on purpose.
  fs::remove(root_ / "judged/manifest.json");
  EXPECT_EQ(flank({"verify", path("judged"), "--fixture-unit", "mm"}).exit_code, 0);
  // Ten times as far away it is not in the way.
  const std::vector<std::string> near{"verify", path("judged"), "--fixture", path("near.stl"), "--fixture-unit"};
  const auto in = [&](const char* unit) {
    std::vector<std::string> words = near;
    words.emplace_back(unit);
    return flank(words).exit_code;
  };
  EXPECT_EQ(in("mm"), 1);
  EXPECT_EQ(in("cm"), 0);
}

TEST_F(CliClearanceFit, AWideHolderHitsTheRealImpeller) {
  FLANK_REAL_PART(part, "kj66_impeller.step");
  // Planned as if the other faces were not there; the length of the axis is given, so that nothing is lifted.
  const Outcome outcome = flank({"fit", part, "--face", "F1", "--tolerance", "0.05", "-o", path("out"), "--avoid",
                                 "off", "--axis-length", "55", "--shank-length", "10", "--holder", "10:45,50:45"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  const json list = json::parse(read_file(root_ / "out/verify.json")).at("clearance");
  const json holder = figure(list, "holder", "part");
  ASSERT_FALSE(holder.is_null());
  EXPECT_LT(holder.at("clearance_mm").get<double>(), -0.1);
  EXPECT_EQ(holder.at("obstacle").get<std::string>().front(), 'F');
  EXPECT_NE(outcome.out.find("the holder collides with F"), std::string::npos) << outcome.out;
  // A slim one behind a longer shank is free, whatever else is wrong.
  const Outcome slim = flank({"verify", path("out"), "--shank-length", "30", "--holder", "30:10,70:10"});
  const json verify = json::parse(read_file(root_ / "out/verify.json"));
  for (const json& f : verify.at("clearance")) EXPECT_TRUE(f.at("kept")) << f;
  for (const json& reason : verify.at("reasons")) EXPECT_NE(reason.at("figure"), "clearance") << reason;
  EXPECT_EQ(slim.exit_code, verify.at("pass").get<bool>() ? 0 : 1);
}

}  // namespace
}  // namespace flank::cli
