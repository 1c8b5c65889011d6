// swell-render's files of labels: every plane that was asked for, with the bits that are drawn, and
// what stands beside them.
#include <OpenImageIO/imageio.h>
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <map>

#include "apps/shared/json.h"
#include "apps/shared/program_runner.h"
#include "math/simd_target.h"
#include "render/frame.h"
#include "render/world_view.h"

namespace swell::apps {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;
using render::Label;
constexpr int kWidth = 96, kHeight = 54;
constexpr std::size_t kPixels = kWidth * kHeight;

// The island with a buoy of a class of its own, and a raft before the camera.
std::string labelled_scene_text() {
  return island_scene_text() + R"(
[[object]]
name = "north mark"
class = "mark"
position_m = [8.0, 2.0]
[[object]]
name = "raft"
kind = "box"
size_m = [6.0, 6.0, 3.0]
position_m = [16.0, 22.0]
)";
}

// What OpenImageIO reads, by the channels' names: types and bits.
struct ReadChannel {
  OIIO::TypeDesc type;
  std::vector<std::uint32_t> bits;
  float number(std::size_t i) const { return std::bit_cast<float>(bits.at(i)); }
};
struct ReadExr {
  OIIO::ImageSpec spec;
  std::map<std::string, ReadChannel> channels;
  Names names() const {
    Names names;
    for (const auto& [name, channel] : channels) names.push_back(name);
    return names;
  }
};

std::unique_ptr<OIIO::ImageInput> open_image(const fs::path& path) {
  // On this thread: the library's own pools are not built for the thread checks.
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
  auto input = OIIO::ImageInput::open(path.string());
  if (!input) throw std::runtime_error(OIIO::geterror());
  return input;
}

ReadExr read_exr(const fs::path& path) {
  const auto input = open_image(path);
  ReadExr read{input->spec(), {}};
  for (int c = 0; c < read.spec.nchannels; ++c) {
    ReadChannel& channel = read.channels[read.spec.channelnames[static_cast<std::size_t>(c)]];
    channel.type = read.spec.channelformat(c);
    channel.bits.resize(static_cast<std::size_t>(read.spec.width * read.spec.height));
    if (!input->read_image(0, 0, c, c + 1, channel.type, channel.bits.data()))
      throw std::runtime_error(input->geterror());
  }
  return read;
}

std::vector<std::uint16_t> read_words(const fs::path& path) {
  const auto input = open_image(path);
  EXPECT_EQ(input->spec().format, OIIO::TypeDesc::UINT16);
  EXPECT_EQ(input->spec().nchannels, 1);
  std::vector<std::uint16_t> words(input->spec().image_pixels());
  EXPECT_TRUE(input->read_image(0, 0, 0, 1, OIIO::TypeDesc::UINT16, words.data()));
  return words;
}

class LabelOutput : public testing::Test {
 protected:
  LabelOutput() { write_text(scene_, labelled_scene_text()); }

  Outcome try_render(const Arguments& more, const Surroundings& surroundings = {}) {
    Arguments arguments = {"--scene", scene_, "--size", fmt::format("{}x{}", kWidth, kHeight)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_render(arguments, surroundings);
  }

  Outcome render(const Arguments& more) {
    Outcome outcome = try_render(more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return outcome;
  }

  Json read_json(const std::string& name) { return Json::parse(read_text(folder_.file(name))); }

  ScratchFolder scene_folder_, folder_;
  std::string scene_ = scene_folder_.file("bay.toml");
};

// A frame as the library draws it, with every label.
struct Drawn {
  View view;
  render::Target target;
};
Drawn draw(const std::string& scene_path, double t_s, double next_frame_s) {
  const render::World world(scene::load_scene(scene_path));
  Workers workers(1);
  ocean::SeaFrame sea;
  const auto view_at = [&](double at_s) {
    return render::world_view(world, at_s, kWidth, kHeight, sea, workers);
  };
  Drawn drawn{view_at(t_s), {}};
  render::FrameOptions options;
  options.labels = render::LabelSet::all();
  options.keep_linear = true;
  options.next_view = view_at(t_s + next_frame_s);
  options.next_frame_s = next_frame_s;
  render::Workspace workspace;
  render::render_frame(world, drawn.view, t_s, options, workspace, drawn.target, workers);
  return drawn;
}

void expect_floats(const ReadExr& exr, const std::string& name, auto value_of) {
  ASSERT_TRUE(exr.channels.contains(name)) << name;
  const ReadChannel& channel = exr.channels.at(name);
  EXPECT_EQ(channel.type, OIIO::TypeFloat) << name;
  for (std::size_t i = 0; i < kPixels; ++i)
    ASSERT_EQ(channel.bits[i], std::bit_cast<std::uint32_t>(static_cast<float>(value_of(i))))
        << name << " at " << i;
}

void expect_words(const ReadExr& exr, const std::string& name, auto value_of) {
  ASSERT_TRUE(exr.channels.contains(name)) << name;
  const ReadChannel& channel = exr.channels.at(name);
  EXPECT_EQ(channel.type, OIIO::TypeUInt32) << name;
  for (std::size_t i = 0; i < kPixels; ++i)
    ASSERT_EQ(channel.bits[i], value_of(i)) << name << " at " << i;
}

TEST_F(LabelOutput, EachPlaneHasTheBitsThatAreDrawn) {
  render({"--time", "2", "--labels", "all", "--labels-out", folder_.file("l.exr")});
  EXPECT_EQ(folder_.names(), (Names{"l.exr", "l.labels.json"}));
  const ReadExr exr = read_exr(folder_.file("l.exr"));
  EXPECT_EQ(exr.channels.size(), 18u);
  const Drawn drawn = draw(scene_, 2.0, 1.0 / 60.0);
  const render::Labels& l = drawn.target.labels;
  ASSERT_EQ(l.depth_m.size(), kPixels);
  expect_floats(exr, "Z", [&](std::size_t i) { return l.depth_m[i]; });
  expect_words(exr, "id", [&](std::size_t i) { return l.id[i]; });
  expect_words(exr, "class", [&](std::size_t i) { return l.klass[i]; });
  expect_words(exr, "flags", [&](std::size_t i) { return l.flags[i]; });
  expect_floats(exr, "elevation", [&](std::size_t i) { return l.elevation_m[i]; });
  expect_floats(exr, "foam", [&](std::size_t i) { return l.foam[i]; });
  const auto pixel = [](std::size_t i) {
    return glm::ivec2(static_cast<int>(i) % kWidth, static_cast<int>(i) / kWidth);
  };
  expect_floats(exr, "distance", [&](std::size_t i) {
    return render::distance_of(drawn.view, pixel(i).x, pixel(i).y, l.depth_m[i]);
  });
  for (int c = 0; c < 3; ++c) {
    const char axis = "XYZ"[c];
    expect_floats(exr, fmt::format("N.{}", axis), [&](std::size_t i) { return l.normal[i][c]; });
    expect_floats(exr, fmt::format("Ng.{}", axis),
                  [&](std::size_t i) { return l.geometric_normal[i][c]; });
    expect_floats(exr, fmt::format("P.{}", axis), [&](std::size_t i) {
      return render::position_of(drawn.view, pixel(i).x, pixel(i).y, l.depth_m[i])[c];
    });
    if (c < 2)
      expect_floats(exr, fmt::format("motion.{}", axis),
                    [&](std::size_t i) { return l.motion_px[i][c]; });
  }
  const ReadChannel& id = exr.channels.at("id");
  for (const std::uint32_t thing : {0u, 1u, 2u, 16u, 17u})
    EXPECT_GT(std::ranges::count(id.bits, thing), 5) << "the scene shows " << thing;
}

TEST_F(LabelOutput, AnExrPictureHoldsColourAndLabelsTogether) {
  const Outcome plain = render({"--hash", "--out", folder_.file("plain.exr")});
  const Outcome both =
      render({"--hash", "--out", folder_.file("both.exr"), "--labels", "depth,id,motion"});
  EXPECT_EQ(plain.out, both.out);
  EXPECT_EQ(folder_.names(), (Names{"both.exr", "both.labels.json", "plain.exr"}));
  const ReadExr exr = read_exr(folder_.file("both.exr")),
                colour = read_exr(folder_.file("plain.exr"));
  EXPECT_EQ(exr.names(), (Names{"B", "G", "R", "Z", "id", "motion.X", "motion.Y"}));
  for (const char* name : {"R", "G", "B"})
    EXPECT_EQ(exr.channels.at(name).bits, colour.channels.at(name).bits) << name;
}

TEST_F(LabelOutput, BesideOtherPicturesStandsAFileOfLabelsAFrame) {
  render({"--frames", "2-3", "--fps", "10", "--out", folder_.file("f_%04d.png"), "--labels",
          "motion", "--depth", folder_.file("d_%04d.npy"), "--ids", folder_.file("i_%d.png")});
  EXPECT_EQ(folder_.names(), (Names{"d_0002.npy", "d_0003.npy", "f_0002.labels.exr",
                                    "f_0002.labels.json", "f_0002.png", "f_0003.labels.exr",
                                    "f_0003.labels.json", "f_0003.png", "i_2.png", "i_3.png"}));
  const ReadExr exr = read_exr(folder_.file("f_0003.labels.exr"));
  EXPECT_EQ(exr.names(), (Names{"motion.X", "motion.Y"}));
  const Drawn drawn = draw(scene_, 3 / 10.0, 1.0 / 10.0);
  double farthest_px = 0.0;
  for (std::size_t i = 0; i < kPixels; ++i) {
    const glm::vec2 expected = drawn.target.labels.motion_px[i];
    ASSERT_NEAR(exr.channels.at("motion.X").number(i), expected.x, 1e-3) << i;
    ASSERT_NEAR(exr.channels.at("motion.Y").number(i), expected.y, 1e-3) << i;
    farthest_px = std::max(farthest_px, static_cast<double>(glm::length(expected)));
  }
  EXPECT_GT(farthest_px, 0.5) << "to the frame after it, 1 / fps later";
  const Json sidecar = read_json("f_0003.labels.json");
  EXPECT_EQ(sidecar["frame"], 3);
  EXPECT_EQ(sidecar["t_s"], 0.3);
  EXPECT_EQ(sidecar["fps"], 10.0);
  // Another part of the sequence has the same files.
  std::vector<std::string> texts;
  for (const char* name : {"f_0003.labels.json", "f_0003.labels.exr"})
    texts.push_back(read_text(folder_.file(name)));
  render({"--frames", "1-3", "--every", "2", "--fps", "10", "--threads", "2", "--out",
          folder_.file("f_%04d.png"), "--labels", "motion"});
  EXPECT_EQ(read_text(folder_.file("f_0003.labels.json")), texts[0]);
  EXPECT_TRUE(read_text(folder_.file("f_0003.labels.exr")) == texts[1]);
}

TEST_F(LabelOutput, LabelsChangeNoPictureAndThreadsNoLabel) {
  const Outcome plain = render({"--hash"});
  const auto labels_with = [&](const Arguments& more, const std::string& name) {
    Arguments arguments = {"--hash", "--labels", "all", "--labels-out", folder_.file(name)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(render(arguments).out, plain.out);
    return read_text(folder_.file(name));
  };
  const std::string one = labels_with({"--threads", "1"}, "1.exr");
  EXPECT_TRUE(one == labels_with({"--threads", "3", "--tile", "16"}, "3.exr"));
  const std::string plainest(simd_target_name(simd_targets().front()));
  EXPECT_TRUE(one == labels_with({"--simd", plainest}, "simd.exr"));
}

// --- Single planes

TEST_F(LabelOutput, TheDepthPngHas256StepsAMetre) {
  render({"--depth", folder_.file("d.png"), "--labels", "depth", "--labels-out",
          folder_.file("l.exr")});
  const std::vector<std::uint16_t> words = read_words(folder_.file("d.png"));
  const ReadExr exr = read_exr(folder_.file("l.exr"));
  ASSERT_EQ(words.size(), kPixels);
  int near = 0, sky = 0, far = 0;
  for (std::size_t i = 0; i < kPixels; ++i) {
    const float depth_m = exr.channels.at("Z").number(i);
    const bool has_depth = depth_m < 255.99f;
    ++(has_depth ? near : std::isinf(depth_m) ? sky : far);
    if (has_depth) {
      ASSERT_NEAR(words[i], depth_m * 256.0f, 0.5) << i;
    } else {
      ASSERT_EQ(words[i], 0) << depth_m;
    }
  }
  EXPECT_GT(near, 100);
  EXPECT_GT(sky, 100);
  EXPECT_GT(far, 0);
}

// The samples after the header, which says what NumPy has to know.
template <class Sample>
std::vector<Sample> read_npy(const fs::path& path, const std::string& type) {
  const std::string bytes = read_text(path);
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t head =
      10 + static_cast<unsigned char>(bytes.at(8)) + 256u * static_cast<unsigned char>(bytes.at(9));
  const std::string header = bytes.substr(10, head - 10);
  EXPECT_NE(header.find("'descr': '" + type + "'"), std::string::npos) << header;
  EXPECT_NE(header.find("(54, 96)"), std::string::npos) << header;
  std::vector<Sample> samples((bytes.size() - head) / sizeof(Sample));
  std::memcpy(samples.data(), bytes.data() + head, samples.size() * sizeof(Sample));
  return samples;
}

TEST_F(LabelOutput, NumpyArraysHoldEveryBit) {
  render({"--time", "2", "--depth", folder_.file("d.npy"), "--ids", folder_.file("i.npy")});
  const Drawn drawn = draw(scene_, 2.0, 1.0 / 60.0);
  EXPECT_EQ(read_npy<float>(folder_.file("d.npy"), "<f4"), drawn.target.labels.depth_m);
  EXPECT_EQ(read_npy<std::uint32_t>(folder_.file("i.npy"), "<u4"), drawn.target.labels.id);
  EXPECT_EQ(folder_.names(), (Names{"d.npy", "i.npy"}));
}

TEST_F(LabelOutput, TheIdPngHasTheIds) {
  render({"--time", "2", "--ids", folder_.file("i.png")});
  const std::vector<std::uint16_t> words = read_words(folder_.file("i.png"));
  const Drawn drawn = draw(scene_, 2.0, 1.0 / 60.0);
  EXPECT_EQ(std::vector<std::uint32_t>(words.begin(), words.end()), drawn.target.labels.id);
}

// --- The sidecar

TEST_F(LabelOutput, TheSidecarHasTheseKeysInThisOrder) {
  const Outcome outcome =
      render({"--time", "2.5", "--hash", "--out", folder_.file("a.png"), "--labels", "id,depth"});
  const Json json = read_json("a.labels.json");
  Names keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_EQ(keys, (Names{"program", "version", "command_line", "scene", "frame", "t_s", "fps",
                         "size", "labels_file", "picture_file", "picture_xxh3", "intrinsics",
                         "near_m", "pose", "channels", "classes", "objects"}));
  EXPECT_EQ(json["program"], "swell-render");
  EXPECT_EQ(json["version"], "0.9.0");
  EXPECT_EQ(json["command_line"].back(), "2.5") << "what draws the picture again";
  EXPECT_EQ(json["scene"]["file"], "bay.toml");
  EXPECT_EQ(json["scene"]["name"], "bay");
  EXPECT_EQ(json["scene"]["xxh3"].get<std::string>().size(), 16u);
  EXPECT_EQ(json["frame"], 0);
  EXPECT_EQ(json["t_s"], 2.5);
  EXPECT_EQ(json["fps"], 60.0);
  EXPECT_EQ(json["size"], Json({kWidth, kHeight}));
  EXPECT_EQ(json["labels_file"], "a.labels.exr");
  EXPECT_EQ(json["picture_file"], "a.png");
  EXPECT_EQ("frame 0 xxh3 " + json["picture_xxh3"].get<std::string>() + "\n", outcome.out);
  ASSERT_EQ(json["channels"].size(), 2u) << "what the file has, in the table's order";
  EXPECT_EQ(json["channels"][0]["name"], "depth");
  EXPECT_EQ(json["channels"][0]["planes"], Json({"Z"}));
  EXPECT_EQ(json["channels"][0]["type"], "float32");
  EXPECT_EQ(json["channels"][0]["unit"], "m");
  EXPECT_EQ(json["channels"][0]["sky"], "+inf");
  EXPECT_EQ(json["channels"][1]["name"], "id");
  EXPECT_EQ(json["channels"][1]["type"], "uint32");
}

TEST_F(LabelOutput, TheSidecarNamesClassesAndObjects) {
  render({"--labels", "id", "--labels-out", folder_.file("a.exr")});
  const Json json = read_json("a.labels.json");
  EXPECT_EQ(json["picture_file"], nullptr);
  const Names classes = {"sky", "water", "terrain", "object", "foam", "mark"};
  ASSERT_EQ(json["classes"].size(), classes.size());
  for (std::size_t i = 0; i < classes.size(); ++i)
    EXPECT_EQ(json["classes"][i], (Json{{"id", i}, {"name", classes[i]}}));
  const Json objects = Json::parse(R"([
    {"id": 0, "name": "sky", "class": 0, "class_name": "sky", "kind": "sky"},
    {"id": 1, "name": "sea", "class": 1, "class_name": "water", "kind": "water"},
    {"id": 2, "name": "land", "class": 2, "class_name": "terrain", "kind": "terrain"},
    {"id": 16, "name": "north mark", "class": 5, "class_name": "mark", "kind": "buoy"},
    {"id": 17, "name": "raft", "class": 3, "class_name": "object", "kind": "box"}])");
  EXPECT_EQ(json["objects"], objects);
}

TEST_F(LabelOutput, TheSceneHashIsThatOfWhatTheSceneSays) {
  render({"--labels", "id", "--labels-out", folder_.file("a.exr")});
  write_text(scene_, "# a comment\n" + labelled_scene_text());
  render({"--labels", "id", "--labels-out", folder_.file("b.exr")});
  write_text(scene_, labelled_scene_text() + "draught = 0.3\n");
  render({"--labels", "id", "--labels-out", folder_.file("c.exr")});
  const auto hash = [&](const char* name) { return read_json(name)["scene"]["xxh3"]; };
  EXPECT_EQ(hash("a.labels.json"), hash("b.labels.json"));
  EXPECT_NE(hash("a.labels.json"), hash("c.labels.json"));
  EXPECT_EQ(read_exr(folder_.file("a.exr")).spec.get_string_attribute("swell:scene_xxh3"),
            hash("a.labels.json").get<std::string>());
}

// A place in the picture, in pixels, as a program of robotics finds it from the sidecar.
glm::dvec2 project(const Json& json, glm::dvec3 p_world) {
  const Json &m = json["pose"]["world_from_optical"], &k = json["intrinsics"];
  glm::dvec3 p_optical(0.0);
  for (int column = 0; column < 3; ++column)  // a rotation's inverse is its transpose
    for (int row = 0; row < 3; ++row)
      p_optical[column] += m[row][column].get<double>() * (p_world[row] - m[row][3].get<double>());
  return {k["fx"].get<double>() * p_optical.x / p_optical.z + k["cx"].get<double>(),
          k["fy"].get<double>() * p_optical.y / p_optical.z + k["cy"].get<double>()};
}

TEST_F(LabelOutput, PoseAndIntrinsicsProjectAKnownPlaceToItsPixel) {
  render({"--labels", "position,depth", "--labels-out", folder_.file("a.exr")});
  const Json json = read_json("a.labels.json");
  // By hand: the eye is at (3, -20, 12), the heading 20 degrees, the pitch -8, 50 degrees high.
  const double deg = std::acos(-1.0) / 180.0;
  const double heading = 20.0 * deg, pitch = -8.0 * deg;
  const glm::dvec3 right(std::cos(heading), -std::sin(heading), 0.0);
  const glm::dvec3 ahead(std::sin(heading) * std::cos(pitch), std::cos(heading) * std::cos(pitch),
                         std::sin(pitch));
  const glm::dvec3 up = glm::cross(right, ahead);
  const double focal_px = 0.5 * kHeight / std::tan(25.0 * deg);
  EXPECT_NEAR(json["intrinsics"]["fx"].get<double>(), focal_px, 1e-4);
  EXPECT_NEAR(json["intrinsics"]["fy"].get<double>(), focal_px, 1e-4);
  for (const glm::dvec3& p : {glm::dvec3(20.0, 80.0, 1.0), glm::dvec3(8.0, 2.0, 5.0)}) {
    const glm::dvec3 from_eye = p - glm::dvec3(3.0, -20.0, 12.0);
    const double z = glm::dot(from_eye, ahead);
    const glm::dvec2 at = project(json, p);
    EXPECT_NEAR(at.x, 0.5 * kWidth + focal_px * glm::dot(from_eye, right) / z, 1e-3);
    EXPECT_NEAR(at.y, 0.5 * kHeight - focal_px * glm::dot(from_eye, up) / z, 1e-3);
  }

  // The matrix is the quaternion's, and places of pixels come back to their middles.
  const Json& q = json["pose"]["quaternion_wxyz"];
  const glm::dquat rotation(q[0].get<double>(), q[1].get<double>(), q[2].get<double>(),
                            q[3].get<double>());
  const glm::dvec3 z_axis = rotation * glm::dvec3(0.0, 0.0, 1.0);
  for (int row = 0; row < 3; ++row)
    EXPECT_NEAR(json["pose"]["world_from_optical"][row][2].get<double>(), z_axis[row], 1e-12);
  const ReadExr exr = read_exr(folder_.file("a.exr"));
  int seen = 0;
  for (std::size_t i = 0; i < kPixels; ++i) {
    if (std::isinf(exr.channels.at("Z").number(i))) continue;
    ++seen;
    const glm::dvec2 at =
        project(json, {exr.channels.at("P.X").number(i), exr.channels.at("P.Y").number(i),
                       exr.channels.at("P.Z").number(i)});
    ASSERT_NEAR(at.x, static_cast<double>(i % kWidth) + 0.5, 1e-3) << i;
    ASSERT_NEAR(at.y, static_cast<double>(i / kWidth) + 0.5, 1e-3) << i;
  }
  EXPECT_GT(seen, 1000);
}

TEST_F(LabelOutput, AMountedCameraRidesOnItsObject) {
  write_text(scene_,
             "[camera]\nmount = \"raft\"\nmount_offset_m = [0.0, 0.0, 8.0]\n"
             "[[object]]\nname = \"raft\"\nkind = \"box\"\nposition_m = [10.0, 20.0]\n");
  render({"--frames", "0-1", "--fps", "1", "--labels", "depth", "--labels-out",
          folder_.file("%d.exr")});
  const Json a = read_json("0.labels.json")["pose"], b = read_json("1.labels.json")["pose"];
  for (const Json& pose : {a, b}) {
    EXPECT_NEAR(pose["eye_m"][0].get<double>(), 10.0, 4.0);
    EXPECT_NEAR(pose["eye_m"][1].get<double>(), 20.0, 4.0);
    EXPECT_NEAR(pose["eye_m"][2].get<double>(), 8.0, 5.0);
  }
  EXPECT_NE(a, b);
}

// --- What is refused, and what goes wrong

TEST_F(LabelOutput, ImpossibleOptionsAreOneLine) {
  const std::string exr = folder_.file("a.exr"), png = folder_.file("a.png");
  struct Case {
    Arguments arguments, pieces;
  };
  const Case cases[] = {
      {{"--labels", "depht", "--out", png}, {"--labels", "'depht'", "depth, distance", "all"}},
      {{"--labels", "", "--out", png}, {"--labels"}},
      {{"--labels", "depth"}, {"--labels", "--out", "--labels-out"}},
      {{"--labels-out", exr}, {"--labels-out", "--labels"}},
      {{"--labels", "depth", "--labels-out", png}, {"--labels-out", png, ".exr"}},
      {{"--labels", "depth", "--labels-out", folder_.file("none/a.exr")}, {"none", "folder"}},
      {{"--labels", "depth", "--frames", "0-1", "--labels-out", exr}, {"--labels-out", "%04d"}},
      {{"--labels", "depth", "--out", png, "--picture-scale", "0.5"}, {"--picture-scale"}},
      {{"--depth", folder_.file("d.exr")}, {"d.exr", "'.exr'", ".png .npy"}},
      {{"--ids", folder_.file("i")}, {"''", ".png .npy"}},
      {{"--ids", png, "--frames", "0-1"}, {"--ids", "%04d"}},
      {{"--depth", png, "--picture-scale", "0.5"}, {"--picture-scale"}},
      {{"--depth", png, "--ids", png}, {"--ids", png, "--depth"}},
      {{"--out", exr, "--labels", "id", "--labels-out", exr}, {"--labels-out", exr, "--out"}},
      {{"--out", exr, "--labels", "id", "--labels-out", folder_.file("./a.exr")}, {"--labels-out"}},
      {{"--out", png, "--edge-samples", "3"}, {"--edge-samples", "'3'", "0, 4 or 8"}},
      {{"--out", png, "--edge-samples", "-1"}, {"--edge-samples", "'-1'"}},
      {{"--out", png, "--shading", "half"}, {"--shading", "'half'", "adaptive or full"}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.arguments.front() + " ... " + c.arguments.back());
    const Outcome outcome = try_render(c.arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(is_one_error_line(outcome.err, c.pieces)) << outcome.err;
  }
  EXPECT_TRUE(folder_.names().empty());
}

// A disk that fills up in the middle.
TEST_F(LabelOutput, AFailedWriteLeavesTheOldFileAndNoHalfOne) {
  const std::string exr = folder_.file("a.exr"), depth = folder_.file("d.npy");
  write_text(exr, "old");
  write_text(depth, "old");
  const Surroundings full = {.max_file_bytes = 4096};
  const Outcome labels = try_render({"--labels", "all", "--labels-out", exr}, full);
  EXPECT_EQ(labels.exit_code, 2);
  EXPECT_TRUE(is_one_error_line(labels.err, {exr})) << labels.err;
  const Outcome single = try_render({"--depth", depth}, full);
  EXPECT_EQ(single.exit_code, 2);
  EXPECT_TRUE(is_one_error_line(single.err, {depth})) << single.err;
  EXPECT_EQ(folder_.names(), (Names{"a.exr", "d.npy"})) << "and no sidecar without its labels";
  EXPECT_EQ(read_text(exr), "old");
  EXPECT_EQ(read_text(depth), "old");
}

}  // namespace
}  // namespace swell::apps
