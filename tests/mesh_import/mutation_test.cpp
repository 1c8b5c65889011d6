// Broken files: the importer may refuse or fail, the program that asked goes on.
//
// SWELL_MESH_MUTATIONS=10000 tries as many as that; 240 unless it is given.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "math/random.h"
#include "mesh_import/generated_files.h"
#include "mesh_import/mesh_files.h"
#include "shapes/mesh_file.h"

namespace swell::shapes {
namespace {

namespace fs = std::filesystem;

int mutations() {
  const char* const asked = std::getenv("SWELL_MESH_MUTATIONS");
#ifdef SWELL_SANITIZED
  constexpr int kFew = 60;  // checked builds are slow
#else
  constexpr int kFew = 240;
#endif
  return asked ? std::atoi(asked) : kFew;
}

// Checked importers have no bound of memory: at a file that asks for too much they work as long as
// they may.
void let_importers_end_soon() {
#ifdef SWELL_SANITIZED
  rlimit bound{};
  ASSERT_EQ(getrlimit(RLIMIT_CPU, &bound), 0);
  bound.rlim_cur = std::min<rlim_t>(bound.rlim_cur, 10);
  ASSERT_EQ(setrlimit(RLIMIT_CPU, &bound), 0);
#endif
}

using Bytes = std::vector<char>;

Bytes bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Bytes changed, cut out, doubled or cut off.
Bytes mutated(Bytes bytes, std::uint64_t number) {
  constexpr std::array<std::string_view, 2> kLarge = {"99999999999", "\xff\xff\xff\x7f"};
  std::uint64_t next = 0;
  const auto below = [&](std::size_t count) {
    const double part = random_uniform(1000 + number, next++);
    return static_cast<std::size_t>(part * static_cast<double>(count));
  };
  const std::size_t changes = 1 + below(4);
  for (std::size_t i = 0; i < changes && !bytes.empty(); ++i) {
    const std::size_t at = below(bytes.size());
    const std::size_t length = std::min(1 + below(24), bytes.size() - at);
    const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    const auto to = from + static_cast<std::ptrdiff_t>(length);
    switch (below(12)) {
      case 0:
        bytes.erase(from, to);
        break;
      case 1: {
        const Bytes piece(from, to);
        bytes.insert(from, piece.begin(), piece.end());
        break;
      }
      case 2:
        bytes.resize(at);
        break;
      case 3:
      case 4: {
        const std::string_view large = kLarge[number % 2];
        bytes.insert(bytes.erase(from, to), large.begin(), large.end());
        break;
      }
      default:
        bytes[at] = static_cast<char>(below(256));
        break;
    }
  }
  return bytes;
}

// What became of broken files.
struct Outcomes {
  int read = 0, refused = 0, failed = 0;  // failed: the importer did not end by itself
};

// Either a mesh whose numbers are in their ranges, or one line.
void expect_sane(const fs::path& file, Outcomes& outcomes) {
  try {
    const MeshOfFile mesh = load_mesh(file.string(), scene::UpAxis::kByFormat);
    ++outcomes.read;
    for (const ObjectMesh& level : mesh.levels) {
      ASSERT_FALSE(level.triangles.empty());
      for (const std::uint32_t index : level.indices) ASSERT_LT(index, level.position.size());
      for (const glm::vec3& q : level.position)
        ASSERT_TRUE(std::abs(q.x) < 0.51f && std::abs(q.y) < 0.51f && q.z > -0.01f && q.z < 1.01f);
    }
  } catch (const std::runtime_error& error) {
    const std::string fault = error.what();
    EXPECT_FALSE(fault.empty());
    EXPECT_EQ(fault.find('\n'), std::string::npos) << fault;
    const bool failed = fault.find("the importer fails") != std::string::npos;
    ++(failed ? outcomes.failed : outcomes.refused);
    if (failed) std::printf("%s: %s\n", file.c_str(), fault.c_str());
  }
}

TEST(MeshMutation, BrokenFilesAreReadOrRefused) {
  let_importers_end_soon();
  // Beside the files that they name.
  const fs::path folder = mesh_folder("mutation");
  const std::vector<GeneratedFile> files = generate_mesh_files(folder);
  Outcomes outcomes;
  for (int i = 0; i < mutations(); ++i) {
    // 7 files on, which has no divisor in common with their number.
    const fs::path& file = files[static_cast<std::size_t>(i) * 7 % files.size()].path;
    const fs::path broken = folder / ("broken" + file.extension().string());
    SCOPED_TRACE(file.filename().string() + " " + std::to_string(i));
    const Bytes bytes = mutated(bytes_of(file), static_cast<std::uint64_t>(i));
    std::ofstream(broken, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    expect_sane(broken, outcomes);
  }
  std::printf("%d broken files: %d read, %d refused, %d that the importer failed at\n", mutations(),
              outcomes.read, outcomes.refused, outcomes.failed);
  // Neither all nor none are read: files are broken, and not beyond all use.
  EXPECT_GT(outcomes.read, 0);
  EXPECT_GT(outcomes.refused, 0);
}

}  // namespace
}  // namespace swell::shapes
