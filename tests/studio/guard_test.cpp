// Who is let in, and who is not.
#include "flank/studio/guard.h"

#include <gtest/gtest.h>

#include <set>

namespace flank::internal {
namespace {

constexpr int kPort = 4711;
const std::string kToken = "0123456789abcdef0123456789abcdef";

Visitor our_page() { return {"/" + kToken + "/api/state", "127.0.0.1:4711", "http://127.0.0.1:4711", "same-origin"}; }

TEST(Guard, LetsOurOwnPageIn) {
  EXPECT_EQ(let_in(our_page(), kToken, kPort), "/api/state");
  EXPECT_EQ(let_in({"/" + kToken + "/", "localhost:4711", "", "none"}, kToken, kPort), "/") << "typed by the user";
}

TEST(Guard, RefusesAnotherToken) {
  for (std::string token : {kToken.substr(1), kToken + "0", std::string(32, '0'), std::string()}) {
    Visitor visitor = our_page();
    visitor.path = "/" + token + "/api/state";
    EXPECT_EQ(let_in(visitor, kToken, kPort), "") << visitor.path;
  }
  for (const char* path : {"", "/", "//", "/api/state"}) {
    Visitor visitor = our_page();
    visitor.path = path;
    EXPECT_EQ(let_in(visitor, kToken, kPort), "") << path;
  }
}

TEST(Guard, RefusesAnotherHost) {
  for (const char* host : {"evil.example:4711", "127.0.0.1", "127.0.0.1:4712", "127.0.0.1:4711.evil.example", ""}) {
    Visitor visitor = our_page();
    visitor.host = host;
    visitor.origin = "";
    EXPECT_EQ(let_in(visitor, kToken, kPort), "") << host;
  }
}

TEST(Guard, RefusesScriptsOfOtherPages) {
  Visitor visitor = our_page();
  visitor.origin = "http://evil.example";
  EXPECT_EQ(let_in(visitor, kToken, kPort), "");
  visitor.origin = "null";
  EXPECT_EQ(let_in(visitor, kToken, kPort), "") << "a page from a file";
  visitor.origin = "";
  for (const char* site : {"cross-site", "same-site"}) {
    visitor.site = site;
    EXPECT_EQ(let_in(visitor, kToken, kPort), "") << site;
  }
}

TEST(Guard, TokensDiffer) {
  std::set<std::string> seen;
  for (int k = 0; k < 100; ++k) {
    const std::string token = new_token();
    EXPECT_EQ(token.size(), 32u);
    EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
    seen.insert(token);
  }
  EXPECT_EQ(seen.size(), 100u);
}

}  // namespace
}  // namespace flank::internal
