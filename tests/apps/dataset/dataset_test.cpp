// swell-dataset as a user runs it: the same bytes however it is run, and right boxes.
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "apps/shared/program_runner.h"
#include "texture/image/image_io.h"

namespace swell::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int kSetSamples = 5, kSetWidth = 96, kSetHeight = 54;

std::string recipe_text(const std::string& more = "") {
  return fmt::format(R"(
scene = "sea.toml"
seed = 3
count = {}
size_px = [{}, {}]
{}
)",
                     kSetSamples, kSetWidth, kSetHeight, more) +
         R"(
[range]
t_s = [0, 100]
sea.seed = [1, 9]
wind.speed_mps = [2, 12]
"camera.eye_m[2]" = [3, 15]
camera.pitch_deg = [-14, -4]

[choice]
sky.cloud_seed = [1, 2]

[[objects]]
kind = "buoy"
number = [3, 6]
distance_m = [12, 40]
class = "buoy"
[[objects]]
kind = "boat"
number = [2, 4]
distance_m = [8, 30]
size_m = [2, 6, 2]
)";
}

class DataSet : public testing::Test {
 protected:
  DataSet() {
    write_text(folder_.file("sea.toml"), sea_scene_text() + "[[object]]\nkind = \"pier\"\n");
    write_text(recipe_, recipe_text());
  }

  Outcome run(const std::string& out, Arguments more = {}, const Surroundings& around = {}) {
    more.insert(more.begin(), {"--recipe", recipe_, "--out", folder_.file(out)});
    return run_program(SWELL_DATASET, more, around);
  }

  void make(const std::string& out, const Arguments& more = {}) {
    const Outcome outcome = run(out, more);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    // One line at the end, where no terminal shows the progress.
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find("samples drawn"), std::string::npos) << outcome.err;
  }

  // The bytes of all files by their names in the folder.
  std::map<std::string, std::string> files(const std::string& out) const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.file(out)))
      if (entry.is_regular_file())
        all[fs::relative(entry.path(), folder_.file(out)).string()] = read_text(entry.path());
    return all;
  }

  void expect_same(const std::string& actual, const std::string& expected) const {
    const auto a = files(actual), b = files(expected);
    ASSERT_EQ(a.size(), b.size());
    for (const auto& [name, bytes] : b)
      EXPECT_TRUE(a.contains(name) && a.at(name) == bytes) << name;
  }

  ScratchFolder folder_;
  std::string recipe_ = folder_.file("recipe.toml");
};

TEST_F(DataSet, IsTheSameOnAnyNumberOfThreadsAndFromShards) {
  make("one", {"--threads", "1"});
  for (const char* name : {"manifest.txt", "annotations.json", "contact.png", "images/000000.png",
                           "classes/000004.png", "instances/000004.png", "camera/000004.json"})
    EXPECT_TRUE(files("one").contains(name)) << name;
  make("two", {"--threads", "2"});
  expect_same("two", "one");
  make("seven", {"--threads", "7"});
  expect_same("seven", "one");
  make("shards", {"--shard", "2/3"});
  EXPECT_FALSE(files("shards").contains("manifest.txt"));
  make("shards", {"--shard", "0/3"});
  make("shards", {"--shard", "1/3"});
  expect_same("shards", "one");
  // One more sample leaves the others as they are.
  write_text(recipe_, [] {
    std::string text = recipe_text();
    return text.replace(text.find("count = 5"), 9, "count = 6");
  }());
  make("two");
  EXPECT_EQ(files("two").at("images/000004.png"), files("one").at("images/000004.png"));
  EXPECT_TRUE(files("two").contains("images/000005.png"));
}

TEST_F(DataSet, GoesOnWhereItWasKilled) {
  const char* const wanted = std::getenv("SWELL_DATASET_KILLS");
  const int kills = wanted ? std::atoi(wanted) : 4;
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  make("whole", {"--threads", "1"});
  const auto whole_us =
      static_cast<std::uint64_t>((Clock::now() - start) / std::chrono::microseconds(1));
  std::mt19937_64 random(11);
  for (int trial = 0; trial < kills;) {
    const std::string out = fmt::format("killed_{}", trial / 4);
    // Up to four kills of one data set.
    for (int i = 0; i < 4 && trial < kills; ++i, ++trial) {
      const Surroundings kill = {.signal = SIGKILL, .signal_after_us = random() % whole_us};
      const Outcome outcome = run(out, {"--threads", "1"}, kill);
      EXPECT_TRUE(outcome.exit_code == -SIGKILL || outcome.exit_code == 0);
    }
    make(out);
    expect_same(out, "whole");
    EXPECT_EQ(run(out, {"--check"}).exit_code, 0);
    fs::remove_all(folder_.file(out));
  }
}

TEST_F(DataSet, SamplesThatAreThereAreNotDrawnAgain) {
  make("a");
  const auto time_of = [&](const std::string& name) {
    return fs::last_write_time(folder_.path() / "a" / name);
  };
  const auto kept = time_of("images/000001.png"), record = time_of("records/000002.json");
  const auto before = files("a");
  write_text(folder_.path() / "a/classes/000002.png", "not what it was");
  const Outcome damaged = run("a", {"--check"});
  EXPECT_EQ(damaged.exit_code, 1);
  EXPECT_TRUE(is_one_error_line(damaged.err, {"classes/000002.png"})) << damaged.err;
  make("a");
  EXPECT_EQ(files("a"), before);
  EXPECT_EQ(time_of("images/000001.png"), kept);
  EXPECT_NE(time_of("records/000002.json"), record);
}

TEST_F(DataSet, ARecordOfSomethingElseThanHashesIsDamaged) {
  make("a");
  const auto before = files("a");
  const fs::path path = folder_.path() / "a/records/000002.json";
  const std::string text = read_text(path);
  const std::size_t key = text.find("\"classes/000002.png\"");
  ASSERT_NE(key, std::string::npos);
  const std::size_t begin = text.find('"', text.find(':', key));
  const std::size_t end = text.find('"', begin + 1) + 1;
  write_text(path, fmt::format("{}7{}", text.substr(0, begin), text.substr(end)));
  const Outcome damaged = run("a", {"--check"});
  EXPECT_EQ(damaged.exit_code, 1);
  EXPECT_TRUE(is_one_error_line(damaged.err, {"classes/000002.png"})) << damaged.err;
  make("a");
  EXPECT_EQ(files("a"), before);
}

class DamagedRecord : public DataSet {
 protected:
  DamagedRecord() {
    make("a");
    before_ = files("a");
    EXPECT_EQ(run("a", {"--check"}).exit_code, 0);
  }
  std::string text() const { return before_.at(kRecord); }
  void put(const std::string& text) { write_text(folder_.path() / "a" / kRecord, text); }

  // --check tells of it in one line, and the same command makes the data set as it was.
  void expect_mended(const std::string& piece = kRecord) {
    const Outcome damaged = run("a", {"--check"});
    EXPECT_EQ(damaged.exit_code, 1);
    EXPECT_TRUE(is_one_error_line(damaged.err, {piece})) << damaged.err;
    const Outcome again = run("a");
    EXPECT_EQ(again.exit_code, 0);
    EXPECT_NE(again.err.find("1 of 5 samples drawn"), std::string::npos) << again.err;
    EXPECT_EQ(files("a"), before_);
    EXPECT_EQ(run("a", {"--check"}).exit_code, 0);
  }

  static constexpr const char* kRecord = "records/000002.json";
  std::map<std::string, std::string> before_;
};

TEST_F(DamagedRecord, OfAnyByteIsDrawnAgain) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 2; ++trial) {
    std::string bytes = text();
    bytes[random() % bytes.size()] ^= static_cast<char>(1 << random() % 8);
    put(bytes);
    expect_mended("000002");
  }
}

TEST_F(DamagedRecord, OfAlteredFactsIsDrawnAgain) {
  Json record = Json::parse(text());
  record["facts"]["image"]["width"] = 97;
  put(record.dump() + "\n");
  expect_mended();
  record = Json::parse(text());
  record["facts"]["annotations"].push_back(record["facts"]["annotations"][0]);
  put(record.dump() + "\n");
  expect_mended();
}

TEST_F(DamagedRecord, OfAnotherShapeIsOneClearLine) {
  for (const char* other : {"[1, 2]", "{\"recipe\": 7}", ""}) {
    put(other);
    expect_mended();
  }
  // The first record, which is looked at for the recipe.
  const std::string first = before_.at("records/000000.json");
  write_text(folder_.path() / "a/records/000000.json", "{\"recipe\": [\"text\"]}");
  expect_mended("records/000000.json");
}

TEST_F(DamagedRecord, OfAnEarlierVersionIsSaidAndDrawnAgain) {
  for (int n = 0; n < kSetSamples; ++n) {
    const fs::path path = folder_.path() / "a" / fmt::format("records/{:06}.json", n);
    Json record = Json::parse(read_text(path));
    record.erase("hash");
    write_text(path, record.dump() + "\n");
  }
  const Outcome again = run("a");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_NE(again.err.find("note: "), std::string::npos) << again.err;
  EXPECT_NE(again.err.find("earlier version"), std::string::npos) << again.err;
  EXPECT_EQ(files("a"), before_);
}

TEST_F(DamagedRecord, OfAShardIsNamedByTheOthers) {
  put("[]");
  const Outcome other = run("a", {"--shard", "0/5"});
  EXPECT_NE(other.err.find(std::string("not complete: ") + kRecord), std::string::npos)
      << other.err;
}

class LinkedFolder : public DataSet {
 protected:
  LinkedFolder() { write_text(victim_, "not Swell's"); }
  ~LinkedFolder() override { EXPECT_EQ(read_text(victim_), "not Swell's"); }
  std::string victim_ = folder_.file("victim.txt");
};

TEST_F(LinkedFolder, WritesToNoFileOutside) {
  make("clean");
  fs::create_directories(folder_.file("a/images"));
  fs::create_directories(folder_.file("a/records"));
  for (const char* name : {"images/000001.png", "records/000003.json"})
    fs::create_symlink("../../victim.txt", folder_.path() / "a" / name);
  for (const char* name : {"manifest.txt", "contact.png"})
    fs::create_symlink("../victim.txt", folder_.path() / "a" / name);
  make("a");
  EXPECT_FALSE(fs::is_symlink(folder_.path() / "a/images/000001.png"));
  EXPECT_FALSE(fs::is_symlink(folder_.path() / "a/manifest.txt"));
  expect_same("a", "clean");
  EXPECT_EQ(run("a", {"--check"}).exit_code, 0);
}

TEST_F(LinkedFolder, IsRefusedByCheckEvenWithTheRightBytes) {
  make("a");
  const auto before = files("a");
  for (const char* name : {"images/000001.png", "records/000003.json", "manifest.txt"}) {
    const fs::path path = folder_.path() / "a" / name, moved = folder_.path() / "moved";
    fs::rename(path, moved);
    fs::create_symlink(moved, path);
    const Outcome damaged = run("a", {"--check"});
    EXPECT_EQ(damaged.exit_code, 1) << name;
    EXPECT_TRUE(is_one_error_line(damaged.err, {name})) << damaged.err;
    make("a");
    EXPECT_FALSE(fs::is_symlink(path)) << name;
    EXPECT_EQ(files("a"), before) << name;
  }
}

TEST_F(LinkedFolder, MayBeALinkItselfButHoldsNoneInPlaceOfAFolder) {
  fs::create_directories(folder_.file("far/away"));
  fs::create_directory_symlink("far/away", folder_.file("a"));
  make("a");
  EXPECT_TRUE(fs::exists(folder_.file("far/away/manifest.txt")));
  fs::create_directory(folder_.file("b"));
  fs::create_directory(folder_.file("outside"));
  fs::create_directory_symlink("../outside", folder_.file("b/images"));
  const Outcome refused = run("b");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(is_one_error_line(refused.err, {"b/images", "link"})) << refused.err;
  EXPECT_TRUE(fs::is_empty(folder_.file("outside")));
}

// Scenes of further files.
class SceneWithFiles : public DataSet {
 protected:
  void add_to_scene(const std::string& text) {
    write_text(folder_.file("sea.toml"), sea_scene_text() + text);
  }
  void add_to_recipe(const std::string& text) { write_text(recipe_, recipe_text() + text); }
  void put_mesh(const std::string& colour, const std::string& name = "m") {
    write_text(folder_.file(name + ".mtl"), "newmtl paint\nKd " + colour + "\n");
    write_text(folder_.file(name + ".obj"),
               "mtllib " + name +
                   ".mtl\nusemtl paint\nv 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\n"
                   "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  }
  void put_implicit(double size_m) {
    write_text(folder_.file("f.toml"), fmt::format("[[form]]\nsize = [{0}, {0}, {0}]\n", size_m));
  }
  void put_heights(float height_m) {
    texture::ImageF heights{64, 64, 1, std::vector<float>(64 * 64, -20.0f)};
    heights.pixels[64 * 32 + 32] = height_m;
    texture::write_file(folder_.file("heights.exr"), texture::encode_image(heights, ".exr"));
  }

  // Expects that after `change` the same command fails and names the folder and what differs, and
  // that a new folder is fine.
  void expect_other_state(const std::function<void()>& change) {
    make("a", {"--shard", "0/5"});
    change();
    for (const Arguments& more : {Arguments{}, Arguments{"--check"}}) {
      const Outcome other = run("a", more);
      EXPECT_EQ(other.exit_code, 2);
      EXPECT_TRUE(is_one_error_line(other.err, {"folder of a data set", "scene's files"}))
          << other.err;
    }
    make("b", {"--shard", "0/5"});
  }
};

TEST_F(SceneWithFiles, DoesNotMixStatesOfAMeshsMaterial) {
  put_mesh("1 0 0");
  add_to_recipe(
      "[[objects]]\nkind = \"mesh\"\nfile = \"m.obj\"\nnumber = [1, 1]\n"
      "distance_m = [10, 20]\n");
  expect_other_state([&] { put_mesh("0 1 0"); });
}

TEST_F(SceneWithFiles, DoesNotMixStatesOfAnImplicitSurface) {
  put_implicit(1.0);
  add_to_scene("[[object]]\nkind = \"form\"\nfile = \"f.toml\"\n");
  expect_other_state([&] { put_implicit(1.5); });
}

TEST_F(SceneWithFiles, DoesNotMixStatesOfAHeightImage) {
  put_heights(5.0f);
  add_to_scene("[terrain]\nheight_image = \"heights.exr\"\n");
  expect_other_state([&] { put_heights(6.0f); });
}

TEST_F(SceneWithFiles, DoesNotMixStatesOfAChoice) {
  put_mesh("1 0 0");
  put_mesh("0 0 1", "n");
  add_to_scene("[[object]]\nkind = \"mesh\"\nfile = \"m.obj\"\n");
  std::string text = recipe_text();
  text.insert(text.find("sky.cloud_seed"), "\"object[0].file\" = [\"m.obj\", \"n.obj\"]\n");
  write_text(recipe_, text);
  expect_other_state([&] { put_mesh("0 1 1", "n"); });
}

TEST_F(SceneWithFiles, TriesThemBeforeTheFolderIsMade) {
  write_text(folder_.file("bad.obj"), "no mesh\n");
  write_text(folder_.file("bad.toml"), "[[form]]\nshape = \"cloud\"\n");
  put_mesh("1 0 0");
  const auto expect_refused = [&](const std::string& piece) {
    const Outcome refused = run("bad");
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_TRUE(is_one_error_line(refused.err, {piece})) << refused.err;
    EXPECT_FALSE(fs::exists(folder_.file("bad")));
  };
  add_to_recipe(
      "[[objects]]\nkind = \"mesh\"\nfile = \"bad.obj\"\nnumber = [0, 1]\n"
      "distance_m = [10, 20]\n");
  expect_refused("object[");
  add_to_recipe(
      "[[objects]]\nkind = \"form\"\nfile = \"bad.toml\"\nnumber = [0, 1]\n"
      "distance_m = [10, 20]\n");
  expect_refused("bad.toml");
  add_to_scene("[[object]]\nkind = \"mesh\"\nfile = \"m.obj\"\n");
  std::string text = recipe_text();
  text.insert(text.find("sky.cloud_seed"), "\"object[0].file\" = [\"m.obj\", \"bad.obj\"]\n");
  write_text(recipe_, text);
  expect_refused("object[0].file");
}

// A mask that is right by itself, from the PNG of ids.
struct Mask {
  int x0 = kSetWidth, y0 = kSetHeight, x1 = -1, y1 = -1, area = 0;
};

TEST_F(DataSet, BoxesAndRunsAreThoseOfTheMasks) {
  write_text(recipe_, recipe_text("labels = \"depth,id\""));
  make("a");
  const Json coco = Json::parse(read_text(folder_.path() / "a/annotations.json"));
  ASSERT_EQ(coco["images"].size(), static_cast<std::size_t>(kSetSamples));
  int cut_off = 0, several_runs_a_column = 0;
  for (int n = 0; n < kSetSamples; ++n) {
    const auto image =
        texture::read_image(folder_.path() / "a" / fmt::format("instances/{:06}.png", n));
    const auto id_at = [&](int x, int y) { return std::lround(image.at(x, y, 0) * 65535.0f); };
    std::map<long, Mask> masks;
    for (int y = 0; y < kSetHeight; ++y)
      for (int x = 0; x < kSetWidth; ++x) {
        Mask& m = masks[id_at(x, y)];
        m.x0 = std::min(m.x0, x);
        m.x1 = std::max(m.x1, x);
        m.y0 = std::min(m.y0, y);
        m.y1 = std::max(m.y1, y);
        ++m.area;
      }
    std::erase_if(masks, [](const auto& entry) { return entry.first < 16; });
    for (const Json& one : coco["annotations"]) {
      if (one["image_id"] != n + 1) continue;
      const long id = one["instance_id"];
      ASSERT_TRUE(masks.contains(id));
      const Mask& m = masks[id];
      EXPECT_EQ(one["bbox"], Json({m.x0, m.y0, m.x1 - m.x0 + 1, m.y1 - m.y0 + 1}));
      EXPECT_EQ(one["area"], m.area);
      cut_off += m.x0 == 0 || m.y0 == 0 || m.x1 == kSetWidth - 1 || m.y1 == kSetHeight - 1;
      int place = 0, number = 0;
      for (const int run : one["segmentation"]["counts"].get<std::vector<int>>()) {
        for (int i = 0; i < run; ++i, ++place)
          ASSERT_EQ(id_at(place / kSetHeight, place % kSetHeight) == id, number % 2 == 1);
        ++number;
      }
      EXPECT_EQ(place, kSetWidth * kSetHeight);
      several_runs_a_column += number / 2 > m.x1 - m.x0 + 1;
      masks.erase(id);
    }
    EXPECT_TRUE(masks.empty()) << "of sample " << n << " an object without its annotation";
    EXPECT_TRUE(fs::exists(folder_.path() / "a" / fmt::format("labels/{:06}.exr", n)));
  }
  // Objects that the picture cuts off and that others or waves hide in part are among them.
  EXPECT_GT(cut_off, 0);
  EXPECT_GT(several_runs_a_column, 0);
  const Outcome schema =
      run_program("/usr/bin/python3", {COCO_CHECK, folder_.file("a/annotations.json")});
  if (schema.exit_code == 77) GTEST_SKIP() << "no python3-jsonschema";
  EXPECT_EQ(schema.exit_code, 0) << schema.err;
}

TEST_F(DataSet, CameraFilesSayHowToDrawTheSampleAgain) {
  make("a");
  const Json camera = Json::parse(read_text(folder_.path() / "a/camera/000003.json"));
  Arguments command = camera["command_line"];
  command.erase(command.begin());
  for (std::string& word : command) {
    if (word == "sea.toml") word = folder_.file(word);
    if (word == "000003.png") word = folder_.file(word);
  }
  command.push_back("--hash");
  const Outcome outcome = run_render(command);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            fmt::format("frame 0 xxh3 {}\n", camera["picture_xxh3"].get<std::string>()));
}

TEST_F(DataSet, EachSetHasItsOwnClassesAlone) {
  const std::map<std::string, std::vector<long>> allowed = {
      {"lars", {0, 1, 2, 255}}, {"mastr1325", {0, 1, 2, 4}}, {"waterscenes", {0, 1, 2, 5}}};
  for (const auto& [name, values] : allowed) {
    write_text(recipe_, recipe_text(fmt::format("classes = \"{}\"", name)));
    make(name, {"--shard", "0/5"});
    const auto image = texture::read_image(folder_.path() / name / "classes/000000.png");
    for (const float pixel : image.pixels)
      EXPECT_TRUE(std::ranges::count(values, std::lround(pixel * 255.0f)) == 1) << name << pixel;
  }
}

TEST_F(DataSet, BadRecipesAreOneLineEach) {
  const auto replaced = [](const std::string& from, const std::string& to) {
    std::string text = recipe_text();
    return text.replace(text.find(from), from.size(), to);
  };
  const std::vector<std::pair<std::string, std::vector<std::string>>> bad = {
      {replaced("count = 5", "count = 0"), {"recipe.toml:4", "count, got 0", "1 to 1000000"}},
      {replaced("count = 5", "sort = 0"),
       {"unknown key, got 'sort'", "allowed scene, seed, count"}},
      {replaced("count = 5", ""), {"count, got none"}},
      {replaced("\"sea.toml\"", "\"lake.toml\""), {"lake.toml", "scene file"}},
      {replaced("wind.speed_mps = [2, 12]", "wind.speed_mps = [12, 2]"),
       {"wind.speed_mps", "[LOW, HIGH] with LOW <= HIGH"}},
      {replaced("wind.speed_mps", "wind.sped_mps"),
       {"unknown key, got 'wind.sped_mps'", "speed_mps"}},
      {replaced("wind.speed_mps = [2, 12]", "wind.speed_mps = [2, 1200]"),
       {"wind.speed_mps", "got 1200", "allowed"}},
      {replaced("sea.seed = [1, 9]", "sea.seed = [1.5, 9]"), {"sea.seed", "got 1.5"}},
      {replaced("sky.cloud_seed = [1, 2]", "sky.cloud_seed = []"), {"sky.cloud_seed", "a list"}},
      {replaced("sky.cloud_seed = [1, 2]", "wind.speed_mps = [1, 2]"),
       {"wind.speed_mps", "[choice]"}},
      {replaced("kind = \"buoy\"", "kind = \"whale\""), {"whale", "allowed"}},
      {replaced("number = [3, 6]", "number = [6, 3]"), {"objects.number", "LOW <= HIGH"}},
      {replaced("number = [3, 6]", ""), {"objects.number, got none"}},
      {replaced("class = \"buoy\"", "position_m = [1, 2]"), {"objects.position_m"}},
      {replaced("size_px = [96, 54]", "size_px = [96, 0]"), {"size_px", "1 to 8192"}},
      {replaced("seed = 3", "seed = -3"), {"seed, got -3"}},
      {recipe_text("labels = \"colour\""), {"labels, got 'colour'", "depth"}},
      {recipe_text("classes = \"coco\""), {"classes, got 'coco'", "lars, mastr1325"}},
      {"scene = [", {"recipe.toml", "syntax error"}},
  };
  for (const auto& [text, pieces] : bad) {
    write_text(recipe_, text);
    const Outcome outcome = run("bad");
    EXPECT_EQ(outcome.exit_code, 2) << text;
    EXPECT_TRUE(is_one_error_line(outcome.err, pieces)) << outcome.err << text;
    EXPECT_FALSE(fs::exists(folder_.file("bad")));
  }
  // --try says the same.
  EXPECT_EQ(run("bad", {"--try"}).exit_code, 2);
  write_text(recipe_, recipe_text());
  const Outcome tried = run("bad", {"--try"});
  EXPECT_EQ(tried.exit_code, 0) << tried.err;
  EXPECT_FALSE(fs::exists(folder_.file("bad")));
  for (const Arguments& wrong : {Arguments{"--shard", "3/3"}, Arguments{"--threads", "0"}})
    EXPECT_EQ(run("bad", wrong).exit_code, 2);
}

TEST_F(DataSet, BadFoldersAreOneLineEach) {
  write_text(folder_.file("file"), "");
  const Outcome file = run("file");
  EXPECT_EQ(file.exit_code, 2);
  EXPECT_TRUE(is_one_error_line(file.err, {"folder of a data set"})) << file.err;
  EXPECT_EQ(run("none", {"--check"}).exit_code, 1);
  EXPECT_FALSE(fs::exists(folder_.file("none")));
  make("a", {"--shard", "0/5"});
  write_text(recipe_, recipe_text("classes = \"lars\""));
  const Outcome other = run("a");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_TRUE(is_one_error_line(other.err, {"another recipe"})) << other.err;
}

TEST_F(DataSet, AFullDiskLeavesNoHalfSample) {
  const Outcome outcome = run("a", {}, {.max_file_bytes = 2000});
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_TRUE(is_one_error_line(outcome.err)) << outcome.err;
  for (const auto& [name, bytes] : files("a")) EXPECT_FALSE(name.starts_with("records")) << name;
  make("a");
  make("b");
  expect_same("a", "b");
}

}  // namespace
}  // namespace swell::apps
