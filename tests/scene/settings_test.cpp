// Scenes that programs change: settings "key=value", and JSON.
#include "scene/settings.h"

#include <gtest/gtest.h>

#include "scene/scene_error.h"
#include "scene/scene_text.h"

namespace swell::scene {
namespace {

using Settings = std::vector<std::string>;

constexpr std::string_view kHarbour = R"([camera]
eye_m = [0, -50, 4]
[wind]
speed_mps = 8.0
[[object]]
kind = "boat"
[[object]]
kind = "buoy"
position_m = [5, 6]
)";

std::string error_with(std::string_view text, const Settings& settings,
                       const char* name = "test.toml") {
  try {
    parse_scene(text, name, settings);
  } catch (const SceneError& error) {
    return error.what();
  }
  return {};
}

TEST(Settings, SayWhatTheFileWouldSay) {
  const Settings settings = {"wind.speed_mps=12",        "camera.eye_m = [1, 2, 3]",
                             "coast.model=none",         "object[1].position_m=[7, 8]",
                             "object[0].name=ferry",     "detail.water_triangles=500",
                             "sky.sun_elevation_deg=5.5"};
  const Scene expected = parse_scene(R"([camera]
eye_m = [1, 2, 3]
[wind]
speed_mps = 12
[coast]
model = "none"
[detail]
water_triangles = 500
[sky]
sun_elevation_deg = 5.5
[[object]]
kind = "boat"
name = "ferry"
[[object]]
kind = "buoy"
position_m = [7, 8]
)",
                                     "test.toml");
  EXPECT_EQ(differences(parse_scene(kHarbour, "test.toml", settings), expected), "");
}

TEST(Settings, TheLastOneCounts) {
  const Settings settings = {"wind.speed_mps=12", "wind.speed_mps=5"};
  EXPECT_EQ(parse_scene("", "a.toml", settings).sea.wind_speed_mps, 5.0);
}

TEST(Settings, ChangeAnElementOfAnArray) {
  const Settings settings = {"camera.eye_m[2]=30"};
  EXPECT_EQ(parse_scene(kHarbour, "a.toml", settings).camera.eye_m, glm::dvec3(0, -50, 30));
}

TEST(Settings, AddTablesAtTheEnd) {
  const Settings settings = {"object[2].kind=rock", "object[2].position_m=[1, 1]",
                             "object[3].kind=pier"};
  const Scene scene = parse_scene(kHarbour, "a.toml", settings);
  ASSERT_EQ(scene.objects.size(), 4u);
  EXPECT_EQ(scene.objects[2].kind, ObjectKind::kRock);
  EXPECT_EQ(scene.objects[2].position_m, glm::dvec2(1, 1));
  EXPECT_EQ(scene.objects[3].kind, ObjectKind::kPier);
}

TEST(Settings, AnEmptyValueLeavesTheKeyOut) {
  const Scene scene =
      parse_scene(kHarbour, "a.toml", Settings{"wind.speed_mps=", "sea.douglas=5", "object[0]="});
  EXPECT_EQ(scene.douglas, 5);
  EXPECT_EQ(scene.objects.size(), 1u);
}

TEST(Settings, TextMayGoWithoutQuotesAndWithThem) {
  for (const char* setting : {"object[0].name=old \"Marie\"", "object[0].name='old \"Marie\"'"})
    EXPECT_EQ(parse_scene(kHarbour, "a.toml", Settings{setting}).objects[0].name, "old \"Marie\"");
}

TEST(Settings, TimesMayGoWithoutQuotesInFilesToo) {
  const std::string time = "2026-06-21T19:30:00Z", half = "2026-06-21T19:30:00.5Z";
  const Scene quoted = parse_scene("[sky]\ntime_utc = \"" + time + "\"\n", "test.toml");
  ASSERT_EQ(quoted.sky.time_utc, time);
  for (const Scene& scene :
       {parse_scene("", "test.toml", Settings{"sky.time_utc=" + time}),
        parse_scene("", "test.toml", Settings{"sky.time_utc=2026-06-21 19:30:00Z"}),
        parse_scene("[sky]\ntime_utc = " + time + "\n", "test.toml")})
    EXPECT_EQ(differences(scene, quoted), "");
  EXPECT_EQ(parse_scene("", "a.toml", Settings{"sky.time_utc=" + half}).sky.time_utc, half);
  const std::string allowed = "\", allowed a time as \"2026-06-21T12:00:00Z\", from 1900 to 2100";
  for (const std::string other :
       {"2026-06-21T19:30:00+02:00", "2026-06-21T19:30:00", "2026-06-21", "19:30:00"})
    EXPECT_EQ(error_with("", {"sky.time_utc=" + other}),
              "setting sky.time_utc=" + other + ": sky.time_utc, got \"" + other + allowed);
  EXPECT_EQ(error_with("", {"wind.speed_mps=2026-06-21"}),
            "setting wind.speed_mps=2026-06-21: wind.speed_mps, got 2026-06-21, allowed 0 to 60 "
            "m/s");
}

TEST(Settings, FaultsNameTheSetting) {
  EXPECT_EQ(error_with(kHarbour, {"wind.speed_mps=fast"}),
            "setting wind.speed_mps=fast: wind.speed_mps, got \"fast\", allowed 0 to 60 m/s");
  EXPECT_EQ(error_with(kHarbour, {"wind.speed_mps=900"}),
            "setting wind.speed_mps=900: wind.speed_mps, got 900, allowed 0 to 60 m/s");
  EXPECT_TRUE(error_with(kHarbour, {"wind.spede_mps=9"})
                  .starts_with("setting wind.spede_mps=9: unknown key, got 'wind.spede_mps' (did "
                               "you mean 'speed_mps'?), allowed in [wind] speed_mps, "));
  EXPECT_TRUE(error_with(kHarbour, {"object[1].heading=9"})
                  .starts_with("setting object[1].heading=9: unknown key, got 'object.heading', "
                               "allowed in [object] heading_deg, "));
  EXPECT_EQ(error_with(kHarbour, {"sea.douglas=5"}),
            "test.toml:4: column 13: wind.speed_mps, got it besides sea.douglas in a setting "
            "sea.douglas=5, allowed one of sea.douglas, sea.beaufort, wind.speed_mps");
}

TEST(Settings, OfALongValueTheMiddleIsLeftOutAndNotWhatIsAllowed) {
  const std::string many(300'000, 'x'), path(3000, 'x');
  const auto is_short = [](const std::string& error, const std::string& start,
                           const std::string& allowed) {
    EXPECT_TRUE(error.starts_with(start)) << error;
    EXPECT_TRUE(error.ends_with(allowed)) << error;
    EXPECT_NE(error.find("..."), std::string::npos) << error;
    EXPECT_LE(error.size(), 600u);
  };
  is_short(error_with(kHarbour, {"wind.speed_mps=" + many}), "setting wind.speed_mps=xxx",
           ", allowed 0 to 60 m/s");
  is_short(error_with(kHarbour, {"wind.speed_mps=[\"" + many + "\"]"}),
           "setting wind.speed_mps=[\"xxx", "got an array of 1 values, allowed 0 to 60 m/s");
  is_short(error_with(kHarbour, {"object[1].file=" + many}), "setting object[1].file=xxx",
           ", allowed a readable mesh file");
  is_short(error_with(kHarbour, {"terrain.height_image=" + path}),
           "setting terrain.height_image=xxx", ", allowed a readable picture file");
  is_short(error_with(kHarbour, {"object[1].name=\"" + many}), "setting object[1].name=\"xxx",
           ", allowed text of at most 200 bytes");
  is_short(error_with(kHarbour, {many + ".x=1"}), "setting xxx", ", [[clouds.cumulus]]");
  is_short(error_with(kHarbour, {many}), "setting xxx", ", allowed KEY=VALUE");
  is_short(error_with("name = \"" + many + "\"", {}), "test.toml:1: column 8: name, got \"xxx",
           ", allowed text of at most 200 bytes");
  // Characters stay whole.
  for (std::size_t most = 9; most < 20; ++most) {
    const std::string text =
        shortened("\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4", most);
    EXPECT_LE(text.size(), most);
    EXPECT_EQ(text.find("..."), text.rfind("..."));
    EXPECT_EQ((text.size() - 3) % 2, 0u) << text;
  }
  EXPECT_EQ(shortened("as it is", 8), "as it is");
}

TEST(Settings, WhatIsNoSettingIsRefused) {
  for (const char* bad : {"",
                          "=",
                          "=1",
                          "wind",
                          "wind.=3",
                          ".wind=3",
                          "wind..speed_mps=3",
                          "object[].name=a",
                          "object[x].name=a",
                          "object[-1].name=a",
                          "object[9].name=a",
                          "object[99999999].name=a",
                          "object[0=a",
                          "object]0[=a",
                          "wind[0]=1",
                          "wind.speed_mps.x=1",
                          "wind.speed_mps=\xff",
                          "object=1",
                          "object.name=a",
                          "wind.speed_mps=1\nx=2",
                          "camera.eye_m[4]=1",
                          "a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a=1",
                          "wind.speed_mps=[[[[[[[[[[[[[[[[[[[[1"}) {
    const std::string error = error_with(kHarbour, {bad});
    EXPECT_NE(error, "") << bad;
    EXPECT_EQ(error.find('\n'), std::string::npos) << bad;
  }
}

// ---- JSON

TEST(JsonScene, SaysWhatTheSameTomlSays) {
  const Scene scene = parse_scene(R"({
    "camera": {"eye_m": [0, -50, 4.0]},
    "wind": {"speed_mps": 8.0},
    "object": [{"kind": "boat"}, {"kind": "buoy", "position_m": [5, 6]}]
  })",
                                  "test.json");
  EXPECT_EQ(differences(scene, parse_scene(kHarbour, "test.toml")), "");
}

TEST(JsonScene, DottedKeysAreTablesInEachOther) {
  const Scene scene = parse_scene(
      R"({"wind.speed_mps": 8, "camera": {"eye_m": [0, -50, 4]}, "camera.pitch_deg": 1,
          "terrain.coast_m": [[-100, 0], [100, 0]]})",
      "test.json");
  EXPECT_EQ(scene.sea.wind_speed_mps, 8.0);
  EXPECT_EQ(scene.camera.eye_m.y, -50.0);
  EXPECT_EQ(scene.camera.pitch_rad, radians(1.0));
  EXPECT_TRUE(scene.terrain.has_value());
}

TEST(JsonScene, IsKnownByItsFirstCharacterToo) {
  EXPECT_EQ(parse_scene(" {\"wind\": {\"speed_mps\": 3}}", "a scene", {}).sea.wind_speed_mps, 3.0);
}

TEST(JsonScene, TakesSettings) {
  const Settings settings = {"wind.speed_mps=4", "object[0].kind=rock"};
  const Scene scene = parse_scene("{\"wind\": {\"speed_mps\": 3}}", "a.json", settings);
  EXPECT_EQ(scene.sea.wind_speed_mps, 4.0);
  EXPECT_EQ(scene.objects.size(), 1u);
}

TEST(JsonScene, FaultsNameTheFileAndTheKey) {
  EXPECT_EQ(error_with(R"({"wind": {"speed_mps": 99}})", {}, "a.json"),
            "a.json: wind.speed_mps, got 99, allowed 0 to 60 m/s");
  EXPECT_EQ(error_with(R"({"wind": {"speed_mps": null}})", {}, "a.json"),
            "a.json: wind.speed_mps, got null, allowed a value");
  EXPECT_EQ(error_with("[1, 2]", {}, "a.json"),
            "a.json: syntax error, got 'array', allowed an object in JSON");
  EXPECT_TRUE(error_with("{\"wind\": }", {}, "a.json")
                  .starts_with("a.json: syntax error, got 'parse error at line 1, column 10"));
  EXPECT_TRUE(
      error_with(R"({"wind": {"sped_mps": 1}})", {}, "a.json").starts_with("a.json: unknown key"));
}

TEST(JsonScene, WhatIsNoSceneIsRefused) {
  std::vector<std::string> texts = {"",
                                    "{",
                                    "null",
                                    R"({"wind": 3})",
                                    R"({"wind": 3, "wind.speed_mps": 3})",
                                    R"({"wind\u0000": 3})",
                                    R"({"seed": 1e400})",
                                    R"({"sea": {"seed": 18446744073709551615}})",
                                    R"({"object": {"kind": "boat"}})",
                                    R"({"": {"": 1}})"};
  texts.emplace_back(R"({"a": )").append(100000, '[');
  texts.emplace_back(R"({")").append(100000, '.').append(R"(": 3})");
  for (const std::string& bad : texts) {
    const std::string error = error_with(bad, {}, "a.json");
    EXPECT_NE(error, "") << bad.substr(0, 60);
    EXPECT_EQ(error.find('\n'), std::string::npos);
  }
}

TEST(SceneFile, AQuotedKeyWithADotIsUnknown) {
  EXPECT_NE(error_of("\"terrain.checker_m\" = 5\n"), "");
  EXPECT_NE(error_of("\"wind.speed_mps\" = 5\n"), "");
}

}  // namespace
}  // namespace swell::scene
