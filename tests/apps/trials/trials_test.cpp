// What a change needs that adds one more of something: patches of few files, and a program that was
// built with all of them (build_trials.cmake), whose pictures and labels show each.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/shared/program_runner.h"
#include "texture/image/image_io.h"

namespace swell::apps {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth_px = 160, kHeight_px = 90;
constexpr double kT_s = 3.0;

const std::string kWithTrials = SWELL_TRIALS_RENDER;

std::string scene(const std::string& name) {
  return std::string(SWELL_SOURCE_DIR) + "/" + name + ".toml";
}

// A calm sea under an even sky, seen from a height, pitched so far.
std::string sea_text(double eye_m, double pitch_deg) {
  std::ostringstream text;
  text << "[camera]\neye_m = [0.0, 0.0, " << eye_m
       << "]\nheading_deg = 90.0\npitch_deg = " << pitch_deg
       << "\nfov_y_deg = 40.0\n[sky]\nsun_elevation_deg = 40.0\ncloud_cover = 0.0\n"
       << "[wind]\nspeed_mps = 0.0\n";
  return text.str();
}

struct Files {
  explicit Files(const std::string& text) { write_text(folder.file("scene.toml"), text); }

  // What a program draws at kT_s; it is to end with this code.
  Outcome draw(const std::string& program, const Arguments& more = {}, int code = 0) {
    Arguments arguments = {
        "--scene", folder.file("scene.toml"), "--time", "3", "--size", "160x90", "--simd", "avx2",
        "--out",   folder.file("picture.png")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    Outcome outcome = run_program(program, arguments);
    EXPECT_EQ(outcome.exit_code, code) << program << ": " << outcome.err;
    return outcome;
  }

  ScratchFolder folder;
};

using Rgb = std::array<float, 3>;  // sRGB, [0, 1]

class Picture {
 public:
  Picture(const std::string& program, const std::string& text, const Arguments& more = {}) {
    Files files(text);
    if (files.draw(program, more).exit_code == 0)
      image_ = texture::read_image(files.folder.file("picture.png"));
  }
  Rgb at(int x_px, int y_px) const {
    const std::size_t i = 3 * (static_cast<std::size_t>(y_px) * kWidth_px + x_px);
    return {image_.pixels.at(i), image_.pixels.at(i + 1), image_.pixels.at(i + 2)};
  }
  Rgb mean() const {
    Rgb sum{};
    for (int y = 0; y < kHeight_px; ++y)
      for (int x = 0; x < kWidth_px; ++x)
        for (std::size_t c = 0; c < 3; ++c) sum[c] += at(x, y)[c];
    for (float& channel : sum) channel /= static_cast<float>(kWidth_px * kHeight_px);
    return sum;
  }

 private:
  texture::ImageF image_;
};

// The labels of a picture, by the names of their channels.
class LabelChannels {
 public:
  LabelChannels(const std::string& program, const std::string& text, const std::string& labels) {
    Files files(text);
    const std::string file = files.folder.file("labels.exr");
    if (files.draw(program, {"--labels", labels, "--labels-out", file}).exit_code != 0) return;
    const auto input = OIIO::ImageInput::open(file);
    if (!input) throw std::runtime_error(OIIO::geterror());
    for (int c = 0; c < input->spec().nchannels; ++c) {
      std::vector<float>& values = channels_[input->spec().channel_name(c)];
      values.resize(std::size_t{kWidth_px} * kHeight_px);
      if (!input->read_image(0, 0, c, c + 1, OIIO::TypeDesc::FLOAT, values.data()))
        throw std::runtime_error(input->geterror());
      // Whole numbers come as parts of the largest.
      if (input->spec().channelformat(c) == OIIO::TypeDesc::UINT32)
        for (float& value : values) value = std::round(value * 4294967295.0f);
    }
  }
  float at(const std::string& name, int x_px, int y_px) const {
    return channels_.at(name).at(static_cast<std::size_t>(y_px) * kWidth_px + x_px);
  }

 private:
  std::map<std::string, std::vector<float>> channels_;
};

TEST(Trials, EachIsThreeFilesAndAList) {
  int patches = 0;
  for (const auto& entry : fs::directory_iterator(SWELL_SOURCE_DIR "/tests/apps/trials")) {
    if (entry.path().extension() != ".patch") continue;
    ++patches;
    std::istringstream lines(read_text(entry.path()));
    std::string line;
    std::vector<int> more;  // lines that each file has more than before
    while (std::getline(lines, line)) {
      if (line.starts_with("+++ "))
        more.push_back(0);
      else if (line.starts_with("+"))
        ++more.back();
      else if (line.starts_with("-") && !line.starts_with("--- "))
        --more.back();
    }
    EXPECT_LE(more.size(), 4u) << entry.path();
    if (more.size() == 4) {
      EXPECT_LE(*std::ranges::min_element(more), 2) << entry.path();
    }
  }
  EXPECT_EQ(patches, 7);
}

// The hills from 600 m above: their tops are over 100 m high.
TEST(Trials, ACoverWhitensTheHills) {
  std::string text = read_text(scene("tests/scenes/hills"));
  text.replace(text.find("\"hills.png\""), 11, "\"" SWELL_SOURCE_DIR "/tests/scenes/hills.png\"");
  const Arguments from_above = {"--set", "camera.eye_m=[0,0,900]", "--set", "camera.pitch_deg=-89"};
  const Rgb green = Picture(render_program(), text, from_above).mean();
  const Rgb white = Picture(kWithTrials, text, from_above).mean();
  EXPECT_GT(white[2], green[2] + 0.2f);
  EXPECT_GT(white[2] / white[1], green[2] / green[1] + 0.1f);
}

// From inside the smoke no horizon is left; straight up there are 4 m of it.
TEST(Trials, AMediumHidesSeaAndSky) {
  const std::string level = sea_text(2.0, 0.0);
  const Picture clear(render_program(), level), smoky(kWithTrials, level);
  const auto step = [](const Picture& picture) {
    const Rgb above = picture.at(80, kHeight_px / 2 - 1), below = picture.at(80, kHeight_px / 2);
    return std::abs(above[2] - below[2]);
  };
  EXPECT_LT(step(smoky), 0.01f);
  const Rgb near = smoky.at(80, kHeight_px - 1), far = smoky.at(80, kHeight_px / 2);
  EXPECT_GT(std::abs(near[2] - far[2]), 0.1f);
  const std::string up = sea_text(2.0, 89.0);
  const Rgb sky = Picture(render_program(), up).at(80, 45),
            dimmed = Picture(kWithTrials, up).at(80, 45);
  EXPECT_NE(sky, dimmed);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(sky[c], dimmed[c], 0.06f);
}

TEST(Trials, AWaveSourceLiftsTheSea) {
  const LabelChannels swell(kWithTrials, sea_text(30.0, -20.0), "position,elevation");
  const double waves_per_s = std::sqrt(9.81 / (2.0 * std::numbers::pi * 120.0));
  double highest_m = 0.0;
  for (int y_px = 30; y_px < kHeight_px; y_px += 3)
    for (int x_px = 0; x_px < kWidth_px; x_px += 7) {
      const double x_m = static_cast<double>(swell.at("P.X", x_px, y_px));
      const double turns = x_m / 120.0 - waves_per_s * kT_s;
      const double height_m = 0.4 * std::sin(2.0 * std::numbers::pi * turns);
      if (std::abs(x_m) < 12.0) continue;  // the floe of another trial
      EXPECT_NEAR(static_cast<double>(swell.at("elevation", x_px, y_px)), height_m, 0.03) << x_m;
      highest_m = std::max(highest_m, height_m);
    }
  EXPECT_GT(highest_m, 0.3);
}

TEST(Trials, ALabelIsInFilesByItsRow) {
  const LabelChannels labels(kWithTrials, sea_text(10.0, -5.0), "depth,nearness");
  for (int y_px = 0; y_px < kHeight_px; y_px += 5) {
    const float depth_m = labels.at("Z", 80, y_px), nearness = labels.at("nearness", 80, y_px);
    EXPECT_FLOAT_EQ(nearness, 1.0f / depth_m) << y_px;
  }
  EXPECT_EQ(labels.at("nearness", 80, 0), 0.0f);
  EXPECT_GT(labels.at("nearness", 80, kHeight_px - 1), 0.01f);
}

TEST(Trials, AKindOfObjectIsInSceneFiles) {
  const std::string text = sea_text(3.0, -10.0) +
                           "[[object]]\nkind = \"fender\"\nposition_m = [14.0, 0.0]\n"
                           "size_m = [3.0, 3.0, 4.0]\n";
  Files(text).draw(render_program(), {}, 2);
  const LabelChannels labels(kWithTrials, text, "id");
  EXPECT_EQ(labels.at("id", 80, 45), 16.0f);
}

TEST(Trials, APartCanBeLeftOut) {
  const std::string text = sea_text(40.0, -60.0);
  Files(text).draw(render_program(), {"--without", "body"}, 2);
  const Rgb sea = Picture(kWithTrials, text).at(80, 10);
  const Rgb black = Picture(kWithTrials, text, {"--without", "body"}).at(80, 10);
  EXPECT_LT(black[2], sea[2] - 0.05f);
}

// The floe lies half a metre over the origin, above the smoke's thick part.
TEST(Trials, ASurfaceHasTrianglesAndAMaterialOfItsOwn) {
  const std::string text = sea_text(30.0, -89.0);
  const LabelChannels labels(kWithTrials, text, "position");
  EXPECT_NEAR(labels.at("P.Z", 80, 45), 0.5f, 1e-3f);
  const Picture with(kWithTrials, text), without(render_program(), text);
  const Rgb ice = with.at(80, 45), water = without.at(80, 45);
  EXPECT_GT(ice[0], 0.7f);
  EXPECT_LT(water[0], 0.4f);
  // Mirrored in the sea before it.
  const std::string low = sea_text(1.5, -3.0);
  const auto mirrored = [&](const std::string& program, const Arguments& more) {
    Arguments arguments = {"--set", "camera.eye_m=[-60,0,1.5]"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Picture(program, low, arguments).at(80, 42);
  };
  EXPECT_EQ(mirrored(render_program(), {}),
            mirrored(render_program(), {"--without", "reflection"}));
  EXPECT_NE(mirrored(kWithTrials, {}), mirrored(kWithTrials, {"--without", "reflection"}));
}

}  // namespace
}  // namespace swell::apps
