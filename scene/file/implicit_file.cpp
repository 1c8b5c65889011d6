#include "scene/file/implicit_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>

#include "math/elementary.h"
#include "scene/file/height_table_file.h"
#include "scene/file/parameters.h"
#include "scene/file/spelling.h"
#include "scene/file/toml_limits.h"
#include "scene/height_frames.h"
#include "scene/scene_error.h"
#include "texture/square_frames.h"

namespace swell::scene {
namespace {

// p_to = linear p_from + offset.
struct Affine {
  glm::dmat3 linear{1.0};
  glm::dvec3 offset{0.0};
};

Quadric transformed(const Quadric& f, const Affine& from_new) {
  const glm::dmat3 a(f.xx, f.xy, f.xz, f.xy, f.yy, f.yz, f.xz, f.yz, f.zz);
  const glm::dmat3 t = from_new.linear, at = glm::transpose(t) * a * t;
  Quadric result;
  result.xx = at[0][0], result.yy = at[1][1], result.zz = at[2][2];
  result.xy = at[1][0], result.xz = at[2][0], result.yz = at[2][1];
  result.b = glm::transpose(t) * (f.times(from_new.offset) + f.b);
  result.c = f(from_new.offset);
  return result;
}

glm::dmat3 turned(const glm::dvec3& axis, double radians) {
  const double c = cos(radians), s = sin(radians);
  glm::dmat3 m;
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 e(0.0);
    e[i] = 1.0;
    m[i] = c * e + s * glm::cross(axis, e) + (1.0 - c) * glm::dot(axis, e) * axis;
  }
  return m;
}

// The surfaces of a shape in a box from -1 to 1; the first is the one that perturbations change.
// A cylinder, a cone and a paraboloid stand along z.
std::vector<Quadric> surfaces_of(std::string_view shape, double top) {
  const auto slab = [](glm::dvec3 axis) {
    return Quadric{.xx = -axis.x, .yy = -axis.y, .zz = -axis.z, .c = 1.0};
  };
  const Quadric ends = slab({0, 0, 1});
  if (shape == "ellipsoid") return {slab({1, 1, 1})};
  if (shape == "cylinder") return {slab({1, 1, 0}), ends};
  if (shape == "box") return {slab({1, 0, 0}), slab({0, 1, 0}), ends};
  if (shape == "plane") return {{.b = {0, 0, -0.5}}};
  if (shape == "paraboloid") return {{.xx = -1, .yy = -1, .b = {0, 0, -0.25}, .c = 0.5}, ends};
  // The radius is (1 + top) / 2 - z (1 - top) / 2.
  const double mean = 0.5 * (1.0 + top), fall = 0.5 * (1.0 - top);
  return {{.xx = -1, .yy = -1, .zz = fall * fall, .b = {0, 0, -mean * fall}, .c = mean * mean},
          ends};
}

constexpr std::array<std::string_view, 7> kShapes = {
    "ellipsoid", "cylinder", "cone", "paraboloid", "box", "plane", "quadric"};
constexpr std::array<std::string_view, 6> kAxes = {"x", "y", "z", "-x", "-y", "-z"};
constexpr std::array<std::string_view, 7> kShapeKeys = {"shape", "at",  "size",   "turn_deg",
                                                        "axis",  "top", "quadric"};
constexpr std::array<std::string_view, 16> kPartKeys = {
    "name",    "bend",         "keep",   "cut",    "heights", "colour", "roughness", "metalness",
    "painted", "translucency", "mirror", "copies", "repeat",  "hub",    "spin_axis", "spin_rpm"};
constexpr std::array<std::string_view, 7> kHeightKeys = {
    "image", "low_m", "high_m", "threshold_m", "interpolation", "frames", "loop_s"};
constexpr std::array<std::string_view, 2> kInterpolations = {"bilinear", "bicubic"};

class ImplicitReader {
 public:
  explicit ImplicitReader(const std::string& file) : file_(file) {}

  ImplicitSurface read(const toml::table& root) {
    const toml::node* const node = root.get("form");
    const toml::array* const tables = node ? node->as_array() : nullptr;
    if (!tables || tables->empty() || tables->size() > kMostImplicitParts)
      fail(node ? *node : root, "form",
           tables ? fmt::format("{} tables", tables->size()) : std::string("none"),
           fmt::format("1 to {} tables [[form]]", kMostImplicitParts));
    ImplicitSurface implicit;
    for (std::size_t n = 0; n < tables->size(); ++n) {
      path_ = fmt::format("form[{}]", n);
      const toml::node& element = *tables->get(n);
      if (!element.is_table()) fail(element, path_, "no table", "a table");
      const std::size_t first = implicit.parts.size();
      add_part(*element.as_table(), implicit);
      check_boxes(element, implicit, first);
    }
    find_boxes(implicit);
    return implicit;
  }

 private:
  // Checks the number of parts, and finds the box of the first that a table gave, so that a message
  // names the table.
  void check_boxes(const toml::node& node, ImplicitSurface& implicit, std::size_t first) const {
    if (implicit.parts.size() > kMostImplicitParts)
      fail(node, path_, fmt::format("{} parts with their copies", implicit.parts.size()),
           fmt::format("at most {} parts", kMostImplicitParts));
    try {
      find_box(implicit.parts[first]);
    } catch (const std::runtime_error& error) {
      fail(node, path_, error.what(), "a shape with an inside and an end");
    }
  }

  void add_part(const toml::table& table, ImplicitSurface& implicit) {
    check_keys(table, true);
    ImplicitPart part;
    part.frame = frame_of(table);
    if (table.get("heights"))
      add_heights(table, part, implicit);
    else
      for (const Quadric& quadric : quadrics_of(table)) part.terms.push_back({quadric, {}});
    part.is_box = word(table, "shape", kShapes, "ellipsoid") == "box";
    for (const toml::table* bend : tables_of(table, "bend", kMostPerturbations)) {
      const double factor = number(*bend, "factor", 1.0, -1e3, 1e3);
      part.terms[0].perturbations.push_back({quadrics_of(*bend)[0], factor});
    }
    for (const toml::table* keep : tables_of(table, "keep", kMostTerms))
      for (const Quadric& quadric : quadrics_of(*keep)) part.terms.push_back({quadric, {}});
    for (const toml::table* cut : tables_of(table, "cut", kMostTerms))
      part.terms.push_back({negative(quadrics_of(*cut)[0]), {}});
    if (part.terms.size() > kMostTerms)
      fail(table, path_, fmt::format("{} surfaces", part.terms.size()),
           fmt::format("at most {} surfaces a part", kMostTerms));
    read_paint(table, part);
    part.hub = vector(table, "hub", glm::dvec3(0.0), -1000, 1000);
    part.axis = vector(table, "spin_axis", {0, 1, 0}, -1, 1);
    const double length = glm::length(part.axis);
    if (!(length > 1e-3)) fail(table, path_ + ".spin_axis", "no direction", "a direction");
    part.axis /= length;
    part.turns_per_s = number(table, "spin_rpm", 0.0, -1e5, 1e5) / 60.0;
    add_copies(table, part, implicit);
  }

  // The walls of what lies under a table, and the table: in a box of the part's size, from the
  // middle of a plane, or the top of a box, upwards.
  void add_heights(const toml::table& table, ImplicitPart& part, ImplicitSurface& implicit) {
    const toml::node& node = *table.get("heights");
    const std::string shape = word(table, "shape", kShapes, "ellipsoid");
    if (shape != "box" && shape != "plane")
      fail(node, path_ + ".heights", fmt::format("them on a shape \"{}\"", shape),
           "a plane's or a box's");
    if (table.get("bend")) fail(node, path_ + ".heights", "them besides bend", "one of them");
    if (!node.is_table()) fail(node, path_ + ".heights", "no table", "a table");
    part.table = height_table(*node.as_table(), implicit);
    const HeightFrames& heights = *part.table->heights;
    const Affine own = to_own_axes(table);
    const double base = shape == "box" ? 1.0 : 0.0, half_m = glm::length(part.frame[2]);
    const glm::dvec3 posts(0.5 * (heights.columns - 1), 0.5 * (heights.rows - 1), half_m);
    for (int i = 0; i < 3; ++i) part.table->linear[i] = posts * own.linear[i];
    part.table->offset = posts * (own.offset + glm::dvec3(1.0, 1.0, -base));
    // Nothing is over the highest post: a wall there shortens the rays' ways.
    const double top = base + heights.highest_m / half_m;
    const double most = std::max(top, -1.0) + 1e-3 * (std::abs(top) + 1.0);
    const Quadric ends = {.zz = -1.0, .b = {0.0, 0.0, 0.5 * (most - 1.0)}, .c = most};
    for (const Quadric& side : {Quadric{.xx = -1.0, .c = 1.0}, Quadric{.yy = -1.0, .c = 1.0}, ends})
      part.terms.push_back({transformed(side, own), {}});
  }

  HeightTable height_table(const toml::table& keys, ImplicitSurface& implicit) {
    const std::string part_path = path_;
    path_ += ".heights";
    refuse_unknown(keys, kHeightKeys);
    const toml::node* const image = keys.get("image");
    HeightPictures pictures;
    pictures.path = image ? image->value_or(std::string()) : std::string();
    if (pictures.path.empty())
      fail(image ? *image : keys, path_ + ".image", "no file", "a picture's");
    pictures.frames = whole_number(keys, "frames", 1, kMostTableFrames);
    if (pictures.frames > 1 && pictures.path.find(texture::kFrameNumber) == std::string::npos)
      fail(*image, path_ + ".image", fmt::format("\"{}\"", shortened(pictures.path)),
           fmt::format("a path with {} for the frame", texture::kFrameNumber));
    pictures.path =
        (std::filesystem::path(file_).parent_path() / pictures.path).lexically_normal().string();
    pictures.low_m = number(keys, "low_m", 0.0, -kMostTableHeight_m, kMostTableHeight_m);
    pictures.high_m = number(keys, "high_m", 1.0, -kMostTableHeight_m, kMostTableHeight_m);
    pictures.bicubic = word(keys, "interpolation", kInterpolations, "bilinear") == "bicubic";
    HeightTable table;
    table.loop_s = number(keys, "loop_s", pictures.frames > 1 ? 4.0 : 0.0, 0.0, 3600.0);
    table.threshold_m =
        number(keys, "threshold_m", table.threshold_m, -kMostTableHeight_m, kMostTableHeight_m);
    try {
      table.heights = read_heights(pictures);
    } catch (const std::runtime_error& error) {
      fail_in(*image, path_ + ".image", one_line(error.what()));
    }
    std::ranges::copy(paths_of(pictures), std::back_inserter(implicit.pictures));
    path_ = part_path;
    return table;
  }

  void read_paint(const toml::table& table, ImplicitPart& part) const {
    part.colour = glm::vec3(vector(table, "colour", glm::dvec3(0.6), 0, 1));
    part.roughness = static_cast<float>(number(table, "roughness", 0.42, 0.05, 1));
    part.metalness = static_cast<float>(number(table, "metalness", 0, 0, 1));
    part.translucency = static_cast<float>(number(table, "translucency", 0, 0, 1));
    part.painted = boolean(table, "painted");
  }

  // Turned round the hub, then set in a row, then mirrored.
  void add_copies(const toml::table& table, const ImplicitPart& part,
                  ImplicitSurface& implicit) const {
    const std::size_t first = implicit.parts.size();
    const int copies = static_cast<int>(number(table, "copies", 1, 1, 64));
    for (int k = 0; k < copies; ++k) {
      // A point of the copy is the part's when it is turned back.
      const glm::dmat3 back = turned(part.axis, -2.0 * kPi * k / copies);
      implicit.parts.push_back(moved(part, {back, part.hub - back * part.hub}));
    }
    if (table.get("repeat")) add_row(table, first, implicit);
    if (!boolean(table, "mirror")) return;
    const std::size_t last = implicit.parts.size();
    const glm::dmat3 mirror(-1, 0, 0, 0, 1, 0, 0, 0, 1);
    for (std::size_t i = first; i < last; ++i) {
      ImplicitPart other = moved(implicit.parts[i], {mirror, {}});
      other.hub.x = -other.hub.x, other.axis.x = -other.axis.x;
      other.turns_per_s = -other.turns_per_s;
      implicit.parts.push_back(std::move(other));
    }
  }

  // repeat = [how often, shift right, ahead, up]
  void add_row(const toml::table& table, std::size_t first, ImplicitSurface& implicit) const {
    const std::vector<double> row = numbers(table, "repeat", 4, -1000, 1000);
    if (!(row[0] >= 1.0 && row[0] <= 64.0))
      fail(*table.get("repeat"), path_ + ".repeat", fmt::format("{} times", row[0]), "1 to 64");
    const std::size_t last = implicit.parts.size();
    for (int k = 1; k < static_cast<int>(row[0]); ++k)
      for (std::size_t i = first; i < last; ++i) {
        const glm::dvec3 shift = static_cast<double>(k) * glm::dvec3(row[1], row[2], row[3]);
        ImplicitPart other = moved(implicit.parts[i], {glm::dmat3(1.0), -shift});
        other.hub += shift;
        implicit.parts.push_back(std::move(other));
      }
  }

  // from_new does not stretch.
  static ImplicitPart moved(ImplicitPart part, const Affine& from_new) {
    part.frame = glm::transpose(from_new.linear) * part.frame;
    for (ImplicitTerm& term : part.terms) {
      term.quadric = transformed(term.quadric, from_new);
      for (Perturbation& r : term.perturbations) r.quadric = transformed(r.quadric, from_new);
    }
    if (part.table) {
      part.table->offset += part.table->linear * from_new.offset;
      part.table->linear = part.table->linear * from_new.linear;
    }
    return part;
  }

  static Quadric negative(Quadric f) {
    f.xx = -f.xx, f.yy = -f.yy, f.zz = -f.zz, f.xy = -f.xy, f.xz = -f.xz, f.yz = -f.yz;
    f.b = -f.b, f.c = -f.c;
    return f;
  }

  // A shape's surfaces, where the table puts it.
  std::vector<Quadric> quadrics_of(const toml::table& table) const {
    const std::string shape = word(table, "shape", kShapes, "ellipsoid");
    std::vector<Quadric> quadrics = shape == "quadric"
                                        ? std::vector<Quadric>{given_quadric(table)}
                                        : surfaces_of(shape, number(table, "top", 0, 0, 10));
    const Affine own = to_own_axes(table);
    for (Quadric& quadric : quadrics) quadric = transformed(quadric, own);
    return quadrics;
  }

  // Into a shape's own axes, in which it fills a box from -1 to 1.
  Affine to_own_axes(const toml::table& table) const {
    const glm::dmat3 linear = glm::inverse(frame_of(table));
    const glm::dvec3 at = vector(table, "at", glm::dvec3(0.0), -1000, 1000);
    return {linear, -(linear * at)};
  }

  // The half axes of a shape's box, in the order of the shape's own axes.
  glm::dmat3 frame_of(const toml::table& table) const {
    const glm::dvec3 half = 0.5 * vector(table, "size", glm::dvec3(2.0), 1e-4, 2000);
    const glm::dvec3 turn = vector(table, "turn_deg", glm::dvec3(0.0), -360, 360) * (kPi / 180.0);
    const glm::dmat3 rotation =
        turned({0, 0, 1}, turn.z) * turned({0, 1, 0}, turn.y) * turned({1, 0, 0}, turn.x);
    glm::dmat3 frame = axes(table);
    for (int i = 0; i < 3; ++i) frame[i] = rotation * (frame[i] * half);
    return frame;
  }

  // The shape's own axes in those of its box.
  glm::dmat3 axes(const toml::table& table) const {
    const std::string axis = word(table, "axis", kAxes, "z");
    const double sign = axis[0] == '-' ? -1.0 : 1.0;
    const int up = axis.back() - 'x';
    glm::dmat3 m(0.0);
    m[0][(up + 1) % 3] = sign, m[1][(up + 2) % 3] = 1.0, m[2][up] = sign;
    return m;
  }

  Quadric given_quadric(const toml::table& table) const {
    const std::vector<double> a = numbers(table, "quadric", 10, -1e6, 1e6);
    return {.xx = a[0],
            .yy = a[1],
            .zz = a[2],
            .xy = 0.5 * a[3],
            .xz = 0.5 * a[4],
            .yz = 0.5 * a[5],
            .b = {0.5 * a[6], 0.5 * a[7], 0.5 * a[8]},
            .c = a[9]};
  }

  // --- Values

  void check_keys(const toml::table& table, bool is_part) const {
    std::vector<std::string_view> known(kShapeKeys.begin(), kShapeKeys.end());
    if (is_part)
      known.insert(known.end(), kPartKeys.begin(), kPartKeys.end());
    else
      known.push_back("factor");
    refuse_unknown(table, known);
  }

  void refuse_unknown(const toml::table& table, std::span<const std::string_view> known) const {
    for (const auto& [key, node] : table)
      if (std::ranges::find(known, key.str()) == known.end())
        fail(node, "unknown key",
             fmt::format("'{}.{}'{}", path_, shortened(key.str(), 100),
                         did_you_mean(key.str(), known)),
             fmt::format("{}", fmt::join(known, ", ")));
  }

  std::vector<const toml::table*> tables_of(const toml::table& table, std::string_view key,
                                            std::size_t most) const {
    std::vector<const toml::table*> result;
    const toml::node* const node = table.get(key);
    if (!node) return result;
    const std::string path = fmt::format("{}.{}", path_, key);
    const std::string allowed = fmt::format("an array of at most {} tables", most);
    const toml::array* const array = node->as_array();
    if (!array) fail(*node, path, "no array", allowed);
    if (array->size() > most) fail(*node, path, fmt::format("{} values", array->size()), allowed);
    for (const toml::node& element : *array) {
      if (!element.is_table()) fail(element, path, "no table", allowed);
      check_keys(*element.as_table(), false);
      result.push_back(element.as_table());
    }
    return result;
  }

  double checked(const toml::node& node, std::string_view key, double low, double high) const {
    const std::optional<double> number =
        node.is_number() ? node.value<double>() : std::optional<double>();
    if (!number || !(*number >= low && *number <= high))
      fail(node, fmt::format("{}.{}", path_, key),
           number ? fmt::format("{}", *number) : std::string("no number"),
           fmt::format("{} to {}", low, high));
    return *number;
  }

  double number(const toml::table& table, std::string_view key, double otherwise, double low,
                double high) const {
    const toml::node* const node = table.get(key);
    return node ? checked(*node, key, low, high) : otherwise;
  }

  int whole_number(const toml::table& table, std::string_view key, int otherwise, int most) const {
    const double value = number(table, key, otherwise, 1, most);
    if (value != std::floor(value))
      fail(*table.get(key), fmt::format("{}.{}", path_, key), fmt::format("{}", value),
           "a whole number");
    return static_cast<int>(value);
  }

  std::vector<double> numbers(const toml::table& table, std::string_view key, std::size_t count,
                              double low, double high) const {
    const toml::node* const node = table.get(key);
    const toml::array* const array = node ? node->as_array() : nullptr;
    if (!array || array->size() != count)
      fail(node ? *node : table, fmt::format("{}.{}", path_, key),
           array ? fmt::format("{} values", array->size()) : std::string("no array"),
           fmt::format("[{} numbers]", count));
    std::vector<double> result;
    for (const toml::node& element : *array) result.push_back(checked(element, key, low, high));
    return result;
  }

  glm::dvec3 vector(const toml::table& table, std::string_view key, glm::dvec3 otherwise,
                    double low, double high) const {
    if (!table.get(key)) return otherwise;
    const std::vector<double> v = numbers(table, key, 3, low, high);
    return {v[0], v[1], v[2]};
  }

  bool boolean(const toml::table& table, std::string_view key) const {
    const toml::node* const node = table.get(key);
    if (!node) return false;
    if (!node->is_boolean())
      fail(*node, fmt::format("{}.{}", path_, key), "no boolean", "true or false");
    return node->as_boolean()->get();
  }

  template <std::size_t kCount>
  std::string word(const toml::table& table, std::string_view key,
                   const std::array<std::string_view, kCount>& words,
                   std::string_view otherwise) const {
    const toml::node* const node = table.get(key);
    const std::string text(node ? node->value_or(std::string_view()) : otherwise);
    if (std::ranges::find(words, text) == words.end())
      fail(*node, fmt::format("{}.{}", path_, key), fmt::format("\"{}\"", shortened(text)),
           fmt::format("\"{}\"", fmt::join(words, "\", \"")));
    return text;
  }

  [[noreturn]] void fail(const toml::node& node, std::string_view what, const std::string& got,
                         const std::string& allowed) const {
    fail_in(node, what, fmt::format("got {}, allowed {}", got, allowed));
  }

  // With a fault that says what is allowed.
  [[noreturn]] void fail_in(const toml::node& node, std::string_view what,
                            const std::string& fault) const {
    const toml::source_position at = node.source().begin;
    throw SceneError(
        fmt::format("{}:{}: column {}: {}, {}", file_, at.line, at.column, what, fault));
  }

  std::string file_;
  std::string path_ = "form";
};

}  // namespace

ImplicitSurface parse_implicit(std::string_view text, const std::string& file_name) {
  const auto refuse = [&](const std::string& got, const std::string& allowed) {
    throw SceneError(fmt::format("{}: form file, got {}, allowed {}", file_name, got, allowed));
  };
  if (text.size() > kMostImplicitBytes)
    refuse(fmt::format("more than {} bytes", kMostImplicitBytes), "that many");
  if (find_deep_nesting(text) != 0)
    refuse("nesting too deep to be a form", fmt::format("{} levels", kMaxNesting));
  toml::table root;
  try {
    root = toml::parse(text, file_name);
  } catch (const toml::parse_error& error) {
    throw SceneError(fmt::format("{}:{}: column {}: syntax error, got '{}', allowed TOML 1.0",
                                 file_name, error.source().begin.line, error.source().begin.column,
                                 one_line(shortened(error.description()))));
  }
  return ImplicitReader(file_name).read(root);
}

ImplicitSurface load_implicit(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(kMostImplicitBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad() || !file.is_open())
    throw SceneError(
        fmt::format("{}: form file, got one that cannot be opened, allowed a readable "
                    "TOML file",
                    path));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return parse_implicit(text, path);
}

}  // namespace swell::scene
