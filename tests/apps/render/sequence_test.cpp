// Sequences: which frames are drawn, streams for encoders of films, what files say of themselves,
// settings.
#include <OpenImageIO/imageio.h>
#include <fmt/core.h>
#include <gtest/gtest.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "apps/render/picture_stream.h"
#include "apps/shared/program_runner.h"
#include "apps/shared/progress.h"

namespace swell::apps {
namespace {

namespace fs = std::filesystem;

class Sequence : public testing::Test {
 protected:
  Sequence() { write_text(scene_, sea_scene_text()); }

  Outcome render(const Arguments& more, const std::string& output = {}) {
    Arguments arguments = {"--scene", scene_, "--size", "32x18"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_render(arguments, {.standard_output = output});
  }

  // What a stream of frames 0 to 2 is.
  std::string stream(const std::string& format, const std::string& fps = "30") {
    const std::string file = folder_.file("stream");
    const Outcome outcome = render({"--frames", "0-2", "--fps", fps, "--stream", format}, file);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return read_text(file);
  }

  ScratchFolder folder_;
  std::string scene_ = folder_.file("sea.toml");
};

std::string note_of(const std::string& file, const std::string& name) {
  const auto input = OIIO::ImageInput::open(file);
  return input ? std::string(input->spec().get_string_attribute(name)) : std::string();
}

TEST_F(Sequence, EveryNthFrameIsTheFrameOfTheWholeSequence) {
  const Outcome all = render({"--frames", "1-6", "--fps", "10", "--hash"});
  const Outcome some = render({"--frames", "1-6", "--fps", "10", "--hash", "--every", "4"});
  const std::size_t line = all.out.find('\n') + 1;
  EXPECT_EQ(some.out, all.out.substr(0, line) + all.out.substr(4 * line, line));
}

TEST_F(Sequence, FramesWhoseFilesAreThereAreNotDrawn) {
  const std::string labels = folder_.file("b_%d.labels.exr");
  const Arguments arguments = {
      "--frames", "0-3",   "--fps",        "10",   "--out",          folder_.file("b_%d.png"),
      "--labels", "depth", "--labels-out", labels, "--skip-existing"};
  ASSERT_EQ(render(arguments).exit_code, 0);
  const std::vector<std::string> names = folder_.names();
  const auto bytes = [&](const std::string& name) { return read_text(folder_.path() / name); };
  const std::string third = bytes("b_2.png"), sidecar = bytes("b_3.labels.json");
  fs::remove(folder_.file("b_2.png"));
  fs::remove(folder_.file("b_3.labels.json"));
  write_text(folder_.file("b_0.png"), "not drawn again");
  ASSERT_EQ(render(arguments).exit_code, 0);
  EXPECT_EQ(folder_.names(), names);
  EXPECT_EQ(bytes("b_0.png"), "not drawn again");
  EXPECT_EQ(bytes("b_2.png"), third);
  EXPECT_EQ(bytes("b_3.labels.json"), sidecar);
}

TEST_F(Sequence, PpmHasTheBytesThatAreHashed) {
  const std::string ppm = stream("ppm"), header = "P6\n32 18\n255\n";
  const std::size_t size = header.size() + 32 * 18 * 3;
  ASSERT_EQ(ppm.size(), 3 * size);
  std::string hashes;
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(ppm.substr(k * size, header.size()), header);
    hashes += fmt::format("frame {} xxh3 {:016x}\n", k,
                          XXH3_64bits(ppm.data() + k * size + header.size(), 32 * 18 * 3));
  }
  EXPECT_EQ(hashes, render({"--frames", "0-2", "--fps", "30", "--hash"}).out);
}

TEST_F(Sequence, Y4mHasAHeaderAndThePlanesOfEachFrame) {
  const std::string
      y4m = stream("y4m"),
      header = "YUV4MPEG2 W32 H18 F30:1 Ip A1:1 C444 XCOLORRANGE=LIMITED XCOLORMATRIX=BT709\n";
  const std::string ppm = stream("ppm").substr(13);
  EXPECT_EQ(y4m.substr(0, header.size()), header);
  ASSERT_EQ(y4m.size(), header.size() + 3 * (6 + 32 * 18 * 3));
  const std::string frame = y4m.substr(header.size());
  EXPECT_EQ(frame.substr(0, 6), "FRAME\n");
  const auto at = [](const std::string& text, std::size_t i) {
    return static_cast<double>(static_cast<unsigned char>(text[i]));
  };
  for (std::size_t i = 0; i < 32 * 18; ++i) {
    const double r = at(ppm, 3 * i), g = at(ppm, 3 * i + 1), b = at(ppm, 3 * i + 2);
    // ITU-R BT.709-6, 3.2 to 3.4.
    const double luma = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    EXPECT_NEAR(at(frame, 6 + i), 16.0 + luma * 219.0 / 255.0, 0.51);
    EXPECT_NEAR(at(frame, 6 + 576 + i), 128.0 + (b - luma) / 1.8556 * 224.0 / 255.0, 0.51);
    EXPECT_NEAR(at(frame, 6 + 1152 + i), 128.0 + (r - luma) / 1.5748 * 224.0 / 255.0, 0.51);
  }
}

TEST(PictureStream, ReachesTheEndsOfTheVideoLevels) {
  render::Target target;
  target.rgba = {0xff000000, 0xffffffff, 0xff0000ff, 0xff00ff00, 0xffff0000};
  std::vector<std::uint8_t> bytes;
  append_yuv(target, bytes);
  const std::vector<std::uint8_t> expected = {16,  235, 63,  173, 32,   // black, white, red,
                                              128, 128, 102, 42,  240,  // green, blue
                                              128, 128, 240, 26,  118};
  EXPECT_EQ(bytes, expected);
}

TEST(PictureStream, SaysTheRateAsAFraction) {
  EXPECT_EQ(frame_rate_text(30.0), "30:1");
  EXPECT_EQ(frame_rate_text(30000.0 / 1001.0), "30000:1001");
  EXPECT_EQ(frame_rate_text(29.97), "2997:100");
  EXPECT_EQ(frame_rate_text(12.5), "25:2");
  EXPECT_EQ(frame_rate_text(0.001), "1:1000");
}

TEST_F(Sequence, FfmpegMakesAFilmOfIt) {
  if (std::system("ffmpeg -version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no ffmpeg";
  const std::string film = folder_.file("film.mkv"), facts = folder_.file("facts");
  const std::string command = fmt::format(
      "'{}' --scene '{}' --size 64x36 --frames 0-7 --fps 25 --stream y4m | "
      "ffmpeg -v error -i - -c:v ffv1 '{}' && ffprobe -v error -count_frames -show_entries "
      "stream=nb_read_frames,width,height,r_frame_rate -of csv=p=0 '{}' >'{}'",
      render_program(), scene_, film, film, facts);
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(read_text(facts), "64,36,25/1,8\n");
}

// As docs/do/films.md has it; the codec keeps every bit.
TEST_F(Sequence, FfmpegSeesThePicturesColoursInAFilmThatSaysBt709) {
  if (std::system("ffmpeg -version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no ffmpeg";
  const std::string facts = folder_.file("facts"), rgb = folder_.file("rgb");
  const std::string command = fmt::format(
      "'{0}' --scene '{1}' --size 32x18 --frames 0-0 --fps 30 --stream y4m | ffmpeg -v error -i - "
      "-vf setparams=colorspace=bt709:color_primaries=bt709:color_trc=iec61966-2-1 -c:v ffv1 "
      "'{2}.mkv' && ffprobe -v error -show_entries stream=color_range,color_space -of csv=p=0 "
      "'{2}.mkv' >'{3}' && ffmpeg -v error -i '{2}.mkv' -f rawvideo -pix_fmt rgb24 '{2}'",
      render_program(), scene_, rgb, facts);
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(read_text(facts), "tv,bt709\n");
  const std::string ppm = stream("ppm").substr(13), seen = read_text(rgb);
  ASSERT_EQ(seen.size(), 32u * 18 * 3);
  for (std::size_t i = 0; i < seen.size(); ++i)
    EXPECT_NEAR(static_cast<unsigned char>(seen[i]), static_cast<unsigned char>(ppm[i]), 3) << i;
}

TEST_F(Sequence, FilesSayWhatTheyShow) {
  const Outcome outcome =
      render({"--frames", "5-5", "--fps", "10", "--set", "wind.speed_mps=6.5", "--without", "haze",
              "--threads", "2", "--out", folder_.file("a.png"), "--labels", "depth"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  ASSERT_EQ(render({"--time", "0.5", "--set", "wind.speed_mps=6.5", "--without", "haze",
                    "--threads", "1", "--out", folder_.file("b.png")})
                .exit_code,
            0);
  EXPECT_EQ(read_text(folder_.file("a.png")), read_text(folder_.file("b.png")));
  for (const char* name : {"a.png", "a.labels.exr"}) {
    const std::string file = folder_.file(name);
    EXPECT_EQ(note_of(file, "swell:t_s"), "0.5") << name;
    EXPECT_EQ(note_of(file, "swell:version"), "0.9.0");
    EXPECT_EQ(note_of(file, "swell:scene_xxh3").size(), 16u);
    // The order of the options is the program's.
    EXPECT_EQ(note_of(file, "swell:command"),
              "swell-render --scene sea.toml --set wind.speed_mps=6.5 --size 32x18 --without haze "
              "--time 0.5");
    const std::string again =
        fmt::format("cd '{}' && '{}' {} --hash >again", folder_.path().string(), render_program(),
                    note_of(file, "swell:command").substr(13));
    ASSERT_EQ(std::system(again.c_str()), 0);
    EXPECT_EQ(read_text(folder_.file("again")),
              fmt::format("frame 0 xxh3 {}\n", note_of(file, "swell:picture_xxh3")));
  }
}

TEST_F(Sequence, ExrCompressionsLoseNothing) {
  std::vector<float> first;
  for (const char* name : {"none", "rle", "zips", "zip", "piz"}) {
    const std::string file = folder_.file("a.exr");
    ASSERT_EQ(render({"--out", file, "--labels", "id", "--exr-compression", name}).exit_code, 0);
    const auto input = OIIO::ImageInput::open(file);
    ASSERT_TRUE(input);
    EXPECT_EQ(input->spec().get_string_attribute("compression"), name);
    std::vector<float> pixels(static_cast<std::size_t>(32 * 18 * input->spec().nchannels));
    ASSERT_TRUE(
        input->read_image(0, 0, 0, input->spec().nchannels, OIIO::TypeFloat, pixels.data()));
    if (first.empty()) first = pixels;
    EXPECT_EQ(pixels, first) << name;
  }
}

TEST_F(Sequence, ProgressShowsOnATerminalAlone) {
  const Arguments arguments = {"--frames", "0-4", "--fps", "10", "--hash"};
  EXPECT_EQ(render(arguments).err, "");
  if (std::system("script --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no script(1)";
  const auto on_terminal = [&](const char* more) {
    const std::string command = fmt::format(
        "script -qec \"'{}' --scene '{}' --size 32x18 --frames 0-4 --fps 10 --out '{}' {}\" "
        "/dev/null >'{}' </dev/null",
        render_program(), scene_, folder_.file("p_%d.png"), more, folder_.file("seen"));
    EXPECT_EQ(std::system(command.c_str()), 0);
    return read_text(folder_.file("seen"));
  };
  EXPECT_NE(on_terminal("").find("] 5 of 5 frames"), std::string::npos);
  EXPECT_EQ(on_terminal("--quiet"), "");
}

TEST(Progress, TellsWhatIsLeft) {
  EXPECT_EQ(progress_text(0, 10, 0, 0.0), "[..............................] 0 of 10 frames");
  EXPECT_EQ(progress_text(5, 10, 5, 2.0),
            "[###############...............] 5 of 10 frames, 2.5 frames/s, 0:02 left");
  EXPECT_EQ(progress_text(4, 10000, 2, 4.0),
            "[..............................] 4 of 10000 frames, 0.5 frames/s, 5:33:12 left");
}

TEST_F(Sequence, SettingsAndJsonDrawWhatTheFileWould) {
  const std::string other = folder_.file("other.toml"), json = folder_.file("scene.json");
  write_text(other, "[wind]\nspeed_mps = 6.5\n[[object]]\nkind = \"boat\"\nposition_m = [0, 20]\n");
  write_text(
      json, R"({"wind": {"speed_mps": 6.5}, "object": [{"kind": "boat", "position_m": [0, 20]}]})");
  write_text(scene_, "[wind]\nspeed_mps = 3.0\n");
  const auto hash = [&](const Arguments& arguments) {
    Arguments all = {"--size", "32x18", "--hash"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome outcome = run_render(all);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  };
  EXPECT_EQ(hash({"--scene", json}), hash({"--scene", other}));
  EXPECT_EQ(hash({"--scene", scene_, "--set", "wind.speed_mps=6.5", "--set", "object[0].kind=boat",
                  "--set", "object[0].position_m=[0, 20]"}),
            hash({"--scene", other}));
}

TEST_F(Sequence, BadOptionsAreOneLine) {
  const auto expect_refused = [&](const Arguments& arguments, const Arguments& pieces) {
    const Outcome outcome = render(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(is_one_error_line(outcome.err, pieces)) << outcome.err;
  };
  expect_refused({"--hash", "--set", "wind.sped_mps=3"},
                 {"setting wind.sped_mps=3: unknown key", "allowed in [wind] speed_mps"});
  expect_refused({"--hash", "--set", "wind"}, {"setting wind", "KEY=VALUE"});
  expect_refused({"--stream", "mp4"}, {"--stream", "'mp4'", "y4m or ppm"});
  expect_refused({"--stream", "y4m", "--hash"}, {"--stream", "--hash"});
  expect_refused({"--hash", "--skip-existing"}, {"--skip-existing"});
  expect_refused({"--hash", "--every", "2"}, {"--every", "--frames"});
  expect_refused({"--frames", "0-9", "--every", "0", "--hash"}, {"--every", "'0'"});
  expect_refused({"--out", folder_.file("a.exr"), "--exr-compression", "dwaa"},
                 {"--exr-compression", "'dwaa'", "zip"});
  const Outcome full = render({"--frames", "0-2", "--fps", "9", "--stream", "y4m"}, "/dev/full");
  EXPECT_EQ(full.exit_code, 1);
  EXPECT_TRUE(is_one_error_line(full.err, {"standard output"})) << full.err;
}

}  // namespace
}  // namespace swell::apps
