// swell-bench terrain --make-boundary: a picture of a scene's shore that draws the same scene.
#include <gtest/gtest.h>

#include "apps/shared/program_runner.h"

namespace swell::apps {
namespace {

constexpr const char* kScene = R"(
[camera]
eye_m = [0, -160, 30]
pitch_deg = -14
[wind]
speed_mps = 9
[coast]
model = "none"
[terrain]
island_radius_m = 80
floor_depth_m = 8
)";

std::string hash_of(const std::string& scene) {
  const Outcome run =
      run_program(render_program(), {"--scene", scene, "--size", "160x90", "--hash"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return run.out;
}

TEST(MakeBoundary, GivesTheSamePictureToTheBitAndAnotherWherePainted) {
  const ScratchFolder folder;
  write_text(folder.file("a.toml"), kScene);
  const Outcome made =
      run_bench({"terrain", "--make-boundary", folder.file("shore.exr"), "--bank-normals",
                 folder.file("normals.png"), "--scene", folder.file("a.toml")});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_GT(read_text(folder.file("normals.png")).size(), 10000u);
  EXPECT_NE(made.out.find("1025 x 1025 points"), std::string::npos) << made.out;
  write_text(folder.file("b.toml"), std::string(kScene) + "boundary = \"shore.exr\"\n");
  EXPECT_EQ(hash_of(folder.file("a.toml")), hash_of(folder.file("b.toml")));
  // The boundary of another island: surf runs elsewhere.
  write_text(folder.file("c.toml"), std::string(kScene) + "seed = 9\n");
  ASSERT_EQ(run_bench({"terrain", "--make-boundary", folder.file("shore.exr"), "--scene",
                       folder.file("c.toml")})
                .exit_code,
            0);
  EXPECT_NE(hash_of(folder.file("a.toml")), hash_of(folder.file("b.toml")));
}

TEST(MakeBoundary, RefusesInOneLine) {
  const ScratchFolder folder;
  const auto refused = [&](const Arguments& more, const std::vector<std::string>& pieces) {
    Arguments arguments = {"terrain", "--make-boundary"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome run = run_bench(arguments);
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_TRUE(is_one_error_line(run.err, pieces)) << run.err;
  };
  write_text(folder.file("sea.toml"), "");
  refused({folder.file("a.exr")}, {"--scene, got none"});
  refused({folder.file("a.png"), "--scene", folder.file("sea.toml")}, {"a.png", ".exr"});
  refused({folder.file("a.exr"), "--scene", folder.file("sea.toml")}, {"no terrain"});
  refused({folder.file("a.exr"), "--bank-normals", folder.file("a.exr"), "--scene",
           folder.file("sea.toml")},
          {"--bank-normals", ".png"});
  EXPECT_EQ(folder.names(), std::vector<std::string>{"sea.toml"});
  write_text(folder.file("a.toml"), "[terrain]\nboundary = \"none.exr\"\n");
  const Outcome missing =
      run_program(render_program(), {"--scene", folder.file("a.toml"), "--hash"});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_TRUE(is_one_error_line(missing.err, {"terrain.boundary", "none.exr"})) << missing.err;
}

}  // namespace
}  // namespace swell::apps
