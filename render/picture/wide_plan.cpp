#include "render/picture/wide_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "math/elementary.h"
#include "math/projection.h"
#include "raster/pass.h"

namespace swell::render {
namespace {

// What water mirrors may lie a tenth of a picture's height away (render/water), which is that of
// the common field of view here.
const double kPictureHeight = 2.0 * tan(radians(25.0));  // focal lengths
constexpr double kFaceMargin = 0.1;                      // likewise
constexpr int kTentMargin_px = 5;                        // for tents
constexpr double kMostReach_px = 4.0;

// Columns are right, down and ahead in the wide picture's optical frame. The sides stand upright.
const std::array<glm::dmat3, 6> kCubeFaces = {
    glm::dmat3({1, 0, 0}, {0, 1, 0}, {0, 0, 1}),    // ahead
    glm::dmat3({0, 0, -1}, {0, 1, 0}, {1, 0, 0}),   // right
    glm::dmat3({0, 0, 1}, {0, 1, 0}, {-1, 0, 0}),   // left
    glm::dmat3({1, 0, 0}, {0, 0, 1}, {0, -1, 0}),   // up
    glm::dmat3({1, 0, 0}, {0, 0, -1}, {0, 1, 0}),   // down
    glm::dmat3({-1, 0, 0}, {0, 1, 0}, {0, 0, -1}),  // back
};

// The face in whose square a ray lies.
std::size_t face_of(glm::dvec3 ray) {
  const glm::dvec3 a = glm::abs(ray);
  if (a.z >= a.x && a.z >= a.y) return ray.z >= 0.0 ? 0 : 5;
  if (a.x >= a.y) return ray.x >= 0.0 ? 1 : 2;
  return ray.y >= 0.0 ? 4 : 3;
}

// Where a face shows a ray, in tangents; none: behind it.
std::optional<glm::dvec2> tangents_of(const glm::dmat3& face, glm::dvec3 ray) {
  const double ahead = glm::dot(face[2], ray);
  if (ahead <= 1e-6) return std::nullopt;
  return glm::dvec2(glm::dot(face[0], ray), glm::dot(face[1], ray)) / ahead;
}

// Pixels a radian where the picture has most of them, both ways together.
double finest_px_per_rad(const Projection& projection, glm::ivec2 size_px) {
  if (projection.kind == ProjectionKind::kEquirectangular)
    return std::max(size_px.x / kTwoPi, size_px.y / kPi);
  constexpr int kRadii = 256;
  double most = 0.0;
  for (int i = 1; i <= kRadii; ++i) {
    const double theta = projection.half_fov_rad * i / kRadii;
    // Around the axis, where pixels become endlessly many behind the eye: at most twice.
    const double around =
        std::min(fisheye_radius(projection.bend, theta) / std::max(sin(theta), 1e-9), 2.0);
    most = std::max(most, fisheye_radius_slope(projection.bend, theta) * around);
  }
  return std::sqrt(most * projection.k.fx * projection.k.fy);
}

using OpticalRays = std::vector<std::optional<glm::dvec3>>;

struct FaceWindow {
  glm::dvec2 low{kInfinity<double>}, high{-kInfinity<double>};

  bool empty() const { return low.x > high.x; }
  void add(glm::dvec2 p) { low = glm::min(low, p), high = glm::max(high, p); }
};

std::array<FaceWindow, 6> windows_of(const OpticalRays& rays) {
  std::array<FaceWindow, 6> windows;
  for (const auto& ray : rays) {
    if (!ray) continue;
    const std::size_t face = face_of(*ray);
    windows[face].add(*tangents_of(kCubeFaces[face], *ray));
  }
  return windows;
}

// Cuts a face to a window, with the margin.
WideFace cut_face(std::size_t face, const FaceWindow& window, double focal_px) {
  const double margin_px = std::ceil(kFaceMargin * kPictureHeight * focal_px) + kTentMargin_px;
  const double left = std::floor(window.low.x * focal_px) - margin_px;
  const double top = std::floor(window.low.y * focal_px) - margin_px;
  const double right = std::ceil(window.high.x * focal_px) + margin_px;
  const double bottom = std::ceil(window.high.y * focal_px) + margin_px;
  return {kCubeFaces[face],
          {focal_px, focal_px, -left, -top},
          static_cast<int>(right - left),
          static_cast<int>(bottom - top)};
}

// The same for all faces, and none larger than pictures may be.
double focal_of(const std::array<FaceWindow, 6>& windows, double wanted_px) {
  double extent = 0.0;
  for (const FaceWindow& window : windows)
    if (!window.empty())
      extent = std::max({extent, window.high.x - window.low.x, window.high.y - window.low.y});
  const double most = raster::kMaxViewport - 2 * kTentMargin_px - 4;
  return std::min(wanted_px, most / (extent + 2.0 * kFaceMargin * kPictureHeight));
}

// Where a pixel lies in a face, given its ray and those of the next ones to the right and down.
WidePixel place_pixel(const WideFace& face, std::uint32_t number, glm::dvec3 ray,
                      const std::optional<glm::dvec3>& right,
                      const std::optional<glm::dvec3>& below) {
  const auto place = [&](glm::dvec3 r) -> std::optional<glm::dvec2> {
    const auto p = tangents_of(face.wide_from_face, r);
    if (!p) return std::nullopt;
    return glm::dvec2(face.k.cx + face.k.fx * p->x, face.k.cy + face.k.fy * p->y);
  };
  const glm::dvec2 at = *place(ray);
  glm::dvec2 squares(0.0);
  for (const auto& next : {right, below}) {
    const auto there = next ? place(*next) : std::nullopt;
    if (there) squares += (*there - at) * (*there - at);
  }
  const auto reach = [](double square) {
    return static_cast<float>(std::clamp(std::sqrt(square), 1.0, kMostReach_px));
  };
  return {static_cast<float>(at.x), static_cast<float>(at.y), reach(squares.x), reach(squares.y),
          number};
}

}  // namespace

WidePlan plan_wide(const Projection& projection, glm::ivec2 size_px, Workers& workers) {
  WidePlan plan = {projection, size_px, {}, {}};
  const auto width = static_cast<std::size_t>(size_px.x);
  const auto height = static_cast<std::size_t>(size_px.y);
  // A column and a row more, for the distance to the next pixel.
  OpticalRays rays((width + 1) * (height + 1));
  workers.for_each(height + 1, [&](std::size_t y, int) {
    for (std::size_t x = 0; x <= width; ++x)
      rays[y * (width + 1) + x] =
          ray_at(projection, size_px, {static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5});
  });
  const std::array<FaceWindow, 6> windows = windows_of(rays);
  const double focal_px = focal_of(windows, finest_px_per_rad(projection, size_px));
  std::array<std::uint32_t, 6> number{};
  for (std::size_t face = 0; face < windows.size(); ++face) {
    if (windows[face].empty()) continue;
    number[face] = static_cast<std::uint32_t>(plan.faces.size());
    plan.faces.push_back(cut_face(face, windows[face], focal_px));
  }
  plan.pixels.resize(width * height);
  workers.for_each(height, [&](std::size_t y, int) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t at = y * (width + 1) + x;
      if (!rays[at]) continue;
      const std::uint32_t face = number[face_of(*rays[at])];
      plan.pixels[y * width + x] =
          place_pixel(plan.faces[face], face, *rays[at], rays[at + 1], rays[at + width + 1]);
    }
  });
  return plan;
}

View face_view(const View& wide, const WideFace& face) {
  const glm::dmat3 world_from_wide(glm::dvec3(wide.right), -glm::dvec3(wide.up),
                                   glm::dvec3(wide.forward));
  const glm::dmat3 axes = world_from_wide * face.wide_from_face;  // right, down, ahead
  View view = make_view(wide.eye_world, glm::dmat3(axes[0], axes[2], -axes[1]),
                        lens_of_intrinsics(face.k, face.width_px, face.height_px), wide.near_m,
                        face.width_px, face.height_px);
  view.whole_height_px = static_cast<float>(kPictureHeight * face.k.fx);
  return view;
}

}  // namespace swell::render
