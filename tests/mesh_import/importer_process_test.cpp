// The importer as a process: how long it lives, and what memory it may take.
#include <dirent.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>

#include "mesh_import/asset_file.h"
#include "mesh_import/asset_textures.h"
#include "mesh_import/mesh_files.h"
#include "shapes/mesh_file.h"
#include "shapes/run_importer.h"
#include "texture/image/image_io.h"

namespace swell::shapes {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// Asks for up to 20 s.
bool comes_true(const std::function<bool()>& condition) {
  for (int i = 0; i < 20'000; ++i) {
    if (condition()) return true;
    usleep(1000);
  }
  return false;
}

// The process that `parent` has started and that runs the importer; 0 if there is none.
pid_t importer_of(pid_t parent) {
  DIR* const processes = opendir("/proc");
  pid_t found = 0;
  while (const dirent* const entry = readdir(processes)) {
    const pid_t pid = std::atoi(entry->d_name);
    if (pid <= 0) continue;
    // "PID (NAME) STATE PARENT ...", the name's first 15 bytes
    const std::string stat = text_of(fs::path("/proc") / entry->d_name / "stat");
    const std::size_t name = stat.find("(swell_mesh_impo) ");
    if (name != std::string::npos && std::atoi(stat.c_str() + name + 20) == parent) found = pid;
  }
  closedir(processes);
  return found;
}

// A file of some 0.1 s.
fs::path write_long_file() {
  LooseTriangles boxes;
  for (int i = 0; i < 10'000; ++i) {
    const glm::vec3 at(static_cast<float>(i % 100), static_cast<float>(i / 100), 0.0f);
    const LooseTriangles box = box_triangles(at, at + 0.5f);
    boxes.corners.insert(boxes.corners.end(), box.corners.begin(), box.corners.end());
  }
  const fs::path file = mesh_folder("long") / "a.stl";
  write_stl(file, boxes);
  return file;
}

TEST(ImporterProcess, EndsWhenItsParentIsKilled) {
  const std::string file = write_long_file().string();
  std::array<int, 2> ends;
  ASSERT_EQ(pipe(ends.data()), 0);  // which hangs up when parent and importer have both ended
  const pid_t parent = fork();
  if (parent == 0) {
    close(ends[0]);
    for (;;) run_importer(file, scene::UpAxis::kByFormat);
  }
  close(ends[1]);
  pid_t importer = 0;
  // Its limits are set after it has said that it ends with its parent.
  EXPECT_TRUE(comes_true([&] {
    importer = importer_of(parent);
    if (importer == 0) return false;
    const std::string limits = text_of(fs::path("/proc") / std::to_string(importer) / "limits");
    if (limits.find("Max file size             0 ") == std::string::npos) return false;
    return kill(importer, SIGSTOP) == 0;
  }));
  kill(parent, SIGKILL);
  EXPECT_EQ(waitpid(parent, nullptr, 0), parent);
  pollfd hang_up = {ends[0], 0, 0};
  EXPECT_EQ(poll(&hang_up, 1, 5000), 1) << "the importer lives on";
  if (hang_up.revents == 0 && importer > 0) kill(importer, SIGKILL);
  close(ends[0]);
}

// Exit code of the importer, started here with the last argument.
int run_with_parent(const fs::path& file, const std::string& parent) {
  const std::string program = std::string(SWELL_BINARY_DIR) + "/lib/swell/swell_mesh_import";
  const pid_t child = fork();
  if (child == 0) {
    if (!std::freopen("/dev/null", "w", stdout)) _exit(3);
    execl(program.c_str(), program.c_str(), file.c_str(), "auto", parent.c_str(), nullptr);
    _exit(2);
  }
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(ImporterProcess, ReadsNothingForAParentThatIsGone) {
  const fs::path file = mesh_folder("orphan") / "a.stl";
  write_stl(file, box_triangles(glm::vec3(0.0f), glm::vec3(1.0f)));
  EXPECT_EQ(run_with_parent(file, std::to_string(getpid())), 0);
  EXPECT_EQ(run_with_parent(file, std::to_string(getppid())), 1);
}

TEST(ImporterProcess, RefusesAFileOfAThousandBytesThatAsksForAGigabyte) {
#ifdef SWELL_SANITIZED
  GTEST_SKIP() << "the checks take terabytes";
#endif
  const fs::path file = mesh_folder("greedy") / "a.dae";
  write_dae(file, box_triangles(glm::vec3(0.0f), glm::vec3(1.0f)), nullptr);
  std::string text = text_of(file);
  const std::string count = "<float_array id=\"a\" count=\"";
  const std::size_t at = text.find(count) + count.size();
  text.replace(at, text.find('"', at) - at, "268435456");
  write_text(file, text);
  try {
    load_mesh(file.string(), scene::UpAxis::kByFormat);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(),
                 "a file that takes too much memory to read, allowed 256 MB and 64 times its size, "
                 "at most 6144 MB");
  }
}

// A glTF file has its buffer and its picture in files of their own, and its mesh in two places.
TEST(ImporterProcess, CountsWhatTheFileNamesThePicturesAndWhatIsPlacedAgain) {
  const fs::path folder = mesh_folder("parts");
  const texture::Image8 image{8, 4, 3, std::vector<std::uint8_t>(8 * 4 * 3, 200)};
  texture::write_file(folder / "a.png", texture::encode_image(image, ".png"));
  std::string buffer;
  for (const float x : {0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f})
    buffer.append(reinterpret_cast<const char*>(&x), sizeof x);
  write_text(folder / "a.bin", buffer);
  write_text(folder / "a.gltf",
             R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],)"
             R"("nodes":[{"mesh":0},{"mesh":0,"translation":[5,0,0]}],)"
             R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],)"
             R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
             R"("textures":[{"source":0}],"images":[{"uri":"a.png"}],)"
             R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3,)"
             R"("min":[0,0,0],"max":[1,1,0]}],)"
             R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36}],)"
             R"("buffers":[{"byteLength":36,"uri":"a.bin"}]})");
  std::uint64_t inputs = 0;
  const mesh_import::InputCounter count = [&](std::uint64_t more) { inputs += more; };
  const auto mesh = mesh_import::read_asset(folder / "a.gltf", scene::UpAxis::kByFormat, count);
  EXPECT_EQ(mesh.material.size(), 2u);
  EXPECT_EQ(inputs, fs::file_size(folder / "a.gltf") + 36 + 8);
  inputs = 0;
  mesh_import::decode_textures(mesh.textures, folder, count);
  EXPECT_EQ(inputs, fs::file_size(folder / "a.png") + 8 * 4);
}

}  // namespace
}  // namespace swell::shapes

// What Assimp leaks as it reads a file, which in the program ends with the process.
extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp"; }
