// Swell's pictures against those of another renderer: OpenGL on llvmpipe draws the same scenes.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "apps/shared/program_runner.h"

namespace swell::apps {
namespace {

using Json = nlohmann::json;

Arguments scene_arguments(const std::string& scene) {
  return {"peer",      "--scene", SWELL_SOURCE_DIR "/scenes/" + scene + ".toml",
          "--size",    "320x180", "--frames",
          "1",         "--time",  "4",
          "--threads", "2",       "--warmup",
          "2",         "--json",  "-"};
}

bool cannot_start(const Outcome& outcome) {
  return outcome.exit_code == 1 &&
         (outcome.err.find("OpenGL does not start") != std::string::npos ||
          outcome.err.find("built without") != std::string::npos);
}

class PeerPicture : public testing::TestWithParam<const char*> {};

TEST_P(PeerPicture, DiffersByLittle) {
  const Outcome outcome = run_bench(scene_arguments(GetParam()));
  if (cannot_start(outcome)) GTEST_SKIP() << outcome.err;
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json report = Json::parse(outcome.out, nullptr, false);
  ASSERT_TRUE(report.is_object()) << outcome.out;
  EXPECT_LE(report.at("mean_difference").get<double>(), 2.0);
  // Two renderers do not agree on every bit: no difference would mean that one was drawn twice.
  EXPECT_GT(report.at("mean_difference").get<double>(), 0.1);
  EXPECT_LE(report.at("p99_difference").get<int>(), 20);
  EXPECT_GE(report.at("psnr_db").get<double>(), 33.0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, PeerPicture,
                         testing::Values("open_ocean", "lagoon", "beach", "buoys"),
                         [](const auto& scene) { return std::string(scene.param); });

class PeerProgram : public testing::Test {
 protected:
  PeerProgram() { write_text(scene_, island_scene_text()); }

  // Runs `swell-bench peer` on a small picture, with more arguments.
  Outcome run(const Arguments& more) {
    Arguments arguments = {"peer", "--scene", scene_, "--size", "64x36"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_bench(arguments);
  }

  ScratchFolder folder_;
  std::string scene_ = folder_.file("island.toml");
};

TEST_F(PeerProgram, ReportsBothAndWritesThePictures) {
  const std::string ours = folder_.file("a.png"), theirs = folder_.file("b.png"),
                    difference = folder_.file("c.png");
  const Outcome outcome = run({"--frames", "2", "--json", "-", "--picture", ours, "--peer-picture",
                               theirs, "--difference-picture", difference});
  if (cannot_start(outcome)) GTEST_SKIP() << outcome.err;
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json report = Json::parse(outcome.out, nullptr, false);
  EXPECT_EQ(report.at("scene"), "island");
  EXPECT_EQ(report.at("size"), Json::parse("[64, 36]"));
  EXPECT_EQ(report.at("frames"), 2);
  const double swell_ms = report.at("swell_ms"), peer_ms = report.at("peer_ms");
  EXPECT_GT(swell_ms, 0.0);
  EXPECT_NEAR(report.at("ratio").get<double>(), peer_ms / swell_ms, 0.01 * peer_ms / swell_ms);
  for (const char* stage : {"sea", "triangulate", "displace", "visibility", "lookups", "shade"})
    EXPECT_GE(report.at("swell_stages_ms").at(stage).get<double>(), 0.0) << stage;
  for (const char* pass : {"reflection", "refraction", "visible", "land", "water", "sky"})
    EXPECT_GE(report.at("peer_passes_ms").at(pass).get<double>(), 0.0) << pass;
  EXPECT_GT(report.at("peer_take_ms").get<double>(), 0.0);
  EXPECT_GT(report.at("peer_read_ms").get<double>(), 0.0);
  EXPECT_GE(report.at("max_difference"), report.at("p99_difference"));
  EXPECT_NE(report.at("renderer").get<std::string>().find("llvmpipe"), std::string::npos);
  EXPECT_NE(report.at("version").get<std::string>().find("Mesa"), std::string::npos);
  for (const std::string& path : {ours, theirs, difference})
    EXPECT_EQ(read_text(path).substr(1, 3), "PNG") << path;
  EXPECT_NE(read_text(ours), read_text(theirs));
}

TEST_F(PeerProgram, TheTableNamesEveryPass) {
  const Outcome outcome = run({"--frames", "1"});
  if (cannot_start(outcome)) GTEST_SKIP() << outcome.err;
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* word :
       {"llvmpipe", "shade", "refraction", "visible", "water", "sky", "ratio", "read back", "PSNR"})
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word << "\n" << outcome.out;
}

TEST_F(PeerProgram, SaysWhatToInstallWhereOpenGlDoesNotStart) {
  const Outcome outcome =
      run_bench({"peer", "--scene", scene_, "--frames", "1"},
                {.environment = {"__EGL_VENDOR_LIBRARY_FILENAMES=" + folder_.file("none.json")}});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(cannot_start(outcome)) << outcome.err;
  EXPECT_TRUE(is_one_error_line(outcome.err, {"libgl1-mesa-dri"})) << outcome.err;
}

TEST_F(PeerProgram, RefusesWhatItDoesNotTake) {
  const auto refuses = [&](const Arguments& more, const Arguments& pieces) {
    const Outcome outcome = run(more);
    EXPECT_EQ(outcome.exit_code, 2) << more[0];
    EXPECT_TRUE(is_one_error_line(outcome.err, pieces)) << outcome.err;
  };
  refuses({"--frames", "0"}, {"--frames", "'0'"});
  refuses({"--warmup", "1"}, {"--warmup", "'1'"});
  refuses({"--time", "soon"}, {"--time", "'soon'"});
  refuses({"--picture", folder_.file("a.gif")}, {".gif", ".png"});
  refuses({"--picture", folder_.file("a.exr")}, {"a.exr", "8 bits"});
  refuses({"--peer-picture", folder_.file("none/a.png")}, {"none"});
  refuses({"--edge-samples", "4"}, {"--edge-samples"});
}

}  // namespace
}  // namespace swell::apps
