// swell-bench papers: all figures and tables of the four papers, made again, on one page.
#include <fmt/core.h>

#include <memory>

#include "apps/bench/bench.h"
#include "apps/papers/paper.h"
#include "apps/shared/report.h"
#include "texture/image/program_folder.h"

namespace swell::apps {
namespace {

struct PapersRun {
  std::string out, scenes;
  std::string size = "480x270";
  int threads = available_cpus();
  std::string simd;
};

// Beside the sources' build folder, or where the package has them.
std::filesystem::path scenes_folder(const PapersRun& run) {
  if (!run.scenes.empty()) return run.scenes;
  const std::filesystem::path installed = texture::folder_of_this_code() / "../share/swell/scenes";
  return std::filesystem::exists(installed) ? installed : "scenes";
}

void print_numbers(const Paper& paper) {
  fmt::print("{}\n", paper.title);
  for (const PaperItem& item : paper.items) {
    fmt::print("  {}: {} picture{}\n", item.number, item.pictures.size(),
               item.pictures.size() == 1 ? "" : "s");
    for (const PaperNumber& n : item.numbers)
      fmt::print("    {}: paper {:.6g}, here {:.6g} {}{}\n", n.what, n.paper, n.ours, n.unit,
                 n.holds() ? "" : "  DIFFERS");
  }
}

void run_papers(const PapersRun& run) {
  select_simd(run.simd);
  const PictureSize size = parse_size(run.size);
  const std::filesystem::path out(run.out);
  check_text_place((out / "papers.html").string());
  PaperStudio studio(scenes_folder(run), out, size, run.threads);
  const std::vector<Paper> papers = {sea_paper(studio), optics_paper(studio), maps_paper(studio),
                                     functions_paper(studio)};
  for (const Paper& paper : papers) print_numbers(paper);
  write_text((out / "papers.html").string(), papers_page(papers));
}

}  // namespace

BenchMode add_bench_papers(CommandLine& program) {
  const auto run = std::make_shared<PapersRun>();
  CommandLine line = program.add_mode("papers",
                                      "Every figure and table of the four papers that Swell makes "
                                      "again, as pictures and numbers beside "
                                      "theirs, on a page papers.html");
  line.add_text("--out", "FOLDER", run->out, "Where the page and its pictures go; it exists");
  line.require("--out");
  line.add_text("--scenes", "FOLDER", run->scenes,
                "Swell's scenes; without it those of the package, or ./scenes");
  line.add_text("--size", "WxH", run->size, "Of the pictures");
  add_machine_options(line, run->threads, run->simd);
  return {line, [run] { run_papers(*run); }};
}

}  // namespace swell::apps
