#include "flank/io/text/json_input.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "flank/base/random.h"
#include "flank/error.h"
#include "io/part_files.h"

namespace flank::internal {
namespace {

std::string complaint(const std::string& text, const std::function<void(const JsonInput&)>& use) {
  try {
    use(JsonInput("f.json", text));
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

const std::function<void(const JsonInput&)> kNothing = [](const JsonInput&) {};

TEST(JsonInput, ReadsWhatIsThere) {
  const JsonInput in("f.json", R"({"a": {"list": [1, 2.5, -3e2]}, "n": 7, "t": "x\u00e4", "p": [[1, 2], [3, 4]]})");
  EXPECT_EQ(in.keys(), (std::vector<std::string>{"a", "n", "p", "t"}));
  EXPECT_TRUE(in.has("n"));
  EXPECT_FALSE(in.has("m"));
  EXPECT_EQ(in.member("n").integer(), 7);
  EXPECT_EQ(in.member("n").number(), 7.0);
  EXPECT_EQ(in.member("n").positive(), 7.0);
  EXPECT_EQ(in.member("t").text(), "x\xc3\xa4");
  EXPECT_EQ(in.member("a").member("list").numbers(3), (std::vector<double>{1.0, 2.5, -300.0}));
  EXPECT_EQ(in.member("a").member("list").element(1).number(), 2.5);
  EXPECT_EQ(in.member("a").member("list").size(), 3u);
  EXPECT_TRUE(in.member("p").is_array());
  EXPECT_FALSE(in.is_array());
  EXPECT_EQ(in.member("p").pairs(), (std::vector<Vec2>{{1, 2}, {3, 4}}));
  EXPECT_FALSE(in.member("p").has("x")) << "an array has no keys";
}

TEST(JsonInput, AValueOutlivesTheDocumentItCameFrom) {
  std::vector<JsonInput> kept;
  kept.push_back(JsonInput("f.json", R"({"a": {"b": [4, 5]}})").member("a").member("b"));
  EXPECT_EQ(kept[0].numbers(2), (std::vector<double>{4.0, 5.0}));
}

TEST(JsonInput, EveryComplaintNamesFileAndPlace) {
  const std::string text = R"({"a": {"list": [1, "x", null, [1]]}, "n": -7.5, "big": 3000000000, "t": "x", "b": true})";
  using In = const JsonInput&;
  const std::vector<std::pair<std::function<void(In)>, std::string>> cases = {
      {[](In in) { (void)in.member("zz"); }, "f.json: \"zz\" is missing"},
      {[](In in) { (void)in.member("a").member("zz"); }, "f.json: a: \"zz\" is missing"},
      {[](In in) { (void)in.member("n").member("zz"); }, "f.json: n: must be an object {...}"},
      {[](In in) { (void)in.member("n").keys(); }, "f.json: n: must be an object {...}"},
      {[](In in) { (void)in.member("a").size(); }, "f.json: a: must be an array [...]"},
      {[](In in) { (void)in.member("a").member("list").element(4); }, "f.json: a.list: is too short"},
      {[](In in) { (void)in.member("a").member("list").element(1).number(); }, "f.json: a.list[1]: must be a number"},
      {[](In in) { (void)in.member("a").member("list").element(2).text(); },
       "f.json: a.list[2]: must be a text \"...\""},
      {[](In in) { (void)in.member("a").member("list").numbers(3); }, "f.json: a.list: has 4 entries; must have 3"},
      {[](In in) { (void)in.member("a").member("list").numbers(4); }, "f.json: a.list[1]: must be a finite number"},
      {[](In in) { (void)in.member("a").member("list").pairs(); }, "f.json: a.list[0]: must be an array [...]"},
      {[](In in) { (void)in.member("a").member("list").element(3).numbers(2); },
       "f.json: a.list[3]: has 1 entries; must have 2"},
      {[](In in) { (void)in.member("n").integer(); }, "f.json: n: must be a whole number"},
      {[](In in) { (void)in.member("big").integer(); }, "f.json: big: must be a whole number"},
      {[](In in) { (void)in.member("n").positive(); }, "f.json: n: is -7.5; must be > 0"},
      {[](In in) { (void)in.member("b").number(); }, "f.json: b: must be a number"},
      {[](In in) { (void)in.member("t").number(); }, "f.json: t: must be a number"},
      {[](In in) { in.member("t").refuse("is odd"); }, "f.json: t: is odd"},
      {[](In in) {
         in.allow_keys({"a", "n", "t"});
       },
       "f.json: unknown key \"b\"; accepted: a, n, t"}};
  for (const auto& [use, expected] : cases) EXPECT_EQ(complaint(text, use), expected);
}

TEST(JsonInput, RefusesWhatIsNoObjectOrNoJson) {
  for (const char* text : {"[1]", "3", "\"a\"", "null"})
    EXPECT_EQ(complaint(text, kNothing), "f.json: must be a JSON object {...}") << text;
  for (const char* text :
       {"", "{", "{\"a\": }", "{\"a\": 1}}", "{\"a\": nan}", "{\"a\": 1e999}", "{'a': 1}", "{\"a\": 01}"}) {
    const std::string message = complaint(text, kNothing);
    EXPECT_EQ(message.rfind("f.json: not valid JSON, ", 0), 0u) << message;
    EXPECT_EQ(message.find("json.exception"), std::string::npos) << "no word of the parser's own: " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  EXPECT_NE(complaint("{\n\"a\": x}", kNothing).find("line 2"), std::string::npos);
}

TEST(JsonInput, RefusesAKeyThatOccursTwiceInOneObject) {
  EXPECT_EQ(complaint(R"({"a": 1, "b": {"a": 2}, "c": [{"a": 1}, {"a": 2}]})", kNothing), "accepted");
  EXPECT_EQ(complaint(R"({"a": 1, "b": {"a": 2}, "a": 3})", kNothing), "f.json: key \"a\" occurs twice");
  EXPECT_EQ(complaint(R"({"b": [{"x": 1, "x": 1}]})", kNothing), "f.json: key \"x\" occurs twice");
}

TEST(JsonInput, RefusesADepthThatNoFileOfOursHas) {
  const auto nested = [](int depth) {
    return "{\"a\": " + std::string(static_cast<std::size_t>(depth), '[') +
           std::string(static_cast<std::size_t>(depth), ']') + "}";
  };
  EXPECT_EQ(complaint(nested(40), kNothing), "accepted");
  EXPECT_EQ(complaint(nested(100), kNothing), "f.json: nested too deep");
  EXPECT_EQ(complaint(nested(1000000), kNothing), "f.json: nested too deep");
}

TEST(JsonInput, SchemaAndUnitsAreHeldAgainstWhatIsAccepted) {
  const auto check = [](const JsonInput& in) { in.require_schema("openflank/x/1"); };
  EXPECT_EQ(complaint(R"({"schema": "openflank/x/1"})", check), "accepted");
  EXPECT_EQ(complaint(R"({"schema": "openflank/x/1", "units": "mm"})", check), "accepted");
  EXPECT_EQ(complaint("{}", check), "f.json: no \"schema\"; accepted: \"openflank/x/1\"");
  EXPECT_EQ(complaint(R"({"schema": "openflank/x/2"})", check),
            "f.json: schema: is \"openflank/x/2\"; accepted: \"openflank/x/1\"");
  EXPECT_EQ(complaint(R"({"schema": "openflank/x/1", "units": "in"})", check),
            "f.json: units: is \"in\"; accepted: \"mm\"");
  EXPECT_EQ(complaint(R"({"schema": 1})", check), "f.json: schema: must be a text \"...\"");
}

TEST(ExactNumber, ReadsBackAsTheSameBits) {
  Random random(1);
  int looked = 0;
  for (int i = 0; i < 5000; ++i) {
    const std::uint64_t bits = random.next();
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    ++looked;
    ASSERT_EQ(std::strtod(exact_number(value).c_str(), nullptr), value);
    ASSERT_EQ(std::signbit(std::strtod(exact_number(value).c_str(), nullptr)), std::signbit(value));
    const std::string decimal = exact_decimal(value);
    ASSERT_EQ(decimal.find_first_of("eE"), std::string::npos);
    ASSERT_EQ(std::strtod(decimal.c_str(), nullptr), std::abs(value) < kSmallestDecimal ? 0.0 : value) << decimal;
  }
  EXPECT_GT(looked, 4000);
}

TEST(ExactNumber, TakesTheFewestDigits) {
  EXPECT_EQ(exact_number(0.1), "0.1");
  EXPECT_EQ(exact_number(-2.0), "-2");
  EXPECT_EQ(exact_decimal(-2.0), "-2.0");
  EXPECT_EQ(exact_decimal(1e-31), "0.0");
  EXPECT_EQ(exact_decimal(1e23), "100000000000000000000000.0");
  EXPECT_EQ(exact_decimal(-1.25e-7), "-0.000000125");
  EXPECT_EQ(exact_decimal(1e-7), "0.0000001");
  EXPECT_EQ(exact_decimal(-123456789012345680000.0), "-123456789012345680000.0");
  for (const double value : {std::nan(""), std::numeric_limits<double>::infinity(), -HUGE_VAL}) {
    EXPECT_THROW((void)exact_number(value), InternalError);
    EXPECT_THROW((void)exact_decimal(value), InternalError);
  }
}

TEST(JsonString, EscapesWhatMustBeAndIsReadBack) {
  EXPECT_EQ(json_string("a\"b\\c\n"), R"("a\"b\\c\n")");
  for (const std::string& text : {std::string("plain"), std::string("x\xc3\xa4\t\x01"), std::string("nul\0nul", 7)})
    EXPECT_EQ(JsonInput("f", "{\"a\": " + json_string(text) + "}").member("a").text(), text);
  // Bytes that are no UTF-8 are replaced, not refused: the rest of the file is worth more than a name.
  EXPECT_NE(JsonInput("f", "{\"a\": " + json_string("x\xffy") + "}").member("a").text().find('y'), std::string::npos);
}

TEST(ReadFile, IsTheWholeFileOrARefusalThatNamesIt) {
  const testing_io::Scratch scratch;
  const std::string bytes("a\0b\r\n\xff", 6);
  EXPECT_EQ(read_file(scratch.write("bytes", bytes)), bytes);
  const auto refused = [](const std::string& file) -> std::string {
    try {
      (void)read_file(file);
    } catch (const InputError& e) {
      return e.what();
    }
    return "read";
  };
  EXPECT_EQ(refused(scratch.path("none")), scratch.path("none") + ": no such file");
  EXPECT_EQ(refused(scratch.write("empty", "")), scratch.path("empty") + ": is empty");
  EXPECT_NE(refused(scratch.path("")).find(": is not a file"), std::string::npos);
  const std::string endless(5000, 'x');
  EXPECT_EQ(refused(endless), endless + ": no such file");
}

}  // namespace
}  // namespace flank::internal
