#include "flank/results/view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "flank/envelope/path_regularity.h"
#include "flank/example.h"
#include "flank/results/view_body_json.h"
#include "flank/results/view_json.h"
#include "flank/setup/setup.h"
#include "flank/setup/targets.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

std::vector<std::uint8_t> bytes(const std::string& text) { return {text.begin(), text.end()}; }

/// The reader's side, written apart from the writer.
std::vector<int> undo_deltas(const std::vector<std::uint8_t>& bytes) {
  std::vector<int> out;
  int before = 0;
  for (std::size_t at = 0; at < bytes.size();) {
    std::uint64_t value = 0;
    for (int shift = 0;; shift += 7) {
      value |= static_cast<std::uint64_t>(bytes[at] & 127) << shift;
      if (bytes[at++] < 128) break;
    }
    before += static_cast<int>(value >> 1) ^ -static_cast<int>(value & 1);
    out.push_back(before);
  }
  return out;
}

TEST(ViewJson, Base64IsTheStandardOne) {
  // RFC 4648, section 10.
  EXPECT_EQ(to_base64(bytes("")), "");
  EXPECT_EQ(to_base64(bytes("f")), "Zg==");
  EXPECT_EQ(to_base64(bytes("fo")), "Zm8=");
  EXPECT_EQ(to_base64(bytes("foo")), "Zm9v");
  EXPECT_EQ(to_base64(bytes("foobar")), "Zm9vYmFy");
  EXPECT_EQ(to_base64({255, 254, 253}), "//79");
}

TEST(ViewJson, PointsAreQuantisedOnTheirBox) {
  Box3 box;
  box.add(Vec3(-1, 2, 5));
  box.add(Vec3(1, 4, 5));
  EXPECT_EQ(quantised({{-1, 4, 5}, {0, 3, 5}}, box),
            (std::vector<std::uint8_t>{0, 0, 255, 255, 0, 0, 0, 128, 0, 128, 0, 0}));
}

TEST(ViewJson, IndicesComeBack) {
  const std::vector<int> indices{0, 1, 2, 2, 1, 300000, 7, 64, 0, 127, 128, 2000000000, 0};
  EXPECT_EQ(undo_deltas(delta_coded(indices)), indices);
  EXPECT_EQ(delta_coded({0, 1, 2, 1}).size(), 4u);
}

TEST(ViewJson, FloatsAreLittleEndian) {
  EXPECT_EQ(as_floats({1.0, -2.5}), (std::vector<std::uint8_t>{0, 0, 128, 63, 0, 0, 32, 192}));
}

/// A part whose truth is known: the tool and the path leave it exactly.
class ViewOfExample : public ::testing::Test {
 protected:
  void SetUp() override {
    const Example example = make_example("envelope-barrel-1");
    part_.faces = example.faces;
    for (const Face& face : part_.faces)
      for (const Vec3& p : face.surface.poles) part_.box.add(p);
    tool_ = example.truth->tool;
    path_ = example.truth->path;
    job_.part.file = "/somewhere/barrel.step";
    job_.tolerance_mm = 0.01;
    JudgeOptions options;
    options.tolerance_mm = *job_.tolerance_mm;
    verdict_ = judge(tool_, path_, judge_samples(setup(), 0.5, 1.0), options);
    view_ = make_view(job_, setup(), tool_, path_, verdict_);
  }

  [[nodiscard]] internal::Setup setup() const { return {part_, {0}, {}, *job_.tolerance_mm, {}}; }

  FitJob job_;
  Part part_;
  Tool tool_;
  Path path_;
  VerifyReport verdict_;
  View view_;
};

TEST_F(ViewOfExample, VerticesOfAnExactFaceHaveNoError) {
  ASSERT_EQ(view_.bodies.size(), part_.faces.size());
  const ViewFace& target = view_.bodies.front();
  EXPECT_TRUE(target.target);
  ASSERT_EQ(target.f_mm.size(), target.mesh.vertices.size());
  EXPECT_GT(target.mesh.triangles.size(), 0.5 * kTargetTriangles);
  EXPECT_LT(target.mesh.triangles.size(), 4 * kTargetTriangles);
  for (double f : target.f_mm) EXPECT_NEAR(f, 0.0, 1e-3);
}

TEST_F(ViewOfExample, TheSwingAlongThePathIsThatOfTheVertices) {
  ASSERT_EQ(view_.strips.size(), path_.strips.size());
  const auto [low, high] = std::minmax_element(view_.bodies.front().f_mm.begin(), view_.bodies.front().f_mm.end());
  for (const ViewStrip& strip : view_.strips) {
    EXPECT_EQ(strip.pose_count, path_.strips.front().poses.size());
    EXPECT_EQ(strip.index.front(), 0u);
    EXPECT_EQ(strip.index.back() + 1, strip.pose_count);
    EXPECT_LE(strip.poses.size(), kMostPosesShown + 1);
    EXPECT_LE(strip.places.size(), kMostPlaces);
    for (const ViewPlace& place : strip.places) {
      EXPECT_LT(place.largest_c, 1.0);
      if (place.lowest_f_mm > place.highest_f_mm) continue;
      EXPECT_GE(place.lowest_f_mm, *low);
      EXPECT_LE(place.highest_f_mm, *high);
    }
  }
}

TEST_F(ViewOfExample, ClearanceAlongThePathWhereItWasAsked) {
  const auto json = [&] {
    return nlohmann::json::parse(view_to_json(make_view(job_, setup(), tool_, path_, verdict_)));
  };
  EXPECT_FALSE(json().at("strips").at(0).at("places").contains("clearance_mm"));
  std::vector<double> poses;
  for (std::size_t k = 0; k < path_.strips.front().poses.size(); ++k) poses.push_back(100.0 - static_cast<double>(k));
  verdict_.clearance.pose_clearance_mm = {poses};
  const nlohmann::json places = json().at("strips").at(0).at("places");
  ASSERT_EQ(places.at("clearance_mm").size(), places.at("t").size());
  // It falls along the path, so that a place has that of its last pose.
  for (std::size_t k = 0; k < places.at("t").size(); ++k) {
    const double last =
        std::ceil(static_cast<double>((k + 1) * (poses.size() - 1)) / static_cast<double>(places.at("t").size()));
    EXPECT_NEAR(places.at("clearance_mm").at(k).get<double>(), 100.0 - last, 1e-4) << k;
  }
}

TEST_F(ViewOfExample, RegularityIsThatOfTheWholePath) {
  double largest = 0.0;
  for (const ViewPlace& place : view_.strips.front().places) largest = std::max(largest, place.largest_c);
  EXPECT_GT(largest, 0.0);
  EXPECT_LE(largest, largest_c(path_, tool_.radial)) << "places that touch nothing do not count";
  // A step along the tool's own axis is a plunge.
  Path plunge = path_;
  Pose last = plunge.strips.front().poses.back();
  last.tip += 0.1 * last.axis;
  plunge.strips.front().poses.push_back(last);
  EXPECT_GT(largest_c(plunge, tool_.radial), 1.0);
}

TEST_F(ViewOfExample, TheProfileIsTheMeridianWithItsCurvature) {
  ASSERT_GT(view_.profile.size(), 100u);
  const double arc = tool_.radial.parameters()[0];
  for (const ProfilePoint& p : view_.profile) {
    EXPECT_NEAR(p.curvature_per_mm, 1.0 / arc, 1e-9) << "a barrel's meridian is a circle arc";
    EXPECT_NEAR((Vec2(p.z, p.rho) - meridian_point(tool_.radial, p.s)).norm(), 0.0, 1e-12);
  }
}

TEST_F(ViewOfExample, TheFileIsTheSameAgainAndHidesTheFolder) {
  const std::string text = view_to_json(view_);
  EXPECT_EQ(text, view_to_json(make_view(job_, setup(), tool_, path_, verdict_)));
  EXPECT_EQ(text.find("/somewhere"), std::string::npos);
  const auto json = nlohmann::json::parse(text);
  EXPECT_EQ(json.at("schema"), "openflank/view/1");
  EXPECT_EQ(json.at("part"), "barrel.step");
  EXPECT_EQ(json.at("command"), "flank fit barrel.step --face F1 --tolerance 0.01");
  const auto& body = json.at("bodies").at(0);
  EXPECT_EQ(body.at("positions").get<std::string>().size(), (body.at("vertices").get<std::size_t>() * 6 + 2) / 3 * 4);
  EXPECT_EQ(body.at("f_mm").get<std::string>().size(), (body.at("vertices").get<std::size_t>() * 4 + 2) / 3 * 4);
}

TEST_F(ViewOfExample, AFaceThatIsEnteredIsColoured) {
  // The target once more, raised by half a millimetre into the tool, as a check surface.
  Part part = part_;
  Face raised = part.faces.front();
  raised.id = "F2";
  const SurfaceJet jet = raised.surface.jet(0.5 * (raised.surface.u_first() + raised.surface.u_last()),
                                            0.5 * (raised.surface.v_first() + raised.surface.v_last()));
  const Vec3 normal = (raised.reversed ? -1.0 : 1.0) * jet.du.cross(jet.dv).normalized();
  for (Vec3& p : raised.surface.poles) p += 0.5 * normal;
  Face far = raised;
  far.id = "F3";
  for (Vec3& p : far.surface.poles) p -= 50.0 * normal;
  part.faces = {part.faces.front(), raised, far};
  JudgeOptions options;
  const internal::Setup raised_setup{part, {0}, {1, 2}, *job_.tolerance_mm, {}};
  const VerifyReport verdict = judge(tool_, path_, judge_samples(raised_setup, 0.5, 1.0), options);
  const View view = make_view(job_, raised_setup, tool_, path_, verdict);
  ASSERT_EQ(view.bodies.size(), 3u);
  ASSERT_FALSE(view.bodies[1].f_mm.empty());
  EXPECT_LT(*std::min_element(view.bodies[1].f_mm.begin(), view.bodies[1].f_mm.end()), -0.4);
  EXPECT_TRUE(view.bodies[2].f_mm.empty());
}

TEST(View, AMeshKeepsItsFacesAndACoarseTargetIsDivided) {
  Part part;
  part.mesh.vertices = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}};
  part.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  part.mesh_faces = {{0}, {1}};
  part.box = part.mesh.box();
  FitJob job;
  job.part.file = "two.stl";
  job.part.unit = "mm";
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCylinder, 10.0, Eigen::VectorXd::Constant(1, 2.0));
  const View view = make_view(job, {part, {0}, {}, 0.01, {}}, tool, {}, {});
  ASSERT_EQ(view.bodies.size(), 2u);
  EXPECT_GT(view.bodies[0].mesh.triangles.size(), kTargetTriangles / 4);
  EXPECT_EQ(view.bodies[1].mesh.triangles.size(), 1u);
  EXPECT_TRUE(view.bodies[0].f_mm.empty()) << "there is no path, so there is no error";
  EXPECT_EQ(view.command, "flank fit two.stl --unit mm --face F1");
}

TEST(View, AVeryFineMeshIsDrawnCoarser) {
  if (kThreadSanitized) GTEST_SKIP() << "minutes, on one thread";
  constexpr int kSide = 400;  // a few more triangles than are drawn
  Part part;
  part.mesh_faces.resize(1);
  for (int j = 0; j <= kSide; ++j)
    for (int i = 0; i <= kSide; ++i) {
      part.mesh.vertices.emplace_back(0.1 * i, 0.1 * j, 3.0);
      if (i == kSide || j == kSide) continue;
      const int a = j * (kSide + 1) + i, b = a + kSide + 1;
      for (const std::array<int, 3>& t : {std::array{a, a + 1, b}, std::array{a + 1, b + 1, b}}) {
        part.mesh_faces[0].push_back(static_cast<int>(part.mesh.triangles.size()));
        part.mesh.triangles.push_back(t);
      }
    }
  part.box = part.mesh.box();
  FitJob job;
  job.part.file = "fine.stl";
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCylinder, 10.0, Eigen::VectorXd::Constant(1, 2.0));
  const View view = make_view(job, {part, {0}, {}, 0.01, {}}, tool, {}, {});
  const TriangleMesh& mesh = view.bodies[0].mesh;
  EXPECT_LE(mesh.triangles.size(), kMostMeshTriangles);
  EXPECT_GT(mesh.triangles.size(), kMostMeshTriangles / 4);
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += 0.5 * (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).norm();
  EXPECT_NEAR(area, 1600.0, 0.01 * 1600.0);
}

}  // namespace
}  // namespace flank::internal
