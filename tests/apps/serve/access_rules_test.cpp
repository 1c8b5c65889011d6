// Who gets in, by the head of a request.
#include "apps/serve/access_rules.h"

#include <gtest/gtest.h>

namespace swell::serve {
namespace {

using Fields = std::vector<std::pair<std::string, std::string>>;

AccessRules rules_with_token(const std::string& token) {
  return {{"localhost", "127.0.0.1", "::1", "192.168.0.7"}, {"sea.example"}, token, 8123};
}

int status_of(const std::string& target, Fields fields, const std::string& token = "0123") {
  return judge({"GET", target, std::move(fields), {}}, rules_with_token(token)).status;
}

int host_status(const std::string& host) {
  return status_of("/scene", {{"host", host}, {"Authorization", "Bearer 0123"}});
}

TEST(AccessRules, TakeTheHostsOfThisServerWithAnyPort) {
  for (const char* host : {"localhost", "LocalHost:8123", "127.0.0.1:8123", "[::1]:8123", "[::1]",
                           "192.168.0.7:9", "sea.example", "Sea.Example:443"})
    EXPECT_EQ(host_status(host), 200) << host;
}

TEST(AccessRules, RefuseAnyOtherHostAndNameTheOption) {
  for (const char* host :
       {"evil.example:8123", "evil.example", "", ":8123", "127.0.0.1.evil.example", "::1", "[::1",
        "[::1]x", "127.0.0.1:80x", "localhost.", "127.0.0.1:8123:1", "localhost:123456",
        "[127.0.0.1].evil.example", "localhost@evil.example"})
    EXPECT_EQ(host_status(host), 421) << host;
  const Verdict verdict =
      judge({"GET", "/", {{"Host", "evil.example"}}, {}}, rules_with_token("0123"));
  EXPECT_NE(verdict.line.find("--serve-host NAME"), std::string::npos);
  EXPECT_EQ(status_of("/", {}), 400);
  EXPECT_EQ(status_of("/", {{"Host", "localhost"}, {"Host", "evil.example"}}), 400);
}

// DNS rebinding: both fields hold the attacker's name.
TEST(AccessRules, AreNotTakenInByAnOriginThatEqualsAForeignHost) {
  for (const char* token : {"0123", ""})
    EXPECT_EQ(status_of("/scene",
                        {{"Host", "evil.example:8123"},
                         {"Origin", "http://evil.example:8123"},
                         {"Authorization", "Bearer 0123"}},
                        token),
              421);
}

TEST(AccessRules, RefuseAForeignOriginAndSayThatItIsForeign) {
  const auto verdict = [](const std::string& origin) {
    return judge(
        {"POST",
         "/input",
         {{"Host", "127.0.0.1:8123"}, {"Origin", origin}, {"Authorization", "Bearer 0123"}},
         {}},
        rules_with_token("0123"));
  };
  for (const char* origin : {"http://elsewhere.example", "null", "http://127.0.0.1:8124", "",
                             "http://localhost:8123", "file://127.0.0.1:8123"}) {
    EXPECT_EQ(verdict(origin).status, 403) << origin;
    EXPECT_EQ(verdict(origin).line.find("token"), std::string::npos) << origin;
  }
  for (const char* origin : {"http://127.0.0.1:8123", "https://sea.example"})
    EXPECT_EQ(verdict(origin).status, 200) << origin;
}

TEST(AccessRules, RefuseWhatABrowserSaysAPageElsewhereAsksFor) {
  const auto status = [](const std::string& target, const std::string& site,
                         const std::string& mode, const std::string& dest) {
    return status_of(target,
                     {{"Host", "127.0.0.1:8123"},
                      {"Sec-Fetch-Site", site},
                      {"Sec-Fetch-Mode", mode},
                      {"Sec-Fetch-Dest", dest}},
                     "");  // without a token, too
  };
  EXPECT_EQ(status("/stream", "cross-site", "no-cors", "image"), 403);
  EXPECT_EQ(status("/stream", "same-site", "no-cors", "image"), 403);
  EXPECT_EQ(status("/", "cross-site", "navigate", "iframe"), 403);
  EXPECT_EQ(status("/scene", "cross-site", "navigate", "document"), 403);
  EXPECT_EQ(status("/", "cross-site", "navigate", "document"), 200);  // a link in a mail
  EXPECT_EQ(status("/stream", "same-origin", "cors", "empty"), 200);
  EXPECT_EQ(status("/scene", "none", "navigate", "document"), 200);
}

TEST(AccessRules, TakeTheTokenAsABearerAsACookieAndInTheQueryOfThePage) {
  const auto status = [](const std::string& target, const std::string& field,
                         const std::string& value) {
    return status_of(target, {{"Host", "localhost"}, {field, value}});
  };
  EXPECT_EQ(status("/scene", "Authorization", "Bearer 0123"), 200);
  EXPECT_EQ(status("/scene", "Authorization", "bearer 0123"), 200);
  EXPECT_EQ(status("/scene", "Cookie", "a=b; swell_token_8123=0123"), 200);
  EXPECT_EQ(status("/?token=0123", "Accept", "*/*"), 200);
  EXPECT_EQ(status("/?a=b&token=0123", "Accept", "*/*"), 200);
  for (const char* value : {"Bearer", "Bearer ", "Bearer 01234", "Bearer 0124", "0123", ""})
    EXPECT_EQ(status("/scene", "Authorization", value), 403) << value;
  for (const char* value : {"swell_token_8124=0123", "xswell_token_8123=0123",
                            "swell_token_8123=", "swell_token_8123", ";;=;"})
    EXPECT_EQ(status("/scene", "Cookie", value), 403) << value;
  for (const char* target : {"/scene?token=0123", "/?token=", "/?token=0124", "/?token=01234",
                             "/?Token=0123", "/", "/?", ""})
    EXPECT_EQ(status(target, "Accept", "*/*"), 403) << target;
}

}  // namespace
}  // namespace swell::serve
