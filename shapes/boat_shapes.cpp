#include "shapes/boat_shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace swell::shapes {
namespace {

constexpr Paint kHull{};
constexpr Paint kAntifouling{glm::vec3(0.10f, 0.016f, 0.013f), false, 0.8f};
constexpr Paint kWood{glm::vec3(0.20f, 0.105f, 0.045f), false, 0.5f};
constexpr Paint kTeak{glm::vec3(0.30f, 0.21f, 0.12f), false, 0.7f};
constexpr Paint kCabin{glm::vec3(0.75f, 0.75f, 0.72f), false, 0.35f};
constexpr Paint kGlass{glm::vec3(0.012f, 0.014f, 0.016f), false, 0.08f};
constexpr Paint kAluminium{glm::vec3(0.75f, 0.76f, 0.78f), false, 0.35f, 1.0f};
constexpr Paint kCloth{glm::vec3(0.80f, 0.79f, 0.75f), false, 1.0f, 0.0f, 0.5f};

// The form of a hull in metres, stern at -length / 2, bow at length / 2, still water at z = 0.
struct HullLines {
  float length, half_beam;
  float keel, stern_keel;               // z of the lowest line amidships, and at the stern
  float sheer, bow_sheer, stern_sheer;  // z of the upper edge
  float transom;                        // breadth at the stern over that amidships
  float widest;                         // where, in [0, 1] from the stern

  float y(float t) const { return (t - 0.5f) * length; }
  float half_breadth(float t) const {
    if (t < widest) {
      const float s = (widest - t) / widest;
      return half_beam * (1.0f - (1.0f - transom) * s * s);
    }
    const float s = (t - widest) / (1.0f - widest);
    return half_beam * std::max(1.0f - s * s * (0.55f + 0.45f * s), 0.012f);
  }
  float top(float t) const {
    const float s = 2.0f * t - 1.0f;
    return sheer + s * s * ((s > 0.0f ? bow_sheer : stern_sheer) - sheer);
  }
  float bottom(float t) const {
    const float aft = std::max(1.0f - t / 0.45f, 0.0f), fore = std::max((t - 0.7f) / 0.3f, 0.0f);
    return keel + aft * aft * (stern_keel - keel) + fore * fore * (0.75f * top(t) - keel);
  }
  // Across a section: u from -1, the left edge, over 0, the keel, to 1.
  glm::vec3 at(float t, float u) const {
    const float a = std::abs(u), round = 1.0f - (1.0f - a) * (1.0f - a);
    const float breadth = 0.35f * a + 0.65f * std::sqrt(round);
    const float height = a * a * (0.35f + 0.65f * a * a);
    const float x = half_breadth(t) * breadth;
    return {u < 0.0f ? -x : x, y(t), bottom(t) + (top(t) - bottom(t)) * height};
  }
};

// In the order of the members.
constexpr HullLines kRowingLines{4.6f, 0.85f, -0.2f, -0.1f, 0.38f, 0.595f, 0.46f, 0.72f, 0.42f};
constexpr HullLines kSailingLines{9.2f, 1.45f, -0.5f, -0.02f, 0.95f, 1.25f, 1.0f, 0.7f, 0.42f};

struct Sections {
  int stations;
  std::vector<float> u;
};

constexpr float kFloor_m = 0.13f;

// Between columns of sections, seen from outside; inside out if `inner`, which is drawn in a
// little.
void add_skin(const HullLines& lines, const Sections& sections, const Paint& paint, bool inner,
              MeshBuilder& to) {
  std::vector<glm::vec3> points;
  const int columns = static_cast<int>(sections.u.size());
  for (int i = 0; i <= sections.stations; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(sections.stations);
    for (int j = 0; j < columns; ++j) {
      const float u = sections.u[static_cast<std::size_t>(inner ? columns - 1 - j : j)];
      glm::vec3 p = lines.at(t, u);
      // The floor lies over the water, which would else show through it.
      if (inner) p = {0.93f * p.x, 0.975f * p.y, std::clamp(p.z + 0.05f, kFloor_m, lines.top(t))};
      points.push_back(p);
    }
  }
  add_sheet(points, columns, paint, to);
}

// The flat end of a hull at its stern.
void add_transom(const HullLines& lines, const Sections& sections, const Paint& paint,
                 MeshBuilder& to) {
  std::vector<glm::vec3> corners;
  for (const float u : sections.u) corners.push_back(lines.at(0.0f, u));
  add_polygon(corners, paint, to);
}

// A band along both upper edges.
void add_gunwale(const HullLines& lines, int stations, float width_m, const Paint& paint,
                 MeshBuilder& to) {
  for (const float side : {-1.0f, 1.0f}) {
    std::vector<glm::vec3> points;
    for (int i = 0; i <= stations; ++i) {
      const float t = static_cast<float>(i) / static_cast<float>(stations);
      const glm::vec3 edge = lines.at(t, side);
      const float in = std::min(width_m, std::abs(edge.x));
      const glm::vec3 inner(edge.x - side * in, edge.y, edge.z);
      points.push_back(side < 0.0f ? edge : inner);
      points.push_back(side < 0.0f ? inner : edge);
    }
    add_sheet(points, 2, paint, to);
  }
}

// As fine as asked for: near by, further off, where a boat is a few pixels long.
bool is_near(const MeshBuilder& to) { return to.segments >= 12; }
bool is_afar(const MeshBuilder& to) { return to.segments < 6; }
int stations_for(const MeshBuilder& to) { return is_near(to) ? 12 : is_afar(to) ? 3 : 5; }
Sections sections_for(const MeshBuilder& to, std::initializer_list<float> fine) {
  Sections sections{stations_for(to), fine};
  if (!is_near(to))
    sections.u = {sections.u.front(), 0.5f * (sections.u.front() + sections.u.back()),
                  sections.u.back()};
  return sections;
}

void add_hull_skin(const HullLines& lines, MeshBuilder& to) {
  Sections left = sections_for(to, {-1.0f, -0.92f, -0.82f});
  Sections right = sections_for(to, {0.82f, 0.92f, 1.0f});
  Sections bottom{stations_for(to), {-0.82f, -0.6f, -0.3f, 0.0f, 0.3f, 0.6f, 0.82f}};
  Sections stern{0, {-1.0f, -0.82f, -0.5f, 0.0f, 0.5f, 0.82f, 1.0f}};
  if (!is_near(to)) bottom.u = {-0.82f, -0.3f, 0.3f, 0.82f};
  if (is_afar(to)) {
    left.u = {-1.0f, -0.82f}, right.u = {0.82f, 1.0f};
    bottom.u = {-0.82f, 0.0f, 0.82f}, stern.u = {-1.0f, -0.82f, 0.0f, 0.82f, 1.0f};
  }
  add_skin(lines, left, kHull, false, to);
  add_skin(lines, right, kHull, false, to);
  add_skin(lines, bottom, kAntifouling, false, to);
  add_transom(lines, stern, kHull, to);
}

// --- Of the sailing boat

// A sail between its foot and its head, bellied to one side.
void add_sail(glm::vec3 tack, glm::vec3 clew, glm::vec3 head, float belly_m, MeshBuilder& to) {
  const int n = is_near(to) ? 6 : 2;
  std::vector<glm::vec3> points;
  for (int i = 0; i <= n; ++i) {
    const float v = static_cast<float>(i) / static_cast<float>(n);
    for (int j = 0; j <= n; ++j) {
      const float u = static_cast<float>(j) / static_cast<float>(n);
      const glm::vec3 foot = tack + u * (clew - tack);
      glm::vec3 p = foot + v * (head - foot);
      p.x += belly_m * 4.0f * u * (1.0f - 0.8f * u) * (1.0f - v) * (0.3f + v);
      points.push_back(p);
    }
  }
  add_sheet(points, n + 1, kCloth, to);
}

void add_upright(glm::vec2 at, float radius_low, float radius_high, float low, float high,
                 const Paint& paint, MeshBuilder& to) {
  const glm::vec3 before = to.origin;
  const int segments = to.segments;
  to.origin += glm::vec3(at, 0.0f);
  to.segments = std::min(segments, 10);
  add_turned({{radius_low, low}, {radius_high, high}, {0.0f, high}}, paint, to);
  to.origin = before, to.segments = segments;
}

// A house with sides that lean in and a dark band of windows.
void add_cabin(float half_low, float half_high, float stern_y, float bow_y, float low, float high,
               MeshBuilder& to) {
  const auto ring = [&](float part, float grow) {
    const float z = low + part * (high - low), half = half_low + part * (half_high - half_low);
    const float bow = bow_y - part * 0.9f, x = half + grow, fore = 0.6f * half + grow;
    return std::array<glm::vec3, 4>{glm::vec3(-x, stern_y - grow, z),
                                    {x, stern_y - grow, z},
                                    {fore, bow + grow, z},
                                    {-fore, bow + grow, z}};
  };
  const auto add_walls = [&](float from, float up_to, float grow, const Paint& paint) {
    const auto a = ring(from, grow), b = ring(up_to, grow);
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t j = (i + 1) % 4;
      add_polygon(std::array{a[i], a[j], b[j], b[i]}, paint, to);
    }
  };
  add_walls(0.0f, 1.0f, 0.0f, kCabin);
  if (!is_afar(to)) add_walls(0.4f, 0.8f, 0.012f, kGlass);
  add_polygon(ring(1.0f, 0.0f), kCabin, to);
}

}  // namespace

void add_boat(MeshBuilder& to) {
  to.size = {1.7f, 4.6f, 0.8f};
  to.origin = {0.0f, 0.0f, 0.2f};
  add_hull_skin(kRowingLines, to);
  add_skin(kRowingLines, sections_for(to, {-1.0f, -0.75f, -0.45f, 0.0f, 0.45f, 0.75f, 1.0f}), kWood,
           true, to);
  if (!is_near(to)) return;
  add_gunwale(kRowingLines, stations_for(to), 0.06f, kWood, to);
  for (const float t : {0.2f, 0.45f, 0.7f}) {
    const float half = 0.9f * kRowingLines.half_breadth(t), y = kRowingLines.y(t);
    add_box({-half, y - 0.13f, 0.27f}, {half, y + 0.13f, 0.3f}, kTeak, to);
  }
}

void add_sailboat(MeshBuilder& to) {
  to.size = {2.9f, 9.2f, 14.5f};
  to.origin = {0.0f, 0.0f, 1.74f};
  add_hull_skin(kSailingLines, to);
  // The deck, a little higher in the middle.
  std::vector<glm::vec3> deck;
  const int stations = stations_for(to);
  for (int i = 0; i <= stations; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(stations);
    const glm::vec3 edge = kSailingLines.at(t, 1.0f);
    for (const float side : {-1.0f, 0.0f, 1.0f})
      deck.emplace_back(side * edge.x, edge.y,
                        edge.z + 0.05f * (1.0f - side * side) * edge.x - 0.01f);
  }
  add_sheet(deck, 3, kTeak, to);
  add_cabin(0.8f, 0.62f, -1.2f, 2.3f, 0.93f, 1.42f, to);
  // Keel and rudder.
  add_box({-0.06f, -0.9f, -1.74f}, {0.06f, 0.9f, -0.35f}, kAntifouling, to);
  add_box({-0.03f, -4.4f, -1.2f}, {0.03f, -4.0f, 0.3f}, kAntifouling, to);
  // The rig: the boom is let out to starboard.
  constexpr float kMast_y = 1.1f, kTop = 12.76f;
  add_upright({0.0f, kMast_y}, 0.09f, 0.05f, 0.9f, kTop, kAluminium, to);
  const glm::vec3 tack(0.04f, kMast_y - 0.1f, 2.3f), clew(1.0f, -2.6f, 2.35f);
  const glm::vec3 along = clew - tack, aside(0.06f, 0.0f, 0.0f), up(0.0f, 0.0f, 0.12f);
  for (const auto& [low, high] : {std::pair(aside - up, aside), std::pair(-aside, -aside - up),
                                  std::pair(-aside - up, aside - up)})
    add_polygon(std::array{tack + low, tack + along + low, tack + along + high, tack + high},
                kAluminium, to);
  add_sail(tack, clew, {0.02f, kMast_y - 0.1f, kTop - 0.3f}, 0.35f, to);
  add_sail({0.0f, 4.4f, 1.45f}, {0.85f, 0.6f, 1.75f}, {0.02f, kMast_y + 0.25f, kTop - 1.8f}, 0.3f,
           to);
}

}  // namespace swell::shapes
