#include "shapes/implicit_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "math/stop.h"
#include "scene/height_frames.h"

namespace swell::shapes {
namespace {

constexpr int kSegments = 4;  // along the edge of a cube

// From the implicit surface's axes into its box of size 1.
struct ToBox {
  glm::dvec3 middle, size;
  glm::vec3 operator()(glm::dvec3 p) const { return glm::vec3((p - middle) / size); }
  glm::dvec3 from(glm::vec3 q) const { return middle + size * glm::dvec3(q); }
};

ToBox to_box(const scene::ImplicitSurface& implicit) {
  const glm::dvec3 middle = 0.5 * (implicit.low + implicit.high);
  return {{middle.x, middle.y, implicit.low.z}, implicit.high - implicit.low};
}

// The outermost point of the part on a ray from its inside.
glm::dvec3 outermost(const scene::ImplicitPart& part, glm::dvec3 along) {
  constexpr int kSteps = 96, kHalvings = 30;
  check_stop();
  double reach = 1e300;
  for (int c = 0; c < 3; ++c) {
    const double to = along[c] > 0.0 ? part.high[c] : part.low[c];
    if (std::abs(along[c]) > 1e-12)
      reach = std::min(reach, std::abs(to - part.inside[c]) / std::abs(along[c]));
  }
  double inner = 0.0, outer = reach / kSteps;
  for (int k = kSteps; k >= 1; --k) {
    const double t = reach * k / kSteps;
    if (value(part, part.inside + t * along) < 0.0) continue;
    inner = t, outer = reach * std::min(k + 1, kSteps) / kSteps;
    break;
  }
  for (int k = 0; k < kHalvings; ++k) {
    const double t = 0.5 * (inner + outer);
    (value(part, part.inside + t * along) >= 0.0 ? inner : outer) = t;
  }
  return part.inside + inner * along;
}

// A direction from the middle of a cube, so that edges of boxes and rims of cylinders are kept.
glm::dvec3 direction_of(const scene::ImplicitPart& part, glm::dvec3 on_cube) {
  if (!part.is_box) {
    const double across = std::max(std::abs(on_cube.x), std::abs(on_cube.y));
    const double length = std::sqrt(on_cube.x * on_cube.x + on_cube.y * on_cube.y);
    if (length > 0.0) on_cube.x *= across / length, on_cube.y *= across / length;
  }
  return part.frame * on_cube;
}

void add_face(const scene::ImplicitPart& part, int axis, double side, const ToBox& to_box,
              ObjectMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.position.size());
  for (int j = 0; j <= kSegments; ++j)
    for (int i = 0; i <= kSegments; ++i) {
      glm::dvec3 on_cube;
      on_cube[axis] = side;
      on_cube[(axis + 1) % 3] = side * (2.0 * i / kSegments - 1.0);
      on_cube[(axis + 2) % 3] = 2.0 * j / kSegments - 1.0;
      mesh.position.push_back(to_box(outermost(part, direction_of(part, on_cube))));
    }
  constexpr std::uint32_t kRow = kSegments + 1;
  for (std::uint32_t j = 0; j < kSegments; ++j)
    for (std::uint32_t i = 0; i < kSegments; ++i) {
      const std::uint32_t a = first + j * kRow + i;
      for (const std::uint32_t corner : {a, a + 1, a + kRow + 1, a, a + kRow + 1, a + kRow})
        mesh.indices.push_back(corner);
    }
}

// A sheet: where lines along the thinnest side of its box enter it, and where they leave it last.
// Its rim is lost up to a cell.
void add_sheet(const scene::ImplicitPart& part, const ToBox& to_box, ObjectMesh& mesh) {
  constexpr int kSide = 14, kSteps = 160;
  constexpr std::uint32_t kNone = ~0u;
  const glm::dvec3 size = part.high - part.low;
  const int through = size.x < size.y ? (size.x < size.z ? 0 : 2) : (size.y < size.z ? 1 : 2);
  const int across = (through + 1) % 3, along = (through + 2) % 3;
  std::array<std::uint32_t, (kSide + 1) * (kSide + 1)> found;
  for (std::size_t i = 0; i < found.size(); ++i) {
    check_stop();
    glm::dvec3 p;
    p[across] = part.low[across] + size[across] * static_cast<double>(i % (kSide + 1)) / kSide;
    p[along] = part.low[along] + size[along] * static_cast<double>(i / (kSide + 1)) / kSide;
    glm::dvec3 first(1e300), last(0.0);
    for (int k = 0; k <= kSteps; ++k) {
      p[through] = part.low[through] + size[through] * k / kSteps;
      if (value(part, p) < 0.0) continue;
      if (first.x == 1e300) first = p;
      last = p;
    }
    found[i] = first.x == 1e300 ? kNone : static_cast<std::uint32_t>(mesh.position.size());
    if (found[i] == kNone) continue;
    mesh.position.push_back(to_box(first));
    mesh.position.push_back(to_box(last));
  }
  for (std::size_t j = 0; j < kSide; ++j)
    for (std::size_t i = 0; i < kSide; ++i) {
      const std::size_t at = j * (kSide + 1) + i;
      const std::array<std::uint32_t, 4> corner = {found[at], found[at + 1], found[at + kSide + 2],
                                                   found[at + kSide + 1]};
      if (std::ranges::find(corner, kNone) != corner.end()) continue;
      for (const std::uint32_t side : {0u, 1u})
        for (const std::size_t k : {0u, 1u, 2u, 0u, 2u, 3u})
          mesh.indices.push_back(corner[k] + side);
    }
}

// The first and the last point of a part on a way, each to a thousandth of a step; none: it has
// none on any of the way's steps.
struct Span {
  bool any = false;
  glm::dvec3 first{0.0}, last{0.0};
};

Span span_on(const scene::ImplicitPart& part, glm::dvec3 begin, glm::dvec3 way) {
  constexpr int kSteps = 96, kHalvings = 10;
  const auto inside = [&](double s) { return value(part, begin + s * way) >= 0.0; };
  const auto border = [&](double in, double out) {
    for (int k = 0; k < kHalvings; ++k) {
      const double s = 0.5 * (in + out);
      (inside(s) ? in : out) = s;
    }
    return begin + in * way;
  };
  int first = 0, last = kSteps;
  while (first <= kSteps && !inside(static_cast<double>(first) / kSteps)) ++first;
  if (first > kSteps) return {};
  while (!inside(static_cast<double>(last) / kSteps)) --last;
  return {true, border(static_cast<double>(first) / kSteps, (first - 1.0) / kSteps),
          border(static_cast<double>(last) / kSteps, (last + 1.0) / kSteps)};
}

// The points of a lattice over a table of heights, row by row: the number of the first of two
// vertices, where a column along the base plane's normal enters the part and leaves it last.
constexpr int kColumns = 17;
constexpr std::uint32_t kNoColumn = ~0u;
using Columns = std::array<std::uint32_t, kColumns * kColumns>;

Columns add_columns(const scene::ImplicitPart& part, const ToBox& to_box, ObjectMesh& mesh) {
  const scene::HeightTable& table = *part.table;
  const glm::dmat3 from_table = glm::inverse(table.linear);
  double low = 1e300, high = -1e300;
  for (int i = 0; i < 8; ++i) {
    const glm::bvec3 upper((i & 1) != 0, (i & 2) != 0, (i & 4) != 0);
    const double z = table(glm::mix(part.low, part.high, upper)).z;
    low = std::min(low, z), high = std::max(high, z);
  }
  const glm::dvec2 last_post(table.heights->columns - 1, table.heights->rows - 1);
  Columns columns;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const glm::dvec2 place(static_cast<double>(i % kColumns), static_cast<double>(i / kColumns));
    // A hair inside of the borders.
    const glm::dvec2 at = glm::clamp(place / (kColumns - 1.0), 1e-6, 1.0 - 1e-6) * last_post;
    const glm::dvec3 foot = from_table * (glm::dvec3(at, low) - table.offset);
    const Span span = span_on(part, foot, from_table[2] * (high - low));
    columns[i] = span.any ? static_cast<std::uint32_t>(mesh.position.size()) : kNoColumn;
    if (!span.any) continue;
    mesh.position.push_back(to_box(span.first));
    mesh.position.push_back(to_box(span.last));
  }
  return columns;
}

// The columns at the corners of cell (i, j), around it; none: not all of them are there.
std::optional<std::array<std::uint32_t, 4>> cell_of(const Columns& columns, int i, int j) {
  constexpr int kCells = kColumns - 1;
  if (i < 0 || j < 0 || i >= kCells || j >= kCells) return std::nullopt;
  const auto at = static_cast<std::size_t>(j * kColumns + i);
  const std::array cell = {columns[at], columns[at + 1], columns[at + kColumns + 1],
                           columns[at + kColumns]};
  if (std::ranges::find(cell, kNoColumn) != cell.end()) return std::nullopt;
  return cell;
}

// What lies under a table of heights, with walls where it ends. A border by the threshold is lost
// up to a cell.
void add_block(const scene::ImplicitPart& part, const ToBox& to_box, ObjectMesh& mesh) {
  const Columns columns = add_columns(part, to_box, mesh);
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    for (const std::uint32_t corner : {a, b, c, a, c, d}) mesh.indices.push_back(corner);
  };
  constexpr std::array<glm::ivec2, 4> kBeside = {{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
  for (int j = 0; j + 1 < kColumns; ++j)
    for (int i = 0; i + 1 < kColumns; ++i) {
      const auto cell = cell_of(columns, i, j);
      if (!cell) continue;
      const auto& [a, b, c, d] = *cell;
      for (const std::uint32_t side : {0u, 1u}) add(a + side, b + side, c + side, d + side);
      for (std::size_t k = 0; k < 4; ++k) {
        if (cell_of(columns, i + kBeside[k].x, j + kBeside[k].y)) continue;
        const std::uint32_t from = (*cell)[k], to = (*cell)[(k + 1) % 4];
        add(from, to, to + 1, from + 1);
      }
    }
}

// The heights of a table's stand-in at a time: a little lower at a vertex than they are wherever a
// cell beside it, with straight sides, would lie over them, so that they do not shade themselves.
class StandInHeights {
 public:
  StandInHeights(const scene::HeightTable& table, double t_s)
      : frames_(scene::frames_at(table, t_s)),
        half_cell_(glm::dvec2(table.heights->columns - 1, table.heights->rows - 1) /
                   (2.0 * (kColumns - 1))) {}

  double at(glm::dvec2 place) const {
    double over = 0.0;
    for (const double y : {-1.0, 1.0})
      for (const double x : {-1.0, 1.0}) {
        const glm::dvec2 middle = place + glm::dvec2(x, y) * half_cell_;
        double mean = 0.0;
        for (const double v : {-1.0, 1.0})
          for (const double u : {-1.0, 1.0})
            mean += 0.25 * height(middle + glm::dvec2(u, v) * half_cell_);
        over = std::max(over, mean - height(middle));
      }
    return height(place) - over;
  }

  double height(glm::dvec2 place) const {
    const double now = terrain::height_at(*frames_.now, place);
    if (frames_.share == 0.0) return now;
    return std::lerp(now, terrain::height_at(*frames_.next, place), frames_.share);
  }

 private:
  scene::FramesAt frames_;
  glm::dvec2 half_cell_;
};

// Moves those vertices that lie on the part's heights, as the first frame has them,
// to where the stand-in has them at a time.
void move_heights(const scene::ImplicitPart& part, double t_s, const ToBox& box,
                  std::span<glm::vec3> position) {
  const scene::HeightTable& table = *part.table;
  const StandInHeights heights(table, t_s);
  const glm::dvec3 up = glm::inverse(table.linear)[2];
  for (glm::vec3& q : position) {
    const glm::dvec3 p = box.from(q), at = table(p);
    constexpr double kOnIt_m = 0.01;
    const double before = terrain::height_at(table.heights->frames[0], glm::dvec2(at));
    if (std::abs(before - at.z) < kOnIt_m) q = box(p + up * (heights.at(glm::dvec2(at)) - at.z));
  }
}

bool heights_move(const scene::ImplicitPart& part) {
  return part.table && part.table->loop_s > 0.0 && part.table->heights->frames.size() > 1;
}

ObjectTriangle paint_of(const scene::ImplicitPart& part) {
  ObjectTriangle triangle;
  triangle.normal_at_origin = triangle.flat_normal = {0.0f, 0.0f, 1.0f};
  triangle.tint = part.colour;
  triangle.roughness = part.roughness, triangle.metalness = part.metalness;
  triangle.translucency = part.translucency;
  triangle.painted = part.painted;
  return triangle;
}

// Returns MeshPart::top, a height in the box: what stands on a hull hides little of the sky.
float hull_top(const scene::ImplicitSurface& implicit, const scene::ImplicitPart& part) {
  constexpr double kOfBreadth = 0.4;
  const double breadth_m = std::min(part.high.x - part.low.x, part.high.y - part.low.y);
  const double top_m = std::min(part.high.z, kOfBreadth * breadth_m);
  return static_cast<float>(
      std::clamp((top_m - implicit.low.z) / (implicit.high.z - implicit.low.z), 0.0, 1.0));
}

ObjectMesh stand_in(const scene::ImplicitSurface& implicit, const ToBox& to_box,
                    std::vector<DrawnImplicit::MovingVertices>& moving) {
  ObjectMesh mesh;
  for (std::size_t n = 0; n < implicit.parts.size(); ++n) {
    const scene::ImplicitPart& part = implicit.parts[n];
    const std::size_t first = mesh.position.size();
    MeshPart piece{.first_triangle = static_cast<std::uint32_t>(mesh.triangles.size())};
    if (part.table) {
      add_block(part, to_box, mesh);
      if (!heights_move(part))
        move_heights(part, 0.0, to_box, std::span(mesh.position).subspan(first));
    } else if (part.is_hollow) {
      add_sheet(part, to_box, mesh);
    } else {
      for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) add_face(part, axis, side, to_box, mesh);
    }
    mesh.triangles.resize(mesh.indices.size() / 3, paint_of(part));
    piece.triangles = static_cast<std::uint32_t>(mesh.triangles.size()) - piece.first_triangle;
    if (part.turns_per_s == 0.0)
      set_waterline(mesh, static_cast<float>(-implicit.low.z / (implicit.high.z - implicit.low.z)),
                    piece);
    piece.top = hull_top(implicit, part);
    mesh.parts.push_back(piece);
    if (part.turns_per_s != 0.0 || heights_move(part))
      moving.push_back({static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(first),
                        static_cast<std::uint32_t>(mesh.position.size() - first)});
  }
  return mesh;
}

ObjectMesh drawn_mesh(const scene::ImplicitSurface& implicit) {
  ObjectMesh mesh;
  for (const float z : {0.0f, 1.0f})
    for (const float y : {-0.5f, 0.5f})
      for (const float x : {-0.5f, 0.5f}) mesh.position.push_back({x, y, z});
  for (const scene::ImplicitPart& part : implicit.parts) mesh.triangles.push_back(paint_of(part));
  mesh.indices.resize(3 * implicit.parts.size(), 0);
  return mesh;
}

}  // namespace

MeshOfFile with_meshes(scene::ImplicitSurface implicit) {
  MeshOfFile result;
  result.low = implicit.low, result.high = implicit.high;
  std::vector<DrawnImplicit::MovingVertices> moving;
  result.levels.push_back(stand_in(implicit, to_box(implicit), moving));
  ObjectMesh drawn = drawn_mesh(implicit);
  result.implicit = std::make_shared<const DrawnImplicit>(std::move(implicit), std::move(drawn),
                                                          std::move(moving));
  return result;
}

void pose_stand_in(const MeshOfFile& shape, double t_s, ObjectMesh& posed) {
  const ObjectMesh& still = shape.levels.front();
  posed.position = still.position, posed.indices = still.indices, posed.parts = still.parts;
  posed.triangles.resize(still.triangles.size());
  posed.error = still.error;
  const scene::ImplicitSurface& implicit = shape.implicit->implicit;
  const ToBox box = to_box(implicit);
  for (const DrawnImplicit::MovingVertices& vertices : shape.implicit->moving) {
    const scene::ImplicitPart& part = implicit.parts[vertices.part];
    const auto position = std::span(posed.position).subspan(vertices.first, vertices.count);
    if (heights_move(part)) move_heights(part, t_s, box, position);
    if (part.turns_per_s == 0.0) continue;
    const glm::dmat3 turn = scene::turn_about(part.axis, part.turns_per_s * t_s);
    for (glm::vec3& q : position) q = box(part.hub + turn * (box.from(q) - part.hub));
  }
}

}  // namespace swell::shapes
