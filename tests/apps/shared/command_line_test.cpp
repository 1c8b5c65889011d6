// What the programs say to good and bad command lines and scenes.
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "apps/shared/json.h"
#include "apps/shared/program_runner.h"
#include "math/simd_target.h"

namespace swell::apps {
namespace {

class CommandLine : public testing::Test {
 protected:
  CommandLine() { write_text(scene_, sea_scene_text()); }

  // Expects exit code 2, one error line with the pieces, and nothing on standard output.
  void expect_refused(const Outcome& outcome, const Arguments& pieces) {
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(is_one_error_line(outcome.err, pieces))
        << "expected pieces " << fmt::format("{}", pieces) << ", got:\n"
        << outcome.err;
  }

  ScratchFolder folder_;
  std::string scene_ = folder_.file("sea.toml");
};

TEST_F(CommandLine, HelpNamesEveryOption) {
  const Outcome outcome = run_render({"--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  for (const char* option :
       {"--scene",     "--size",       "--time",        "--frames", "--fps",       "--out",
        "--threads",   "--hash",       "--simd",        "--tile",   "--triangles", "--lookup-scale",
        "--wireframe", "--dump-scene", "--json",        "--expect", "--labels",    "--labels-out",
        "--depth",     "--ids",        "--edge-samples"})
    EXPECT_NE(outcome.out.find(option), std::string::npos) << option;
}

TEST_F(CommandLine, BenchHelpNamesEverySubcommand) {
  const Outcome outcome = run_bench({"--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* subcommand : {"frame", "lod", "peer", "query", "sea-state", "waves"})
    EXPECT_NE(outcome.out.find(subcommand), std::string::npos) << subcommand;
  const Outcome frame = run_bench({"frame", "--help"});
  EXPECT_EQ(frame.exit_code, 0);
  for (const char* option : {"--scene", "--size", "--frames", "--threads", "--simd", "--budget-ms",
                             "--json", "--trace", "--warmup"})
    EXPECT_NE(frame.out.find(option), std::string::npos) << option;
}

TEST_F(CommandLine, VersionIsOneLine) {
  EXPECT_TRUE(run_render({"--version"}).out.starts_with("swell-render 0.9.0 (commit "));
  EXPECT_TRUE(run_bench({"--version"}).out.starts_with("swell-bench 0.9.0 (commit "));
}

TEST_F(CommandLine, VersionAsJsonHasTargetsAndTheSamenessVersion) {
  const auto json = Json::parse(run_bench({"--version", "--json"}).out);
  EXPECT_EQ(json.at("program"), "swell-bench");
  EXPECT_EQ(json.at("version"), "0.9.0");
  EXPECT_FALSE(json.at("commit").get<std::string>().empty());
  EXPECT_GE(json.at("sameness"), 1);
  const auto targets = json.at("simd_targets").get<std::vector<std::string>>();
  EXPECT_EQ(std::ranges::count(targets, json.at("simd").get<std::string>()), 1);
}

// What the help lists is in the manual page and is completed.
TEST_F(CommandLine, ManualPageAndCompletionHaveAllOptions) {
  const std::string help = run_render({"--help"}).out;
  std::string page = run_render({"--man"}).out;
  for (std::size_t at = 0; (at = page.find("\\-")) != std::string::npos;) page.erase(at, 1);
  const std::string completion = run_render({"--bash-completion"}).out;
  std::istringstream words(help);
  int options = 0;
  for (std::string word; words >> word;) {
    if (!word.starts_with("--") ||
        word.find_first_not_of("-abcdefghijklmnopqrstuvwxyz") != word.npos)
      continue;
    ++options;
    EXPECT_NE(page.find(word), std::string::npos) << word;
    EXPECT_NE(completion.find(word), std::string::npos) << word;
  }
  EXPECT_GT(options, 20);
  EXPECT_EQ(page.find(".TH SWELL-RENDER 1"), 0u);
  const std::string modes = run_bench({"--man"}).out;
  EXPECT_NE(modes.find(".SS frame"), std::string::npos);
}

TEST_F(CommandLine, RenderRefusesBadOptions) {
  struct Case {
    Arguments arguments, pieces;
  };
  const std::string size = "--size", allowed = "1x1 to 8192x8192";
  const std::string plainest(simd_target_name(simd_targets().front()));
  const Case cases[] = {
      {{size, "0x0"}, {"--size", "'0x0'", allowed}},
      {{size, "99999999x1"}, {"'99999999x1'", allowed}},
      {{size, "abc"}, {"'abc'", allowed}},
      {{"--threads", "0"}, {"--threads", "'0'", "1 to 256"}},
      {{"--threads", "1", "--threads", "2"}, {"--threads, got it 2 times, allowed once"}},
      {{"--threads", "two"}, {"'two'", "1 to 256"}},
      {{"--simd", "sse4"}, {"--simd", "'sse4'", plainest}},
      {{"--time", "nan"}, {"--time", "'nan'"}},
      {{"--time", "2e12"}, {"--time"}},
      {{"--frames", "5-3"}, {"--frames", "'5-3'"}},
      {{"--frames", "0-1", "--fps", "0"}, {"--fps"}},
      {{"--frames", "0-1", "--time", "1"}, {"--time, got it with --frames, allowed one of them"}},
      {{"--fps", "3"}, {"--fps, got it without --frames, allowed with --frames"}},
      {{"--tile", "48"}, {"--tile", "'48'", "16, 32 or 64"}},
      {{"--triangles", "1"}, {"--triangles"}},
      {{"--lookup-scale", "0.01"}, {"--lookup-scale"}},
      {{"--size", "8x8", "--size", "9x9"}, {"--size"}},
      {{"--size", std::string(100'000, '9')}, {"got '999", "999...999", allowed}},
      {{"--colour"}, {"unknown option, got '--colour', allowed --help, "}},
      {{"--thread", "2"}, {"unknown option, got '--thread' (did you mean '--threads'?), allowed "}},
      {{"--hsah"}, {"(did you mean '--hash'?), allowed "}},
      {{"--edge-sample=4"}, {"got '--edge-sample=4' (did you mean '--edge-samples'?), allowed "}},
      {{"stray"}, {"unknown argument, got 'stray', allowed --help"}},
      {{"--size"}, {"--size, got too few values, allowed --size WxH"}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(fmt::format("{}", c.arguments));
    Arguments arguments = {"--scene", scene_, "--hash"};
    arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
    Arguments pieces = c.pieces;
    pieces.insert(pieces.end(), {"error: command line: ", ", allowed "});
    expect_refused(run_render(arguments), pieces);
  }
}

TEST_F(CommandLine, RenderNeedsASceneAndSomethingToDo) {
  expect_refused(run_render({}), {"command line: --scene, got none, allowed --scene FILE"});
  expect_refused(run_render({"--hash"}), {"command line: --scene, got none, allowed --scene FILE"});
  expect_refused(run_render({"--scene", scene_}),
                 {"command line", "--out", "--hash", "--json", "--expect"});
}

// Where nothing is drawn right. Under water it is.
TEST_F(CommandLine, AnEyeBelowTheGroundIsWarnedOfOnce) {
  struct Case {
    std::string camera, warning;  // the pieces of one line; empty: none
  };
  const std::string flat = "[sea]\nspectrum = false\n[sky]\nmodel = \"gradient\"\n";
  const std::string island = flat + "[terrain]\nisland_height_m = 35.0\n";
  const std::string dive = "[camera]\neye_m = [0, 0, 1.05]\nvelocity_mps = [0, 0, -6.0]\n";
  const auto eye = [](const std::string& place) { return "[camera]\neye_m = " + place + "\n"; };
  const Case cases[] = {
      {flat + eye("[0, 0, 0.01]"), ""},
      {flat + eye("[0, 0, -0.01]"), ""},
      {flat + dive, ""},
      {island + eye("[0, 0, 2.0]"), "frame 0: the camera is inside the ground"},
      {island + eye("[5000, 0, 2.0]"), ""},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.camera);
    write_text(scene_, c.camera);
    const Arguments small = {"--scene", scene_, "--size", "16x9", "--triangles", "200"};
    const auto run = [&](auto program, Arguments arguments) {
      arguments.insert(arguments.end(), small.begin(), small.end());
      const Outcome outcome = program(arguments, Surroundings{});
      EXPECT_EQ(outcome.exit_code, 0);
      EXPECT_EQ(std::ranges::count(outcome.err, '\n'), c.warning.empty() ? 0 : 1) << outcome.err;
      EXPECT_TRUE(c.warning.empty() || outcome.err.starts_with("warning: ")) << outcome.err;
      EXPECT_NE(outcome.err.find(c.warning), std::string::npos) << outcome.err;
    };
    run(run_render, {"--frames", "0-12", "--fps", "60", "--hash"});
    if (c.warning.empty())
      run(run_bench, {"frame", "--frames", "13", "--warmup", "0", "--json", "-"});
  }
}

// scripts/contact_sheets.sh reads from it how high to lift the eye.
TEST_F(CommandLine, TheWarningSaysHowHighTheGroundIs) {
  write_text(
      scene_,
      "[sea]\nspectrum = false\n[sky]\nmodel = \"gradient\"\n[terrain]\nisland_height_m = 35.0\n");
  const auto said_from = [&](double eye_m) {
    return run_render({"--scene", scene_, "--size", "16x9", "--triangles", "200", "--hash", "--set",
                       fmt::format("camera.eye_m=[0, 0, {}]", eye_m)})
        .err;
  };
  const std::string said = said_from(0.3), before = "the ground is at ";
  const std::size_t at = said.find(before);
  ASSERT_NE(at, std::string::npos) << said;
  const double ground_m = std::stod(said.substr(at + before.size()));
  EXPECT_GT(ground_m, 0.3);
  EXPECT_EQ(said_from(ground_m + 0.3), "");
}

// They used to be left out without a word.
TEST_F(CommandLine, WhatExrFilesDoNotShowIsRefused) {
  const auto render = [&](const std::string& file, const Arguments& more) {
    Arguments arguments = {"--scene", scene_,  "--size",          "32x18",
                           "--hash",  "--out", folder_.file(file)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_render(arguments);
  };
  for (const char* file : {"a.exr", "a.EXR", "a_%04d.exr"}) {
    expect_refused(render(file, {"--picture-scale", "0.5"}), {"--picture-scale", file, "--out"});
    expect_refused(render(file, {"--wireframe"}), {"--wireframe", file, "--out"});
  }
  EXPECT_EQ(render("a.exr", {"--picture-scale", "1"}).exit_code, 0);
  const Outcome full = render("a.png", {}), small = render("a.png", {"--picture-scale", "0.5"});
  EXPECT_EQ(small.exit_code, 0);
  EXPECT_NE(small.out, full.out);
}

// And not that something is missing, which it may be because of it.
TEST_F(CommandLine, WhatIsUnknownIsNamed) {
  struct Case {
    Arguments arguments, pieces;
  };
  const Case render[] = {
      {{"--bogus"}, {"unknown option", "'--bogus'", "--scene"}},
      {{"--bogus", "3"}, {"unknown option", "'--bogus'"}},
      {{"--bogus=3"}, {"unknown option", "'--bogus"}},
      {{"-x"}, {"unknown option", "'-x'"}},
      {{"--scen", scene_, "--hash"}, {"unknown option", "'--scen'", "--scene,"}},
      {{"--scene", scene_, "--sise", "3x3"}, {"unknown option", "'--sise'", "--size"}},
      {{"--scene", scene_, "--fps", "3", "--bogus"}, {"unknown option", "'--bogus'"}},
      {{"bogus"}, {"unknown argument", "'bogus'"}},
      {{"--hash", "bogus", "more"}, {"unknown argument", "'bogus'"}},
      {{"--scene"}, {"--scene, got too few values, allowed --scene FILE"}},
      {{"--hash"}, {"--scene, got none, allowed --scene FILE"}},
  };
  for (const Case& c : render) {
    SCOPED_TRACE(fmt::format("{}", c.arguments));
    expect_refused(run_render(c.arguments), c.pieces);
  }
  const Case bench[] = {
      {{"bogus"},
       {"unknown mode", "'bogus'",
        "frame, lidar, lod, optics, papers, peer, query, scaling, sea-state, shading, terrain, "
        "waves"}},
      {{"frme", "--scene", scene_}, {"unknown mode, got 'frme' (did you mean 'frame'?), "}},
      {{"--bogus", "frame"}, {"unknown option", "'--bogus'"}},
      {{"--scene", scene_, "frame"}, {"unknown option", "'--scene'", "after"}},
      {{"frame", "lod"}, {"unknown argument", "'lod'"}},
      {{"frame", "--scene"}, {"--scene, got too few values, allowed --scene FILE"}},
      {{}, {"no mode"}},
  };
  for (const Case& c : bench) {
    SCOPED_TRACE(fmt::format("{}", c.arguments));
    expect_refused(run_bench(c.arguments), c.pieces);
  }
  for (const char* mode : {"frame", "lod", "peer", "query", "sea-state", "waves"}) {
    SCOPED_TRACE(mode);
    expect_refused(run_bench({mode, "--bogus"}), {"unknown option", "'--bogus'", "--help"});
    expect_refused(run_bench({mode, "--bogus", "1"}), {"unknown option", "'--bogus'"});
    expect_refused(run_bench({mode, "bogus"}), {"unknown argument", "'bogus'"});
  }
}

TEST_F(CommandLine, BenchRefusesBadOptions) {
  const std::vector<Arguments> cases = {
      {},
      {"optical"},
      {"frame"},
      {"frame", "--scene", scene_, "--frames", "0"},
      {"frame", "--scene", scene_, "--budget-ms", "inf"},
      {"frame", "--scene", scene_, "--warmup", "-1"},
      {"frame", "--scene", scene_, "--size", "0x9"},
      {"lod", "--triangles", "1"},
      {"query"},
      {"query", "--scene", scene_, "--points", "0"},
      {"sea-state"},
      {"sea-state", "--scene", scene_, "--table"},
      {"waves", "--scene", scene_},
      {"waves", "--scene", scene_, "--section", "-", "--from", "1"},
      {"waves", "--scene", scene_, "--section", "-", "--from", "nan", "1"},
      {"waves", "--scene", scene_, "--section", "-", "--from", "1", "2", "--to", "1", "2"},
  };
  for (const Arguments& arguments : cases) {
    SCOPED_TRACE(fmt::format("{}", arguments));
    expect_refused(run_bench(arguments), {"error: command line: ", ", allowed "});
  }
}

TEST_F(CommandLine, AMissingSceneIsNamed) {
  const std::string missing = folder_.file("no such scene.toml");
  expect_refused(run_render({"--scene", missing, "--hash"}), {missing});
  expect_refused(run_bench({"frame", "--scene", missing}), {missing});
  expect_refused(run_bench({"query", "--scene", missing}), {missing});
  expect_refused(run_render({"--scene", folder_.path().string(), "--hash"}),
                 {folder_.path().string()});
}

TEST_F(CommandLine, LineBreaksInNamesDoNotBreakTheErrorLine) {
  expect_refused(run_render({"--scene", folder_.file("two\nlines.toml"), "--hash"}), {"two lines"});
  expect_refused(run_render({"--scene", scene_, "--hash", "--size", "1\n2"}), {"--size"});
}

TEST_F(CommandLine, BadScenesAreNamedWithTheLine) {
  struct Case {
    std::string text;
    Arguments pieces;
  };
  const Case cases[] = {
      {"[wind]\nspeed_mps = 1000.0\n", {":2:", "speed_mps", "1000"}},
      {"[wind]\n\nspeed_mps = \"fast\"\n", {":3:", "speed_mps"}},
      {"[wind]\nspeed = 5.0\n", {":2:", "speed", "speed_mps"}},
      {"[wind\n", {":1:"}},
      {"[camera]\nfov_y_deg = nan\n", {":2:", "fov_y_deg", "nan"}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    const std::string path = folder_.file("bad.toml");
    write_text(path, c.text);
    Arguments pieces = c.pieces;
    pieces.push_back("error: " + path);
    expect_refused(run_render({"--scene", path, "--hash"}), pieces);
  }
}

// A TIFF of 2 x 2 floats, little-endian, one strip.
std::string float_tiff(const std::array<float, 4>& pixels) {
  std::string bytes("II*\0\x18\0\0\0", 8);  // the directory comes after the pixels
  bytes.append(reinterpret_cast<const char*>(pixels.data()), sizeof(pixels));
  struct Entry {
    std::uint16_t tag, type;  // 3: 16 bits, 4: 32 bits
    std::uint32_t count, value;
  };
  constexpr Entry kEntries[] = {{256, 4, 1, 2},  {257, 4, 1, 2}, {258, 3, 1, 32}, {259, 3, 1, 1},
                                {262, 3, 1, 1},  {273, 4, 1, 8}, {277, 3, 1, 1},  {278, 4, 1, 2},
                                {279, 4, 1, 16}, {339, 3, 1, 3}};
  const std::uint16_t count = std::size(kEntries);
  bytes.append(reinterpret_cast<const char*>(&count), 2);
  bytes.append(reinterpret_cast<const char*>(kEntries), sizeof(kEntries));
  return bytes + std::string(4, '\0');
}

TEST_F(CommandLine, BadFloorsAreNamed) {
  const std::string nan_tiff = folder_.file("nan.tif"), low_tiff = folder_.file("low.tif");
  write_text(nan_tiff, float_tiff({0.1f, std::nanf(""), 0.3f, 0.4f}));
  write_text(low_tiff, float_tiff({0.1f, 0.2f, 0.3f, -0.5f}));
  const std::string path = folder_.file("floor.toml"), line3 = "error: " + path + ":3:";
  const std::string coast = "[terrain]\n\ncoast_m = ", spacing = "[coast]\n\ngrid_spacing_m = ";
  struct Case {
    std::string text;
    Arguments pieces;
  };
  const Case cases[] = {
      {"[terrain]\nheight_image = \"nan.tif\"\n", {"error: " + nan_tiff, "pixel (1, 0)", "nan"}},
      {"[terrain]\nheight_image = \"low.tif\"\n", {"error: " + low_tiff, "pixel (1, 1)", "-0.5"}},
      {"[terrain]\n\nmetres_per_pixel = -2.0\n", {line3, "metres_per_pixel", "-2"}},
      {coast + "[[0, 0]]\n", {line3, "terrain.coast_m", "2 to 200 points"}},
      {coast + "[[3, 3], [3, 3], [3, 3]]\n", {line3, "terrain.coast_m[1]", "[3, 3]"}},
      {spacing + "0.1\n", {line3, "coast.grid_spacing_m", "0.1", "0.5 to 100 m"}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    write_text(path, c.text);
    expect_refused(run_render({"--scene", path, "--size", "8x8", "--hash"}), c.pieces);
  }
}

TEST_F(CommandLine, TheEffectiveSceneCanBeDumpedAndDrawsTheSamePicture) {
  const Outcome dump = run_render({"--scene", scene_, "--dump-scene"});
  ASSERT_EQ(dump.exit_code, 0) << dump.err;
  EXPECT_NE(dump.out.find("near_m"), std::string::npos) << "a default value is missing";
  const std::string copy = folder_.file("copy.toml");
  write_text(copy, dump.out);
  const Outcome original = run_render({"--scene", scene_, "--size", "64x36", "--hash"});
  EXPECT_EQ(original.exit_code, 0) << original.err;
  EXPECT_EQ(run_render({"--scene", copy, "--size", "64x36", "--hash"}).out, original.out);
}

}  // namespace
}  // namespace swell::apps
