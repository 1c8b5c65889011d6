// Prints what the viewer's governor has come to after so many seconds, and how sharp the picture is
// that it shows against the same frame at full quality. Not a test of its own: it needs an idle
// machine. governed_views.sh runs it for several scenes and sizes.
//   governed_view SCENE WIDTH HEIGHT SECONDS... [--frames FILE]
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "apps/shared/options.h"
#include "apps/view/viewer.h"
#include "scene/scene.h"

namespace {

using Clock = std::chrono::steady_clock;
using swell::render::Target;

// Mean difference between neighbours in rows and columns, of green.
double mean_gradient(const std::vector<std::uint8_t>& green, int width_px, int height_px) {
  double sum = 0.0;
  for (int y = 0; y + 1 < height_px; ++y)
    for (int x = 0; x + 1 < width_px; ++x) {
      const auto at = [&](int dx, int dy) {
        return static_cast<double>(green[static_cast<std::size_t>((y + dy) * width_px + x + dx)]);
      };
      sum += std::hypot(at(1, 0) - at(0, 0), at(0, 1) - at(0, 0));
    }
  return sum / (width_px * height_px);
}

// A picture of any size at width_px x height_px, as the window enlarges it.
std::vector<std::uint8_t> enlarged_green(const Target& picture, int width_px, int height_px) {
  std::vector<std::uint8_t> green(static_cast<std::size_t>(width_px * height_px));
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x) {
      const double u =
          std::clamp((x + 0.5) * picture.width_px / width_px - 0.5, 0.0, picture.width_px - 1.0);
      const double v =
          std::clamp((y + 0.5) * picture.height_px / height_px - 0.5, 0.0, picture.height_px - 1.0);
      const int x0 = static_cast<int>(u), y0 = static_cast<int>(v);
      const int x1 = std::min(x0 + 1, picture.width_px - 1);
      const int y1 = std::min(y0 + 1, picture.height_px - 1);
      const auto at = [&](int px, int py) {
        const auto place = static_cast<std::size_t>(py * picture.width_px + px);
        return static_cast<double>((picture.rgba[place] >> 8) & 0xff);
      };
      const double top = std::lerp(at(x0, y0), at(x1, y0), u - x0);
      const double bottom = std::lerp(at(x0, y1), at(x1, y1), u - x0);
      green[static_cast<std::size_t>(y * width_px + x)] =
          static_cast<std::uint8_t>(std::lround(std::lerp(top, bottom, v - y0)));
    }
  return green;
}

double sharpness(swell::view::Viewer& viewer, int width_px, int height_px) {
  const auto shown = enlarged_green(viewer.picture(), width_px, height_px);
  const auto full = enlarged_green(viewer.full_picture(), width_px, height_px);
  return mean_gradient(shown, width_px, height_px) / mean_gradient(full, width_px, height_px);
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  std::FILE* frames = nullptr;
  if (words.size() > 2 && words[words.size() - 2] == "--frames") {
    frames = std::fopen(words.back().c_str(), "w");
    words.resize(words.size() - 2);
  }
  if (words.size() < 4) {
    fmt::print(stderr, "governed_view SCENE WIDTH HEIGHT SECONDS... [--frames FILE]\n");
    return 2;
  }
  const int width_px = std::stoi(words[1]), height_px = std::stoi(words[2]);
  swell::view::ViewerSettings settings;
  settings.size = {width_px, height_px};
  settings.threads = 2;
  swell::view::Viewer viewer(swell::scene::load_scene(words[0]), settings);
  const Clock::time_point begin = Clock::now();
  std::vector<double> last_ms;
  for (std::size_t next = 3; next < words.size() && viewer.turn();) {
    const auto& report = viewer.report();
    last_ms.push_back(report.frame_ms);
    const double t_s = std::chrono::duration<double>(Clock::now() - begin).count();
    if (frames)
      fmt::print(frames, "{:.3f} {:.2f} {:.2f} {:.3f} {:.3f} {:.2f} {:.2f}\n", t_s,
                 report.statistics.frame_ms, report.present_ms, report.governor.detail,
                 report.picture_scale, report.governor.aim_ms, report.governor.whole_ms);
    if (t_s < std::stod(words[next])) continue;
    last_ms.erase(last_ms.begin(), last_ms.end() - static_cast<std::ptrdiff_t>(
                                                       std::min<std::size_t>(last_ms.size(), 60)));
    fmt::print(
        "{} {}x{} after {:2} s: size {:3.0f} %, triangles {:3.0f} %, {:4.1f} ms, {:3.0f} % "
        "of the budget, sharpness {:.2f}\n",
        words[0], width_px, height_px, words[next], 100.0 * report.picture_scale,
        100.0 * report.governor.detail, median(last_ms),
        100.0 * median(last_ms) / viewer.panel().budget_ms, sharpness(viewer, width_px, height_px));
    std::fflush(stdout);
    ++next;
  }
  if (frames) std::fclose(frames);
}
