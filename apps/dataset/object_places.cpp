#include "apps/dataset/object_places.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "render/view/render_view.h"
#include "render/world/world_state.h"
#include "scene/settings.h"
#include "terrain/height_grid.h"

namespace swell::apps {
namespace {

constexpr double kMiddleShare = 0.95;  // of the picture's width that objects stand in
constexpr double kClearWater_m = 0.3;  // under what floats

// A circle on the map that something takes.
struct Circle {
  glm::dvec2 middle_m;
  double radius_m;
};

Circle circle_of(const scene::FloatingObject& object, double t_s) {
  return {scene::plan_pose(object, t_s).position_m,
          0.5 * std::hypot(object.size_m.x, object.size_m.y)};
}

bool has_heading(const std::string& setting) { return setting.starts_with("heading_deg="); }

// Which way the camera looks on the map. One that looks straight down has its upper edge there.
glm::dvec2 ahead_of(const View& view) {
  const glm::dvec2 ahead(view.forward), above(view.up);
  return glm::normalize(glm::length(ahead) > 0.1 ? ahead : above);
}

class Placer {
 public:
  Placer(const scene::Recipe& recipe, int sample, const render::World& world, const View& view,
         double t_s)
      : recipe_(recipe), sample_(static_cast<std::uint64_t>(sample)), world_(world), view_(view) {
    for (const scene::FloatingObject& object : world.scene().objects)
      taken_.push_back(circle_of(object, t_s));
  }

  std::vector<std::string> place() {
    for (std::size_t k = 0; k < recipe_.objects.size(); ++k) {
      const scene::RecipeObjects& objects = recipe_.objects[k];
      const scene::FloatingObject object = one_of(objects);
      const int span = objects.most - objects.fewest + 1;
      const int number =
          objects.fewest + static_cast<int>(draw(fmt::format("objects[{}].number", k)) * span);
      for (int i = 0; i < number; ++i)
        place_one(objects, object, fmt::format("objects[{}][{}]", k, i));
    }
    return std::move(settings_);
  }

 private:
  double draw(const std::string& name) const {
    return scene::draw_number(recipe_.seed, name, sample_);
  }

  // The object as the scene has it.
  scene::FloatingObject one_of(const scene::RecipeObjects& objects) const {
    const auto settings = scene::object_settings(objects, own_, {});
    return scene::load_scene(recipe_.scene, settings).objects.at(own_);
  }

  void place_one(const scene::RecipeObjects& objects, const scene::FloatingObject& object,
                 const std::string& name) {
    for (int attempt = 0; attempt < kMostPlaces; ++attempt) {
      const std::string try_name = fmt::format("{}.place[{}]", name, attempt);
      const double distance_m = objects.nearest_m + draw(try_name + ".distance") *
                                                        (objects.farthest_m - objects.nearest_m);
      const double aside = view_.tan_middle_x + kMiddleShare * view_.tan_half_x *
                                                    (2.0 * draw(try_name + ".aside") - 1.0);
      const glm::dvec2 ahead = ahead_of(view_), right(ahead.y, -ahead.x);
      const glm::dvec2 place =
          glm::dvec2(view_.eye_world) + distance_m * glm::normalize(ahead + aside * right);
      Circle circle = circle_of(object, 0.0);
      circle.middle_m = place;
      if (!is_free(circle, object)) continue;
      taken_.push_back(circle);
      std::vector<std::string> more = {fmt::format("position_m=[{}, {}]", place.x, place.y)};
      if (std::ranges::none_of(objects.settings, has_heading))
        more.push_back(fmt::format("heading_deg={}", 360.0 * draw(name + ".heading")));
      const std::size_t index = world_.scene().objects.size() + placed_++;
      for (std::string& one : scene::object_settings(objects, index, more))
        settings_.push_back(std::move(one));
      return;
    }
  }

  bool is_free(const Circle& circle, const scene::FloatingObject& object) const {
    const auto& heights = world_.state().terrain;
    const double draught_m = object.motion == scene::Motion::kFloat
                                 ? object.draught * object.size_m.z + kClearWater_m
                                 : 0.0;
    if (heights && terrain::height_at(*heights, circle.middle_m) > -draught_m) return false;
    return std::ranges::none_of(taken_, [&](const Circle& other) {
      return glm::distance(circle.middle_m, other.middle_m) < circle.radius_m + other.radius_m;
    });
  }

  const scene::Recipe& recipe_;
  std::uint64_t sample_;
  const render::World& world_;
  const View& view_;
  std::size_t own_ = scene::load_scene(recipe_.scene).objects.size();  // objects of the file
  std::vector<Circle> taken_;
  std::size_t placed_ = 0;
  std::vector<std::string> settings_;
};

}  // namespace

std::vector<std::string> place_objects(const scene::Recipe& recipe, int sample,
                                       const render::World& world, const View& view, double t_s) {
  return Placer(recipe, sample, world, view, t_s).place();
}

}  // namespace swell::apps
