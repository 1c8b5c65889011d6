// What swell-bench papers shows of a paper: each of its figures and tables, made again, beside what
// the paper says.
#pragma once

#include <deque>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/shared/options.h"
#include "render/frame.h"
#include "scene/scene.h"
#include "texture/image/image.h"

namespace swell::apps {

// How a number of ours stands to the paper's.
enum class Agreement : std::uint8_t {
  kSame,     // within the tolerance
  kAtMost,   // times: what the original's hardware met
  kAtLeast,  // rates, and factors
};

struct PaperNumber {
  std::string what, unit;
  double paper = 0.0, ours = 0.0;
  Agreement agreement = Agreement::kSame;
  double tolerance = 0.0;

  bool holds() const;
};

// A figure or a table.
struct PaperItem {
  std::string number;                 // "Figure 3"
  std::string words;                  // of the paper, in short
  std::string scene;                  // the file that it was drawn from; empty: none
  std::vector<std::string> pictures;  // files beside the page
  std::vector<PaperNumber> numbers;
  std::string difference;  // why ours is another; empty: it is not
};

struct Paper {
  std::string title;
  std::vector<PaperItem> items;
};

inline constexpr double kShown_s = 5.0;  // what pictures show

// Where pictures go, and what draws them.
class PaperStudio {
 public:
  // scenes: the folder of Swell's scenes; out: an existing folder.
  PaperStudio(std::filesystem::path scenes, std::filesystem::path out, PictureSize size,
              int threads);

  // All return the file's name in `out`. sets: as --set has them.
  std::string draw(std::string_view name, const std::string& scene,
                   std::span<const std::string> sets = {}, render::FrameOptions options = {},
                   double t_s = kShown_s);
  std::string write(std::string_view name, const texture::Image8& image) const;
  std::string write(std::string_view name, const std::string& svg) const;

  // The absolute path of a file beside the page.
  std::filesystem::path picture_path(std::string_view file) const {
    return std::filesystem::absolute(out_) / file;
  }
  std::filesystem::path scene_path(const std::string& scene) const { return scenes_ / scene; }
  scene::Scene load(const std::string& scene, std::span<const std::string> sets = {}) const;
  // Made of what the last few worlds have in common with it, or one of them.
  const render::World& world_of(const std::string& scene, std::span<const std::string> sets = {});
  PictureSize size() const { return size_; }
  int threads() const { return threads_; }
  Workers& workers() { return workers_; }
  // Of the last picture that was drawn, and its pixels.
  const render::FrameStatistics& statistics() const { return statistics_; }
  const render::Target& picture() const { return picture_; }
  // The least of so many frames, 60 a second; after some that do not count.
  double least_frame_ms(const std::string& scene, int frames);

 private:
  std::filesystem::path scenes_, out_;
  PictureSize size_;
  int threads_;
  Workers workers_;
  struct KeptWorld {
    std::string key;
    render::World world;
  };
  std::deque<KeptWorld> kept_;
  render::Workspace workspace_;
  render::FrameStatistics statistics_;
  render::Target picture_;
};

// Elykov, Belago, Kuzikovsky, Nekrasov, 2000.
Paper sea_paper(PaperStudio& studio);
// Ma, Zhu, Gong, 2006.
Paper optics_paper(PaperStudio& studio);
// Gabdrakhmanov.
Paper maps_paper(PaperStudio& studio);
// Vyatkin, Dolgovesov, 2019.
Paper functions_paper(PaperStudio& studio);

// The page that shows them, as HTML.
std::string papers_page(std::span<const Paper> papers);

}  // namespace swell::apps
