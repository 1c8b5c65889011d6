// Parts of worlds in a folder: another process finds them, and no fault of a file shows.
#include "render/world/part_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "render/shot.h"
#include "render/world/world_state.h"
#include "render/world_view.h"
#include "scratch_folder.h"
#include "texture/image/image_io.h"

namespace swell::render {
namespace {

namespace fs = std::filesystem;

// What a world's making says of each part.
struct Made {
  Made(const scene::Scene& scene, const fs::path& folder)
      : world(scene, {.threads = 2, .cache_folder = folder, .log = [this](const std::string& line) {
                        lines.push_back(line);
                      }}) {}

  bool was_read(std::string_view part) const {
    return std::ranges::any_of(lines, [&](const std::string& line) {
      return line.starts_with(std::string(part) + ": ") && line.ends_with("read from the cache");
    });
  }
  // How long it took, as logged; 0: it was not made.
  double making_s(std::string_view part) const {
    const std::string begin = std::string(part) + ": ";
    for (const std::string& line : lines)
      if (line.starts_with(begin)) return std::stod(line.substr(begin.size()));
    return 0.0;
  }
  std::uint64_t hash() const {
    ocean::SeaFrame sea;
    Shot shot;
    shot.draw(world, world_view(world, 3.0, 96, 54, sea, shot.workers), 3.0);
    return picture_hash(shot.target);
  }

  std::vector<std::string> lines;
  World world;
};

std::vector<fs::path> files_of(const ScratchFolder& folder) {
  std::vector<fs::path> files;
  for (const std::string& name : folder.names()) files.push_back(folder.path() / name);
  return files;
}

TEST(PartCache, GivesAnotherWorldTheSamePicture) {
  for (const std::string name : {"beach", "everything_rays"}) {
    const ScratchFolder folder;
    const scene::Scene scene = load_shipped(name);
    const Made none(scene, {}), first(scene, folder.path());
    first.world.state().cache->wait();
    const Made second(scene, folder.path());
    int read = 0;
    for (const std::string part :
         {"air", "sky", "land", "shelter", "land shadow", "forest", "clouds"}) {
      EXPECT_FALSE(first.was_read(part)) << name << ' ' << part;
      // What takes 10 ms is kept; a machine may be faster.
      if (first.making_s(part) >= 0.011) {
        EXPECT_TRUE(second.was_read(part)) << name << ' ' << part;
      }
      read += second.was_read(part);
    }
    EXPECT_GE(read, 2) << name;
    EXPECT_EQ(first.hash(), none.hash()) << name;
    EXPECT_EQ(second.hash(), none.hash()) << name;
  }
}

TEST(PartCache, MakesAnewWhatItCannotRead) {
  const ScratchFolder folder;
  const scene::Scene scene = load_shipped("lagoon");
  const std::uint64_t hash = Made(scene, folder.path()).hash();
  const std::vector<fs::path> files = files_of(folder);
  ASSERT_GE(files.size(), 4u);
  for (std::size_t k = 0; k < files.size(); ++k) {
    if (k % 3 == 0) {
      fs::resize_file(files[k], fs::file_size(files[k]) / 2);
    } else if (k % 3 == 1) {
      fs::resize_file(files[k], 0);
    } else {
      std::fstream file(files[k], std::ios::binary | std::ios::in | std::ios::out);
      file.seekp(static_cast<std::streamoff>(fs::file_size(files[k]) / 2));
      file.put('\x5a').put('\xa5');
    }
  }
  const Made again(scene, folder.path());
  EXPECT_FALSE(again.was_read("land"));
  EXPECT_EQ(again.hash(), hash);
  again.world.state().cache->wait();
  EXPECT_TRUE(Made(scene, folder.path()).was_read("land"));
}

TEST(PartCache, NeverFails) {
  const ScratchFolder folder;
  const scene::Scene scene = load_shipped("open_ocean");
  const std::uint64_t hash = Made(scene, {}).hash();
  for (const fs::path& place : {folder.write("file", "a file"), fs::path("/proc/nothing"),
                                folder.path() / std::string(300, 'a'), fs::path("/dev/full")})
    EXPECT_EQ(Made(scene, place).hash(), hash) << place;
}

TEST(PartCache, LooksIntoTheFilesOfAScene) {
  const ScratchFolder folder, cache;
  const fs::path heights = folder.path() / "heights.exr";
  const auto write = [&](float top) {
    texture::ImageF image{64, 64, 1, std::vector<float>(64 * 64, 0.0f)};
    for (int y = 20; y < 44; ++y) std::fill_n(image.pixels.begin() + 64 * y + 20, 24, top);
    texture::write_file(heights, texture::encode_image(image, ".exr"));
  };
  scene::Scene scene;
  scene.terrain = scene::TerrainDescription{};
  scene.terrain->height_image = heights;
  scene.terrain->metres_per_pixel = 8.0;
  scene.terrain->low_m = -10.0;
  scene.terrain->high_m = 40.0;
  write(0.9f);
  const std::uint64_t low = Made(scene, cache.path()).hash();
  EXPECT_TRUE(Made(scene, cache.path()).was_read("land"));
  write(0.3f);
  const Made high(scene, cache.path());
  EXPECT_FALSE(high.was_read("land"));
  EXPECT_NE(high.hash(), low);
}

TEST(PartCache, LeavesNothingHalfWrittenWhereItIsGivenUp) {
  const ScratchFolder folder;
  const scene::Scene scene = load_shipped("open_ocean");
  struct Many {
    std::vector<std::uint64_t> values = std::vector<std::uint64_t>(std::size_t{1} << 21, 7);
    auto fields() { return std::tie(values); }
  };
  constexpr std::uint64_t kParts = 40;
  {
    PartCache cache(folder.path(), scene);
    const auto part = std::make_shared<Many>();
    for (std::uint64_t n = 0; n < kParts; ++n) cache.keep({n, n}, part);
  }
  const PartCache again(folder.path(), scene);
  std::size_t whole = 0;
  for (std::uint64_t n = 0; n < kParts; ++n) whole += again.find<Many>({n, n}).has_value();
  EXPECT_LT(whole, kParts);
  EXPECT_EQ(folder.names().size(), whole);
}

TEST(PartCache, HoldsNoMoreThanItMayAndKeepsWhatWasUsedLast) {
  const ScratchFolder folder;
  const scene::Scene scene = load_shipped("open_ocean");
  PartCache cache(folder.path(), scene);
  const auto key = [](std::uint64_t n) { return ValueHash{n, n}; };
  struct Numbers {
    std::vector<std::uint64_t> values = std::vector<std::uint64_t>(1000, 7);
    auto fields() { return std::tie(values); }
  };
  for (std::uint64_t n = 0; n < 10; ++n) cache.keep(key(n), std::make_shared<Numbers>());
  cache.wait();
  ASSERT_EQ(folder.names().size(), 10u);
  const auto now = fs::file_time_type::clock::now();
  for (const fs::path& file : files_of(folder))
    fs::last_write_time(file, now - std::chrono::hours(1));
  for (const std::uint64_t n : {3, 8}) EXPECT_TRUE(cache.find<Numbers>(key(n)));
  folder.write("mine.txt", "not the cache's");
  cache.trim(20'000);
  cache.wait();
  EXPECT_EQ(folder.names().size(), 3u);
  for (std::uint64_t n = 0; n < 10; ++n)
    EXPECT_EQ(cache.find<Numbers>(key(n)).has_value(), n == 3 || n == 8) << n;
}

TEST(PartCache, ServesManyAtOnce) {
  const ScratchFolder folder;
  const scene::Scene scene = load_shipped("open_ocean");
  const std::uint64_t hash = Made(scene, {}).hash();
  std::vector<std::uint64_t> hashes(4);
  {
    std::vector<std::jthread> makers;
    for (std::uint64_t& made : hashes)
      makers.emplace_back([&] { made = Made(scene, folder.path()).hash(); });
  }
  EXPECT_EQ(hashes, std::vector<std::uint64_t>(4, hash));
  for (const std::string& name : folder.names())
    EXPECT_EQ(std::ranges::count(name, '.'), 1) << name;  // none is unfinished
}

}  // namespace
}  // namespace swell::render
