// What swell-render tells of its frames (--hash, --json), and how it compares them with what was
// told before (--expect).
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <sstream>

#include "apps/shared/json.h"
#include "apps/shared/program_runner.h"

namespace swell::apps {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

class FrameLines : public testing::Test {
 protected:
  FrameLines() { write_text(scene_, sea_scene_text()); }

  Outcome render(const Arguments& more) {
    Arguments arguments = {"--scene", scene_, "--size", "32x18"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_render(arguments);
  }

  // Frames 2 to 4 with more options.
  Outcome sequence(const Arguments& more) {
    Arguments arguments = {"--frames", "2-4", "--fps", "10"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return render(arguments);
  }

  Outcome compare(const std::string& expected) {
    write_text(file_, expected);
    return sequence({"--expect", file_});
  }

  void expect_failure(const Outcome& outcome, int exit_code, const Arguments& pieces) {
    EXPECT_EQ(outcome.exit_code, exit_code);
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(is_one_error_line(outcome.err, pieces)) << outcome.err;
  }

  ScratchFolder folder_;
  std::string scene_ = folder_.file("sea.toml"), file_ = folder_.file("expected");
};

TEST_F(FrameLines, JsonHasOneLineAFrameWithTheHashThatIsPrinted) {
  const Outcome hashes = sequence({"--hash"}), json = sequence({"--json", "-"});
  EXPECT_EQ(json.exit_code, 0) << json.err;
  EXPECT_EQ(json.err, "");
  const std::vector<std::string> lines = lines_of(json.out);
  ASSERT_EQ(lines.size(), 3u) << json.out;
  std::string printed;
  for (int i = 0; i < 3; ++i) {
    const Json line = Json::parse(lines[static_cast<std::size_t>(i)]);
    const int frame = 2 + i;
    const Json expected = {{"frame", frame},       {"t_s", frame / 10.0}, {"size", {32, 18}},
                           {"xxh3", line["xxh3"]}, {"scene", "sea"},      {"out", nullptr},
                           {"file_ms", nullptr}};
    EXPECT_EQ(line, expected);
    printed += fmt::format("frame {} xxh3 {}\n", frame, line["xxh3"].get<std::string>());
  }
  EXPECT_EQ(printed, hashes.out);
}

TEST_F(FrameLines, JsonNamesThePictureAndTheTime) {
  const std::string single = folder_.file("one.png");
  const Outcome one = render({"--time", "-1.25", "--out", single, "--json", "-"});
  const Json line = Json::parse(one.out);
  EXPECT_EQ(line["frame"], 0);
  EXPECT_EQ(line["t_s"], -1.25);
  EXPECT_EQ(line["out"], single);
  EXPECT_GT(line["file_ms"].get<double>(), 0.0) << "what its files took";

  const Outcome many = sequence({"--out", folder_.file("f_%03d.png"), "--json", "-"});
  const std::vector<std::string> lines = lines_of(many.out);
  ASSERT_EQ(lines.size(), 3u) << many.err;
  EXPECT_EQ(Json::parse(lines[2])["out"], folder_.file("f_004.png"));
  EXPECT_TRUE(std::filesystem::exists(folder_.file("f_004.png")));
}

TEST_F(FrameLines, JsonGoesIntoAFileBesideThePrintedHashes) {
  const Outcome outcome = sequence({"--hash", "--json", file_});
  EXPECT_EQ(outcome.out, sequence({"--hash"}).out);
  EXPECT_EQ(read_text(file_), sequence({"--json", "-"}).out);
}

TEST_F(FrameLines, JsonIsAloneOnStandardOutput) {
  EXPECT_EQ(sequence({"--hash", "--json", "-"}).out, sequence({"--json", "-"}).out);
  expect_failure(sequence({"--dump-scene", "--json", "-"}), 2, {"--dump-scene", "--json"});
}

TEST_F(FrameLines, JsonIsWholeOrNotThere) {
  write_text(file_, "before");
  const std::string nowhere = folder_.file("none/f.json");
  expect_failure(sequence({"--json", nowhere}), 2, {nowhere});
  // The second picture cannot be written: a folder has its name.
  std::filesystem::create_directory(folder_.file("f_3.png"));
  const Outcome failed = sequence({"--out", folder_.file("f_%d.png"), "--json", file_});
  EXPECT_NE(failed.exit_code, 0);
  EXPECT_EQ(read_text(file_), "before");
}

TEST_F(FrameLines, ANameThatIsNotUtf8StillMakesAJsonLine) {
  const std::string picture = folder_.file("a\xff.png");
  const Outcome outcome = render({"--out", picture, "--json", "-"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(Json::parse(outcome.out)["out"], folder_.file("a\uFFFD.png"));
}

TEST_F(FrameLines, TheHashesOfARunAreThoseOfTheNext) {
  const std::string text = sequence({"--hash"}).out, json = sequence({"--json", "-"}).out;
  for (const std::string& expected : {text, json, text + json}) {
    const Outcome outcome = compare(expected);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out + outcome.err, "");
  }
  // Frames of the file that are not drawn do not matter.
  const Outcome part = render({"--frames", "3-3", "--fps", "10", "--expect", file_, "--hash"});
  EXPECT_EQ(part.exit_code, 0) << part.err;
  EXPECT_EQ(part.out, lines_of(text)[1] + "\n");
}

TEST_F(FrameLines, AnotherHashIsNamedWithItsFrame) {
  const std::string text = sequence({"--hash"}).out, found = lines_of(text)[1].substr(13);
  std::string other = found;
  other.back() = other.back() == '0' ? '1' : '0';
  for (std::string expected : {text, sequence({"--json", "-"}).out}) {
    expected.replace(expected.find(found), found.size(), other);
    expect_failure(compare(expected), 1,
                   {"frame 3: ", "expected xxh3 " + other, "found xxh3 " + found, "1 of 3"});
  }
}

TEST_F(FrameLines, AFrameWithoutAnExpectedHashIsNamed) {
  const std::vector<std::string> lines = lines_of(sequence({"--hash"}).out);
  const std::string last_found = lines[2].substr(13);
  expect_failure(compare(lines[0] + "\n" + lines[1] + "\n"), 1,
                 {"frame 4: ", "no hash", file_, "found xxh3 " + last_found, "1 of 3"});
  expect_failure(compare(""), 1, {"frame 2: ", "no hash", "3 of 3"});
}

TEST_F(FrameLines, TheRunIsFinishedBeforeItFails) {
  write_text(file_, "");
  const std::string json = folder_.file("lines.json");
  const Outcome outcome =
      sequence({"--expect", file_, "--out", folder_.file("f_%d.png"), "--json", json});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(lines_of(read_text(json)).size(), 3u);
  EXPECT_TRUE(std::filesystem::exists(folder_.file("f_4.png")));
}

TEST_F(FrameLines, AFileOfOtherLinesIsRefusedAtItsFirstOne) {
  const std::string good = "frame 2 xxh3 0123456789abcdef\n";
  const char* bad[] = {
      "",
      "frame 2 xxh3 0123456789abcde",
      "frame 2 xxh3 0123456789abcdef0",
      "frame 2 xxh3 0123456789abcdeg",
      "frame 2 xxh3 0123456789abcdef ",
      "frame -2 xxh3 0123456789abcdef",
      "frame xxh3 0123456789abcdef",
      "frame two xxh3 0123456789abcdef",
      "frame 2 0123456789abcdef",
      "frame 99999999999 xxh3 0123456789abcdef",
      "{\"frame\": 2}",
      "{\"frame\": 2.5, \"xxh3\": \"0123456789abcdef\"}",
      "{\"frame\": 2, \"xxh3\": 81985529216486895}",
      "{\"frame\": 2, \"xxh3\": \"0123456789abcdef\"",
      "[2]",
      "frame 2 xxh3 0123456789abcdee",  // not that of the line before
  };
  for (const std::string line : bad) {
    SCOPED_TRACE(line);
    write_text(file_, good + line + "\n" + good);
    const Outcome outcome = sequence({"--expect", file_, "--out", folder_.file("f_%d.png")});
    expect_failure(outcome, 2, {"error: " + file_ + ":2: ", "got '" + line + "', allowed "});
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.file("f_2.png"))) << "drawn before it was refused";
}

TEST_F(FrameLines, AFileThatCannotBeReadIsNamed) {
  const std::string missing = folder_.file("no such file");
  expect_failure(sequence({"--expect", missing}), 2, {"error: " + missing + ": "});
  const std::string directory = folder_.path().string();
  expect_failure(sequence({"--expect", directory}), 2, {"error: " + directory + ": "});
}

}  // namespace
}  // namespace swell::apps
