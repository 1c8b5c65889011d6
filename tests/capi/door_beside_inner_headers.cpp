// The C++ door in a program that uses the inner headers too: no name means two things.
#include <gtest/gtest.h>

#include <cstring>

#include "render/frame.h"
#include "render/measure/pick.h"
#include "render/quality/governor.h"
#include "render/world_view.h"
#include "scene/objects.h"
#include "scene/settings.h"
#include "scene/water.h"
#include "swell.hpp"

namespace {

using namespace swell;

TEST(DoorBesideInnerHeaders, BothDrawTheSamePicture) {
  const std::string path = SWELL_SOURCE_DIR "/scenes/buoys.toml";
  const Picture picture = World(path).render(5.0, {96, 54});

  const render::World world(scene::load_scene(path));
  Workers workers(2);
  render::Workspace workspace;
  render::Target target;
  ocean::SeaFrame sea;
  const View view = render::world_view(world, 5.0, 96, 54, sea, workers);
  render::render_frame(world, view, 5.0, {}, workspace, target, workers);
  const Plane<std::uint8_t> rgba = picture.plane<std::uint8_t>("rgba");
  ASSERT_EQ(rgba.values.size(), 4 * target.rgba.size());
  EXPECT_EQ(std::memcmp(rgba.values.data(), target.rgba.data(), rgba.values.size()), 0);
}

}  // namespace
