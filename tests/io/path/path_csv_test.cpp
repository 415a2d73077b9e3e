#include "flank/io/path/path_csv.h"

#include <gtest/gtest.h>

#include <string>

#include "flank/error.h"
#include "io/path/path_samples.h"

namespace flank::internal {
namespace {

const std::string kHead = "strip,kind,face,x,y,z,i,j,k\n";

Path strips(const std::string& kind, const std::string& face) {
  return {{{4, kind, face, {{Vec3(1, 2, 3), Vec3(0, 0, 1)}, {Vec3(4, 5, 6), Vec3(0, 1, 0)}}}}};
}

std::string refusal(const std::string& text) {
  try {
    (void)path_from_csv(text, "p.csv");
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(PathCsv, IsATableThatAProgramReads) {
  EXPECT_EQ(path_to_csv(strips("flank", "F1")), kHead + "4,flank,F1,1,2,3,0,0,1\n4,flank,F1,4,5,6,0,1,0\n");
  EXPECT_EQ(path_to_csv(strips("flank", "F1,F3")).substr(kHead.size(), 15), "4,flank,\"F1,F3\"");
  EXPECT_EQ(path_to_csv(strips("a \"b\"", "")).substr(kHead.size(), 16), "4,\"a \"\"b\"\"\",,1,2");
  EXPECT_EQ(path_to_csv(Path{}), kHead);
}

TEST(PathCsv, AnyTextSurvivesItsQuotes) {
  for (const char* text :
       {"", " ", ",", "\"", "\"\"", ",\",", "a\nb", "a\r\nb", "\r", "'", ";", "\xc3\xa4", "1,2,3,4,5,6,7,8,9"}) {
    const Path path = strips(text, text);
    EXPECT_TRUE(same(path_from_csv(path_to_csv(path), "p.csv"), path)) << '[' << text << ']';
  }
}

TEST(PathCsv, StripsBeginWhereTheNumberChanges) {
  const Path path = path_from_csv(
      kHead + "3,flank,F1,0,0,0,0,0,1\n3,flank,F1,1,0,0,0,0,1\n-2,link,,2,0,0,0,0,1\n7,flank,F2,3,0,0,0,0,1\n",
      "p.csv");
  ASSERT_EQ(path.strips.size(), 3u);
  EXPECT_EQ(path.strips[0].id, 3);
  EXPECT_EQ(path.strips[0].poses.size(), 2u);
  EXPECT_EQ(path.strips[1].id, -2);
  EXPECT_EQ(path.strips[1].kind, "link");
  EXPECT_EQ(path.strips[1].face, "");
  EXPECT_EQ(path.strips[2].poses[0].tip, Vec3(3, 0, 0));
}

TEST(PathCsv, LinesMayEndAsOtherSystemsEndThemAndBeEmpty) {
  const std::string dos = "strip,kind,face,x,y,z,i,j,k\r\n\r\n1,flank,F1,0,0,0,0,0,1\r\n\n1,flank,F1,1,0,0,0,0,1";
  const Path path = path_from_csv(dos, "p.csv");
  ASSERT_EQ(path.strips.size(), 1u);
  EXPECT_EQ(path.strips[0].poses.size(), 2u);
  EXPECT_EQ(path.strips[0].kind, "flank");
}

TEST(PathCsv, AComplaintNamesTheLineWhereItsRecordBegins) {
  // A quoted line break inside the record before must not shift the count.
  const std::string two = kHead + "1,\"a\nb\nc\",F1,0,0,0,0,0,1\n";
  EXPECT_EQ(refusal(two + "1,x,F1,0,0,0,0,0,zero\n"), "p.csv: line 5: \"zero\" is not a finite number");
  EXPECT_EQ(refusal(kHead + "\n\n1,flank\n"), "p.csv: line 4: has 2 columns; must have 9");
  EXPECT_EQ(refusal(kHead + "1,flank,F1,0,0,0,0,0,1,\n"), "p.csv: line 2: has 10 columns; must have 9");
}

TEST(PathCsv, OnlyPlainFiniteNumbersAreNumbers) {
  for (const char* word : {"", " 1", "1 ", "+1", "1.2.3", "1e", "0x1", "1e999", "inf", "-nan", "1,5", "--1"}) {
    const std::string line = std::string("1,flank,F1,") + word + ",0,0,0,0,1\n";
    EXPECT_NE(refusal(kHead + line), "accepted") << '[' << word << ']';
  }
  for (const char* word : {"-0", ".5", "5.", "1E3", "-1e-3"}) {
    const std::string line = std::string("1,flank,F1,") + word + ",0,0,0,0,1\n";
    EXPECT_EQ(refusal(kHead + line), "accepted") << '[' << word << ']';
  }
}

TEST(PathCsv, NumbersOfStripsAreWholeAndOfTheirSize) {
  for (const char* word : {"1.5", "1e10", "-1e300", "nan", "one"})
    EXPECT_NE(refusal(kHead + word + ",flank,F1,0,0,0,0,0,1\n"), "accepted") << word;
  EXPECT_EQ(path_from_csv(kHead + "1e2,flank,F1,0,0,0,0,0,1\n", "p.csv").strips[0].id, 100);
}

TEST(PathCsv, RoundedAxesAreMadeUnitVectorsAndOthersStay) {
  const Path path = path_from_csv(kHead + "1,flank,F1,0,0,0,0.7071,0,0.7071\n1,flank,F1,0,0,0,0.6,0,0.8\n", "p.csv");
  EXPECT_NEAR(path.strips[0].poses[0].axis.norm(), 1.0, 1e-15);
  EXPECT_NEAR(path.strips[0].poses[0].axis.x(), std::sqrt(0.5), 1e-15);
  EXPECT_EQ(path.strips[0].poses[1].axis, Vec3(0.6, 0, 0.8)) << "exact numbers are not touched";
  EXPECT_NE(refusal(kHead + "1,flank,F1,0,0,0,0,0,0\n").find("length 0"), std::string::npos);
  EXPECT_NE(refusal(kHead + "1,flank,F1,0,0,0,0,0,0.998\n").find("must be 1"), std::string::npos);
}

}  // namespace
}  // namespace flank::internal
