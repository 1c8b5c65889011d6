// Frames with objects of all kinds: where callers put them, many of them, those of files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "math/elementary.h"
#include "math/random.h"
#include "mesh_import/mesh_files.h"
#include "render/measure/pick.h"
#include "render/shot.h"
#include "scene/scene.h"
#include "shapes/object_ray.h"
#include "texture/image/image_io.h"

namespace swell::render {
namespace {

constexpr int kWidth = 192, kHeight = 108;

// A flat, smooth sea with a clear view to the north.
scene::Scene scene_of_calm_objects() {
  scene::Scene scene;
  scene.sea.wind_speed_mps = 0.0;
  scene.water.bump_strength = 0.0;
  scene.sky.model = scene::SkyModel::kGradient;  // made in a third of the time
  scene.sky.cloud_cover = 0.0;
  scene.camera.eye_m = {0.0, -40.0, 6.0};
  scene.camera.pitch_rad = radians(-6.0);
  return scene;
}

// Pictures of a world through its own camera, with the same storage.
struct Drawn : Shot {
  explicit Drawn(const World& of, int threads = 2) : Shot(threads), world(of) {}

  std::uint64_t draw(double t_s, FrameOptions options = {}) {
    options.water_triangles = 3000;
    return picture_hash(Shot::draw(world, view_of(world, t_s, kWidth, kHeight), t_s, options));
  }

  const World& world;
};

scene::FloatingObject object_of(scene::ObjectKind kind, glm::dvec2 position_m) {
  scene::FloatingObject object = scene::common_object(kind);
  object.position_m = position_m;
  return object;
}

scene::FloatingObject mesh_of(const std::filesystem::path& file) {
  scene::FloatingObject object = scene::common_object(scene::ObjectKind::kMesh);
  object.file = file.string();
  object.draught = 0.25;
  return object;
}

TEST(ObjectFrames, APoseOfTheCallersIsThatOfAFixedObjectThere) {
  scene::Scene scene = scene_of_calm_objects();
  scene.objects = {object_of(scene::ObjectKind::kBoat, {-3.0, 2.0}),
                   object_of(scene::ObjectKind::kSailboat, {4.0, 10.0})};
  scene.objects[1].motion = scene::Motion::kFixed;
  scene.objects[1].height_m = 0.3;
  scene.objects[1].heading_rad = radians(70.0);
  const World there = world_of(scene);
  scene.objects[1].position_m = {4000.0, 500.0};
  const World elsewhere = world_of(scene);
  Drawn expected(there), given(elsewhere);
  const double c = std::cos(radians(70.0)), s = std::sin(radians(70.0));
  const scene::GivenPose pose{
      1, {{4.0, 10.0, 0.3}, glm::dmat3(glm::dvec3(c, -s, 0.0), {s, c, 0.0}, {0.0, 0.0, 1.0})}};
  expected.draw(2.0);
  const std::uint64_t away = given.draw(2.0);
  EXPECT_NE(given.draw(2.0, {.poses = {&pose, 1}}), away);
  // The axes differ in the last bits.
  int differ = 0;
  for (std::size_t i = 0; i < given.target.rgba.size(); ++i)
    differ += given.target.rgba[i] != expected.target.rgba[i];
  EXPECT_LT(differ, 20);
  EXPECT_EQ(given.draw(2.0), away) << "for one frame alone";
}

TEST(ObjectFramesDeathTest, PosesThatAreNoneAreRefused) {
  scene::Scene scene = scene_of_calm_objects();
  scene.objects = {object_of(scene::ObjectKind::kBoat, {0.0, 0.0})};
  const World world = world_of(scene);
  const auto expect_refused = [&](const scene::GivenPose& pose, const char* text) {
    EXPECT_DEATH(Drawn(world).draw(0.0, {.poses = {&pose, 1}}), text);
    EXPECT_DEATH(Drawn(world).draw(0.0, {.next_poses = {&pose, 1}}), text);
  };
  expect_refused({1, {}}, "a pose of object 1 of 1");
  expect_refused({0, {{NAN, 0.0, 0.0}, glm::dmat3(1.0)}}, "position_world=");
  expect_refused({0, {{0.0, 0.0, 1e8}, glm::dmat3(1.0)}}, "position_world=");
  expect_refused({0, {glm::dvec3(0.0), glm::dmat3(2.0)}}, "is no rotation");
  expect_refused({0, {glm::dvec3(0.0), glm::dmat3(NAN)}}, "is no rotation");
  glm::dmat3 mirrored(1.0);
  mirrored[0].x = -1.0;
  expect_refused({0, {glm::dvec3(0.0), mirrored}}, "is no rotation");
}

TEST(ObjectFrames, AnObjectOnAPathIsWhereItsTimeSays) {
  scene::Scene scene = scene_of_calm_objects();
  scene.objects = {object_of(scene::ObjectKind::kSailboat, {0.0, 0.0})};
  scene.objects[0].path_m = {{-30.0, 20.0}, {30.0, 20.0}};
  scene.objects[0].path_closed = false;
  const World world = world_of(scene);
  Drawn drawn(world);
  drawn.draw(3.0);
  const std::uint64_t later = drawn.draw(10.0);
  EXPECT_EQ(Drawn(world).draw(10.0), later) << "whatever was drawn before";
  const auto& poses = drawn.state().meshes.objects.poses;
  EXPECT_NEAR(poses[0].position_world.x, 0.0, 1e-9);
  EXPECT_NEAR(poses[0].position_world.y, 20.0, 1e-9);
}

scene::Scene crowd(int count) {
  scene::Scene scene;
  scene.sea.resolution = 64;
  scene.sea.wind_speed_mps = 7.0;
  scene.sky.model = scene::SkyModel::kGradient;
  scene.camera.eye_m = {0.0, -60.0, 12.0};
  scene.camera.pitch_rad = radians(-5.0);
  constexpr std::array kKinds = {scene::ObjectKind::kBuoy,     scene::ObjectKind::kBoat,
                                 scene::ObjectKind::kSailboat, scene::ObjectKind::kRock,
                                 scene::ObjectKind::kSphere,   scene::ObjectKind::kBox};
  for (int i = 0; i < count; ++i) {
    const auto n = static_cast<std::uint64_t>(i);
    scene.objects.push_back(
        object_of(kKinds[n % kKinds.size()],
                  {900.0 * (random_uniform(51, n) - 0.5), 1200.0 * random_uniform(52, n)}));
    scene.objects.back().heading_rad = 6.28 * random_uniform(53, n);
  }
  return scene;
}

TEST(ObjectFrames, AThousandObjectsAreDrawnTheSameInEveryWay) {
  const World world = world_of(crowd(1000));
  Drawn drawn(world);
  const std::uint64_t hash = drawn.draw(4.0);
  const auto& geometry = drawn.state().meshes.objects;
  EXPECT_EQ(geometry.poses.size(), 1000u);
  EXPECT_GT(geometry.in_window().instances.size(), 300u);
  EXPECT_LT(geometry.in_window().instances.size(), 1000u) << "those beside the view are left out";
  for (const int threads : {1, 3})
    for (const int tile_size_px : {16, 64})
      EXPECT_EQ(Drawn(world, threads).draw(4.0, {.tile_size_px = tile_size_px}), hash);
  drawn.draw(9.0);
  EXPECT_EQ(drawn.draw(4.0), hash) << "after another frame";
}

// Against all triangles of all objects that were drawn, one after the other.
TEST(ObjectFrames, PicksAreTheNearestOfAllTriangles) {
  scene::Scene scene = crowd(60);
  for (scene::FloatingObject& object : scene.objects) object.position_m *= 0.12;
  const std::filesystem::path file = mesh_folder("pick") / "a.stl";
  write_stl(file, box_triangles({-2, -5, -1}, {2, 5, 3}));
  for (std::size_t i = 0; i < 10; ++i) {
    const glm::dvec2 place = scene.objects[i].position_m;
    scene.objects[i] = mesh_of(file);
    scene.objects[i].position_m = place;
    scene.objects[i].at_file_origin = i % 2 == 0;
  }
  const World world = world_of(scene);
  Drawn drawn(world);
  drawn.draw(3.0);
  const auto& geometry = drawn.state().meshes.objects.in_window();
  PickScratch scratch;
  int met = 0;
  for (int n = 0; n < 900; ++n) {
    const auto i = static_cast<std::uint64_t>(n);
    const glm::vec2 at_px(kWidth * random_uniform(61, i), kHeight * random_uniform(62, i));
    const auto picked = pick(world, drawn.view, drawn.workspace, at_px, scratch);
    if (!picked || picked->what != Shown::kObject) continue;
    ++met;
    const glm::dvec3 along = glm::normalize(picked->p_world - drawn.view.eye_world);
    double nearest = 1e9;
    std::size_t object = 0;
    for (std::size_t t = 0; t < geometry.primitives.size(); ++t) {
      std::array<glm::dvec3, 3> corner;
      for (std::size_t k = 0; k < 3; ++k)
        corner[k] = glm::dvec3(geometry.p_rel[geometry.indices[3 * t + k]]);
      const glm::dvec3 e1 = corner[1] - corner[0], e2 = corner[2] - corner[0];
      const glm::dvec3 p = glm::cross(along, e2);
      const double determinant = glm::dot(e1, p);
      if (std::abs(determinant) < 1e-12) continue;
      const double u = -glm::dot(corner[0], p) / determinant;
      const glm::dvec3 q = glm::cross(-corner[0], e1);
      const double v = glm::dot(along, q) / determinant;
      const double s = glm::dot(e2, q) / determinant;
      if (u < -1e-6 || v < -1e-6 || u + v > 1.0 + 1e-6 || s <= 0.0 || s >= nearest) continue;
      nearest = s, object = geometry.primitives[t].object->object;
    }
    EXPECT_NEAR(nearest, picked->distance_m, 1e-3);
    EXPECT_EQ(object, picked->object);
  }
  EXPECT_GT(met, 20);
}

TEST(ObjectFrames, LabelsNameTheObjectOfAFile) {
  const std::filesystem::path file = mesh_folder("label") / "a.glb";
  const glm::vec3 colour(0.2f, 0.4f, 0.6f);
  write_glb(file, box_triangles({-6, -6, -1}, {6, 6, 8}), &colour);
  scene::Scene scene = scene_of_calm_objects();
  scene.objects = {mesh_of(file)};
  scene.objects[0].label = "barge";
  const World world = world_of(scene);
  EXPECT_NEAR(world.scene().objects[0].size_m.z, 9.0, 1e-6);
  Drawn drawn(world);
  FrameOptions options;
  options.labels.add(Label::kId);
  options.labels.add(Label::kNormal);
  drawn.draw(0.0, options);
  const std::size_t middle = drawn.at(kWidth / 2, kHeight / 2);
  EXPECT_EQ(drawn.target.labels.id[middle], kFirstObjectId);
  EXPECT_LT(glm::distance(drawn.target.labels.normal[middle], glm::vec3(0, -1, 0)), 1e-3f);
}

// Quarters of a square wall: red and green above, blue and white below.
TEST(ObjectFrames, APictureIsSeenWhereItLiesAndItsMeanWithoutIt) {
  const std::filesystem::path folder = mesh_folder("wall");
  constexpr int kSide = 16;
  texture::Image8 image{kSide, kSide, 3, {}};
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const bool right = x >= kSide / 2, below = y >= kSide / 2;
      for (const bool on : {right == below, right, below}) image.pixels.push_back(on ? 255 : 0);
    }
  texture::write_file(folder / "four.png", texture::encode_image(image, ".png"));
  write_text(folder / "wall.mtl", "newmtl m\nKd 1 1 1\nillum 1\nmap_Kd four.png\n");
  write_text(folder / "wall.obj",
             "mtllib wall.mtl\nv -6 0 0\nv 6 0 0\nv 6 12 0\nv -6 12 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
             "vt 0 1\nusemtl m\nf 1/1 2/2 3/3 4/4\n");
  scene::Scene scene = scene_of_calm_objects();
  scene.camera.pitch_rad = 0.0;
  scene.sky.sun_azimuth_rad = radians(180.0);
  scene.sky.sun_direction = {0.0f, -0.8660254f, 0.5f};
  scene.objects = {mesh_of(folder / "wall.obj")};
  scene.objects[0].draught = 0.0;
  const World world = world_of(scene);
  Drawn drawn(world);
  // The wall's middle is at the picture's; a quarter is 3 m off, 40 m away.
  const int off = static_cast<int>(0.5 * kHeight / std::tan(0.5 * scene.camera.fov_y_rad) * 3 / 40);
  const auto colour_at = [&](int right, int down) {
    return drawn.linear(kWidth / 2 + right * off, kHeight / 2 + down * off);
  };
  drawn.draw(0.0, {.keep_linear = true, .without = {Part::kHaze, Part::kUplight}});
  const glm::vec3 white = colour_at(1, 1);
  EXPECT_GT(std::min({white.x, white.y, white.z}), 0.1f);
  const std::array<std::pair<glm::ivec2, glm::vec3>, 3> expected = {
      {{{-1, -1}, {1, 0, 0}}, {{1, -1}, {0, 1, 0}}, {{-1, 1}, {0, 0, 1}}}};
  for (const auto& [at, part] : expected) {
    const glm::vec3 seen = colour_at(at.x, at.y) / white;
    EXPECT_LT(glm::distance(seen, part), 0.08f) << seen.x << " " << seen.y << " " << seen.z;
  }
  drawn.draw(0.0, {.keep_linear = true, .without = {Part::kHaze, Part::kUplight, Part::kTextures}});
  for (const int right : {-1, 1})
    for (const int down : {-1, 1})
      EXPECT_LT(glm::distance(colour_at(right, down) / white, glm::vec3(0.5f)), 0.08f);
}

// A flat square seen from its back is as bright as from its front.
TEST(ObjectFrames, ASurfaceWithoutABackIsSeenFromBothSides) {
  std::array<glm::vec3, 2> seen;
  for (const bool turned : {false, true}) {
    LooseTriangles square;
    const glm::vec3 a(-8, 0, 0), b(8, 0, 0), c(8, 0, 8), d(-8, 0, 8);
    if (turned)
      square.corners = {a, c, b, a, d, c};
    else
      square.corners = {a, b, c, a, c, d};
    const std::filesystem::path file = mesh_folder("square") / (turned ? "b.stl" : "a.stl");
    write_stl(file, square);
    scene::Scene scene = scene_of_calm_objects();
    scene.sky.sun_azimuth_rad = radians(180.0);
    scene.sky.sun_direction = {0.0f, -0.8660254f, 0.5f};
    scene.objects = {mesh_of(file)};
    scene.objects[0].draught = 0.0;
    scene.objects[0].colour = glm::vec3(0.5f);
    const World world = world_of(scene);
    Drawn drawn(world);
    drawn.draw(0.0, {.keep_linear = true});
    seen[turned] = drawn.linear(kWidth / 2, kHeight / 2 - 12);
  }
  EXPECT_GT(seen[0].x, 0.1f);
  EXPECT_LT(glm::distance(seen[0], seen[1]), 1e-3f);
}

TEST(ObjectFrames, AFileThatCannotBeDrawnIsNamedWithItsLine) {
  const std::filesystem::path folder = mesh_folder("line");
  write_text(folder / "bad.obj", "v 1 2\nf 1 2 3\n");
  const std::string text = "[camera]\n\n[[object]]\nkind = \"mesh\"\nfile = \"bad.obj\"\n";
  const auto fault_of = [&](const std::string& file, const std::string& more) {
    std::string edited = text;
    edited.replace(edited.find("bad.obj"), 7, file);
    try {
      const World world(scene::parse_scene(edited + more, folder / "scene.toml"));
    } catch (const scene::SceneError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string place = (folder / "scene.toml").string() + ":5: column 8: object[0].file, got ";
  EXPECT_TRUE(fault_of("bad.obj", "").starts_with(place)) << fault_of("bad.obj", "");
  write_stl(folder / "good.stl", box_triangles({-1, -1, -1}, {1, 1, 1}));
  EXPECT_EQ(fault_of("good.stl", ""), "");
  EXPECT_NE(fault_of("good.stl", "scale = 5000\n").find("allowed 0.05 to 2000 m"),
            std::string::npos);
  EXPECT_NE(fault_of("none.stl", "").find("No such file"), std::string::npos);
}

TEST(ObjectFrames, AnotherWorldLikeItReadsNoFileAgain) {
  const std::filesystem::path file = mesh_folder("like") / "a.stl";
  write_stl(file, box_triangles({-1, -1, -1}, {1, 1, 1}));
  scene::Scene scene = scene_of_calm_objects();
  scene.objects = {mesh_of(file)};
  const World world(scene);
  std::filesystem::remove(file);
  scene.objects[0].scale = 3.0;
  const World other(scene, world, 2);
  EXPECT_NEAR(other.scene().objects[0].size_m.x, 6.0, 1e-6);
  // A world's own scene makes a world too, whatever its meshes' sizes are.
  scene::Scene resolved = other.scene();
  resolved.objects[0].scale = 600.0;
  resolved.objects[0].at_file_origin = true;
  const World large(resolved, other, 2);
  EXPECT_NO_THROW(World(large.scene(), large, 2));
  EXPECT_THROW(World{scene}, scene::SceneError);
}

}  // namespace
}  // namespace swell::render
