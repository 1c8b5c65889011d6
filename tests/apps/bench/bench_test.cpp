// What swell-bench reports: the JSON that other tools rely on, and numbers that agree.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <sstream>

#include "apps/shared/cpu_name.h"
#include "apps/shared/json.h"
#include "apps/shared/program_runner.h"
#include "math/simd_target.h"
#include "render/frame/parts.h"

namespace swell::apps {
namespace {

class Bench : public testing::Test {
 protected:
  Bench() { write_text(scene_, island_scene_text()); }

  // The JSON that is alone on standard output.
  Json bench_json(const std::string& subcommand, const Arguments& more) {
    Arguments arguments = {subcommand, "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run_bench(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(Json::accept(outcome.out)) << outcome.out;
    return Json::parse(outcome.out, nullptr, false);
  }
  Json frame_json(const Arguments& more) {
    Arguments arguments = {"--scene", scene_, "--size", "160x90", "--frames", "6"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return bench_json("frame", arguments);
  }
  // One that no budget fits, made once.
  const Json& report() {
    static const Json report =
        frame_json({"--threads", "2", "--simd", plainest_, "--budget-ms", "0.001"});
    return report;
  }

  ScratchFolder folder_;
  std::string scene_ = folder_.file("island.toml");
  std::string plainest_{simd_target_name(simd_targets().front())};
};

TEST(CpuName, IsThatOfTheKernelOrOfArmsNumber) {
  const auto name = [](const std::string& text) {
    std::istringstream processors(text);
    return cpu_name(processors);
  };
  EXPECT_EQ(name("processor\t: 0\nmodel name\t: AMD EPYC 9R14\n"), "AMD EPYC 9R14");
  EXPECT_EQ(name("CPU implementer\t: 0x41\nCPU part\t: 0xd0b\n"), "Cortex-A76");
  EXPECT_EQ(name("CPU implementer\t: 0x41\nCPU part\t: 0xfff\n"), "Arm part 0xfff");
  EXPECT_EQ(name("CPU implementer\t: 0x61\nCPU part\t: 0x022\n"), "Arm part 0x022");
  EXPECT_EQ(name("flags: fpu\n"), "unknown");
}

TEST_F(Bench, TheFrameReportHasEveryKey) {
  const Json& report = this->report();
  EXPECT_EQ(report.at("scene"), "island");
  EXPECT_EQ(report.at("size"), Json::parse("[160, 90]"));
  EXPECT_EQ(report.at("frames"), 6);
  EXPECT_EQ(report.at("threads"), 2);
  EXPECT_EQ(report.at("simd"), plainest_);
  EXPECT_EQ(report.at("budget_ms"), 0.001);
  EXPECT_GT(report.at("triangles").get<int>(), 0);
  EXPECT_GT(report.at("peak_rss_mb").get<double>(), 1.0);
  EXPECT_GT(report.at("world_ms").get<double>(), 1.0);
  EXPECT_GT(report.at("first_frame_ms").get<double>(), 0.0);
  EXPECT_EQ(report.at("hash").get<std::string>().size(), 16u);
  EXPECT_EQ(report.at("cpu"), cpu_name());
  for (const char* stage : {"sea", "triangulate", "displace", "trees", "visibility", "rays",
                            "lookups", "clouds", "shade"})
    EXPECT_GE(report.at("stages_ms").at(stage).get<double>(), 0.0) << stage;
}

TEST_F(Bench, PercentilesAreInOrderAndTheBudgetIsCounted) {
  const Json& ms = report().at("frame_ms");
  EXPECT_GT(ms.at("median"), 0.0);
  EXPECT_LE(ms.at("median"), ms.at("p95"));
  EXPECT_LE(ms.at("p95"), ms.at("p99"));
  EXPECT_LE(ms.at("p99"), ms.at("max"));
  EXPECT_EQ(report().at("over_budget"), 6);
  EXPECT_EQ(frame_json({"--budget-ms", "100000"}).at("over_budget"), 0);
}

TEST_F(Bench, EveryVisiblePixelIsShadedOnceOrFilledIn) {
  const Json& report = this->report();
  EXPECT_GT(report.at("visible_pixels").get<int>(), 1000);
  EXPECT_LE(report.at("visible_pixels").get<int>(), 160 * 90);
  EXPECT_EQ(report.at("shaded_pixels").get<int>() + report.at("interpolated_pixels").get<int>(),
            report.at("visible_pixels").get<int>());
}

TEST_F(Bench, TheHashIsThatOfTheLastFrame) {
  const Json& report = this->report();
  EXPECT_EQ(report.at("hash"), frame_json({"--warmup", "0", "--threads", "1"}).at("hash"));
  const Outcome picture = run_render(
      {"--scene", scene_, "--size", "160x90", "--frames", "5-5", "--fps", "60", "--hash"});
  EXPECT_EQ(picture.out, "frame 5 xxh3 " + report.at("hash").get<std::string>() + "\n");
}

TEST_F(Bench, TheTableNamesEveryStageAndTheBudgetAndTheReportGoesIntoAFile) {
  const Outcome outcome = run_bench({"frame", "--scene", scene_, "--size", "64x36", "--frames", "2",
                                     "--json", folder_.file("report.json")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* word :
       {"sea", "triangulate", "displace", "visibility", "lookups", "shade", "frame", "budget 17 ms",
        "median", "p95", "p99", "max", "making the world", "first frame"})
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word << "\n" << outcome.out;
  const Json report = Json::parse(read_text(folder_.file("report.json")), nullptr, false);
  EXPECT_EQ(report.value("frames", 0), 2);
}

// One bar a frame and at least one a stage and frame, none outside its frame.
TEST_F(Bench, TheTraceIsAChromeTrace) {
  const std::string path = folder_.file("trace.json");
  frame_json({"--trace", path, "--threads", "2"});
  const Json trace = Json::parse(read_text(path), nullptr, false);
  ASSERT_FALSE(trace.is_discarded());
  std::map<std::string, int> count;
  double frame_start_us = 0.0, frame_end_us = 0.0;
  for (const Json& event : trace.at("traceEvents")) {
    ++count[event.at("name").get<std::string>()];
    EXPECT_EQ(event.at("ph"), "X");
    const double start_us = event.at("ts"), end_us = start_us + event.at("dur").get<double>();
    const int track = event.at("tid");
    EXPECT_TRUE((track >= 0 && track <= 2) || (track >= 1000 && track < 1009)) << track;
    if (event.at("name") == "frame") {
      EXPECT_GE(start_us, frame_end_us) << "frames overlap";
      frame_start_us = start_us, frame_end_us = end_us;
    }
    EXPECT_LE(start_us, end_us);
    EXPECT_GE(start_us, frame_start_us);
    EXPECT_LE(end_us, frame_end_us + 1.0);
  }
  EXPECT_EQ(count["frame"], 6);
  for (const char* stage : {"sea", "triangulate", "displace", "visibility", "lookups", "shade"})
    EXPECT_GE(count[stage], 6) << stage;
}

TEST_F(Bench, AGovernedRunReportsWhatGave) {
  const std::string path = folder_.file("trace.json");
  const Json hopeless =
      bench_json("frame", {"--scene", scene_, "--size", "64x36", "--frames", "50", "--warmup", "0",
                           "--govern", "--budget-ms", "0.01", "--triangles", "2000",
                           "--terrain-triangles", "2000", "--trace", path})
          .at("governed");
  EXPECT_EQ(hopeless.at("share_within"), 0.0);
  EXPECT_EQ(hopeless.at("picture_scale"), Json::parse("[0.5, 1.0]"));
  EXPECT_EQ(hopeless.at("lookup_scale").at(0), 0.25);
  EXPECT_LE(hopeless.at("largest_triangle_change").get<double>(), 0.101);
  EXPECT_LT(hopeless.at("triangles").at(0), hopeless.at("triangles").at(1));
  EXPECT_GE(hopeless.at("step_changes").get<int>(), 1);
  int counters = 0;
  const Json trace = Json::parse(read_text(path), nullptr, false);
  for (const Json& event : trace.at("traceEvents")) counters += event.at("ph") == "C";
  EXPECT_EQ(counters, 3 * 50);

  const Json easy = frame_json({"--govern", "--budget-ms", "100000"}).at("governed");
  EXPECT_EQ(easy.at("share_within"), 1.0);
  EXPECT_EQ(easy.at("largest_triangle_change"), 0.0);
  EXPECT_EQ(easy.at("picture_scale"), Json::parse("[1.0, 1.0]"));
  EXPECT_FALSE(frame_json({}).contains("governed"));
}

TEST_F(Bench, TheLodReportHasEveryKey) {
  const Json report = bench_json("lod", {"--triangles", "1500", "--frames", "30"});
  const int triangles = report.at("triangles");
  EXPECT_LE(triangles, 1500);
  EXPECT_GT(triangles, 1400);
  const double lod_ms = report.at("lod_ms");
  EXPECT_GT(lod_ms, 0.0);
  EXPECT_GE(report.at("module_ms").get<double>(), lod_ms);
  EXPECT_NEAR(report.at("ns_per_leaf").get<double>(), lod_ms * 1e6 / triangles, 0.1);
  EXPECT_GT(report.at("splits").get<int>(), 0);
  EXPECT_GT(report.at("merges").get<int>(), 0);
  EXPECT_EQ(report.at("rows").size(), 1u);
  EXPECT_EQ(report.at("rows")[0].at("triangles"), triangles);
}

// Four sizes, then the same work with a camera that stands still: nothing is split or merged.
TEST_F(Bench, TheLodReportWithoutASizeIsATable) {
  const Json rows = bench_json("lod", {"--frames", "3"}).at("rows");
  ASSERT_EQ(rows.size(), 5u);
  for (std::size_t i = 1; i < 4; ++i)
    EXPECT_GT(rows[i].at("triangles").get<int>(), rows[i - 1].at("triangles").get<int>());
  EXPECT_EQ(rows[4].at("speed_mps"), 0.0);
  EXPECT_EQ(rows[4].at("splits"), 0);
  EXPECT_EQ(rows[4].at("merges"), 0);
}

TEST_F(Bench, TheQueryReportNamesTheModel) {
  const Json report = bench_json("query", {"--scene", scene_, "--points", "1000"});
  EXPECT_GT(report.at("points_per_s").get<double>(), 1e4);
  EXPECT_EQ(report.at("model"), "spectrum");
  write_text(scene_,
             "[sea]\nspectrum = false\n[[sea.sines]]\namplitude_m = 1.0\n"
             "wavelength_m = 30.0\n");
  EXPECT_EQ(bench_json("query", {"--scene", scene_, "--points", "1000"}).at("model"), "sines");
  for (const char* model : {"trains", "blend"}) {
    write_text(scene_, island_scene_text() + "[coast]\nmodel = \"" + model +
                           "\"\ngrid_spacing_m = 4\ntrains = 1\n");
    const Json coast = bench_json("query", {"--scene", scene_, "--points", "1000"});
    EXPECT_EQ(coast.at("model"), model);
    for (const char* layer : {"spectrum", "trains"})
      EXPECT_GT(coast.at("layers_per_s").at(layer).get<double>(), 1e4) << layer;
  }
}

// A sine of amplitude A has variance A^2 / 2: Hs = 4 A / sqrt(2).
TEST_F(Bench, TheSeaStateIsMeasuredOnTheSurface) {
  write_text(scene_,
             "[sea]\nspectrum = false\n[[sea.sines]]\namplitude_m = 1.0\n"
             "wavelength_m = 30.0\n");
  const Json report = bench_json("sea-state", {"--scene", scene_});
  EXPECT_NEAR(report.at("significant_height_m").get<double>(), 2.828427, 0.02);
  EXPECT_EQ(report.at("wmo_code"), 5);
  EXPECT_EQ(report.at("wmo_name"), "rough");
  EXPECT_FALSE(report.contains("code"));
}

TEST_F(Bench, SeaStateScenesAreInsideTheirBands) {
  for (const int code : {0, 5, 9}) {
    const Json report =
        bench_json("sea-state",
                   {"--scene", fmt::format("{}/scenes/sea_state_{}.toml", SWELL_SOURCE_DIR, code)});
    EXPECT_EQ(report.at("inside"), true) << report;
    EXPECT_EQ(report.at("scale"), "douglas");
    EXPECT_EQ(report.at("code"), code);
    EXPECT_EQ(report.at("wmo_code"), code) << report;
  }
}

TEST_F(Bench, EveryCodeOfBothScalesIsInsideItsBandAndInTheDocs) {
  const std::string path = folder_.file("rows.json");
  const Outcome outcome = run_bench({"sea-state", "--table", "--json", path});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json rows = Json::parse(read_text(path), nullptr, false);
  ASSERT_EQ(rows.size(), 23u);
  for (int n = 0; n < 23; ++n) {
    const Json& row = rows[static_cast<std::size_t>(n)];
    EXPECT_EQ(row.at("scale"), n < 10 ? "douglas" : "beaufort");
    EXPECT_EQ(row.at("code"), n < 10 ? n : n - 10);
    EXPECT_EQ(row.at("inside"), true) << row;
  }
  const std::string docs = read_text(SWELL_SOURCE_DIR "/docs/understand/waves.md");
  EXPECT_NE(docs.find(outcome.out), std::string::npos) << outcome.out;
}

TEST_F(Bench, ASeaThatIsNotTheOneAskedForFails) {
  write_text(scene_, "[sea]\ndouglas = 5\namplitude_scale = 2.0\n");
  const Outcome outcome = run_bench({"sea-state", "--scene", scene_});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(is_one_error_line(outcome.err, {"island.toml", "rough", "2.5 to 4 m"}))
      << outcome.err;
}

// The island scene has land to mirror and to see through the water, ripples and haze.
TEST_F(Bench, PartsAreLeftOutOneAtATime) {
  const Json whole = frame_json({"--parts"});
  EXPECT_GT(whole.at("frame_ms").get<double>(), 0.0);
  std::vector<std::string> names;
  for (const auto& [name, ms] : whole.at("parts_ms").items()) names.push_back(name);
  EXPECT_EQ(names.size(), render::kPartCount);
  for (const std::string_view part : render::kPartNames)
    EXPECT_TRUE(whole.at("parts_ms").contains(std::string(part))) << part;

  const Json rest = frame_json({"--parts", "--without", "haze,ripples"});
  EXPECT_EQ(rest.at("parts_ms").size(), render::kPartCount - 2);
  EXPECT_FALSE(rest.at("parts_ms").contains("haze"));
}

TEST_F(Bench, WithoutAPartThePictureIsAnother) {
  for (const char* part : {"reflection", "refraction", "ripples", "haze"})
    EXPECT_NE(frame_json({"--without", part}).at("hash"), frame_json({}).at("hash")) << part;
  EXPECT_EQ(frame_json({"--without", "haze,ripples"}).at("hash"),
            frame_json({"--without", "ripples,haze"}).at("hash"));
  for (const char* list : {"", "hazel", "haze,", "haze ripples"})
    EXPECT_EQ(run_bench({"frame", "--scene", scene_, "--without", list}).exit_code, 2) << list;
}

}  // namespace
}  // namespace swell::apps
