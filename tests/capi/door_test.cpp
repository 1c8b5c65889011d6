// The C++ door over the C interface: include/swell.hpp. What numbers it gives is tested there
// (c_interface_test.c); here that they arrive, that faults are exceptions, and who shares what.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <thread>

#include "swell.hpp"

namespace {

const std::string kSmall =
    "[sky]\nzenith = [0.1, 0.2, 0.4]\nhorizon = [0.5, 0.6, 0.7]\n[detail]\nwater_triangles = 500\n"
    "[sea]\nspectrum = false\n[[object]]\nkind = \"buoy\"\nname = \"red\"\nclass = \"buoy\"\n"
    "position_m = [0, 30]\n";
constexpr swell::PictureSize kSize = {96, 64};
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

swell::World small_world() { return swell::World::of_text(kSmall, {.threads = 2}); }

swell::Camera camera_at_buoy() {
  return swell::Camera::look({0.0, 0.0, 4.0}, {.pitch_deg = -5.0}, kSize);
}

template <class Call>
swell_status status_of(const Call& call) {
  try {
    call();
  } catch (const swell::Error& error) {
    EXPECT_NE(error.what(), std::string());
    return error.status();
  }
  return SWELL_OK;
}

TEST(Door, DrawsWhatTheCInterfaceDraws) {
  swell::World world = small_world();
  const swell::Picture picture = world.render(2.0, kSize, {.labels = {"depth", "id"}});

  swell_session* session = nullptr;
  swell_picture* drawn = nullptr;
  swell_frame frame{};
  frame.size = sizeof frame, frame.t_s = 2.0, frame.labels = "depth";
  frame.width_px = kSize.width_px, frame.height_px = kSize.height_px;
  ASSERT_EQ(swell_session_create(world.handle(), 1, &session), SWELL_OK);
  ASSERT_EQ(swell_picture_create(&drawn), SWELL_OK);
  ASSERT_EQ(swell_render(session, &frame, drawn), SWELL_OK);
  swell_plane depth{};
  depth.size = sizeof depth;
  ASSERT_EQ(swell_picture_plane(drawn, "depth", &depth), SWELL_OK);
  const swell::Plane<float> plane = picture.plane<float>("depth");
  ASSERT_EQ(plane.values.size_bytes(), depth.bytes);
  EXPECT_EQ(std::memcmp(plane.values.data(), depth.data, depth.bytes), 0);
  std::uint64_t hash = 0;
  ASSERT_EQ(swell_picture_hash(drawn, &hash), SWELL_OK);
  EXPECT_EQ(std::stoull(picture.hash(), nullptr, 16), hash);
  EXPECT_EQ(picture.hash().size(), 16u);
  swell_picture_destroy(drawn);
  swell_session_destroy(session);
}

TEST(Door, PlanesHaveTheirShapeAndType) {
  swell::World world = small_world();
  const swell::Picture picture =
      world.render(2.0, kSize, {.labels = {"all"}, .linear = true, .camera = camera_at_buoy()});
  const auto rgba = picture.plane<std::uint8_t>("rgba");
  EXPECT_EQ(rgba.components, 4);
  EXPECT_EQ(rgba.at(5, 7, 3), 255);
  EXPECT_EQ(picture.plane<float>("linear").components, 3);
  EXPECT_EQ(picture.plane<double>("position").components, 3);
  EXPECT_NEAR(picture.plane<double>("position").at(48, 32, 1), 30.0, 2.0);  // north of the buoy
  EXPECT_EQ(picture.plane<std::uint32_t>("id").at(48, 32), world.objects()[0].id);
  EXPECT_EQ(picture.plane<float>("depth").width_px, kSize.width_px);
  EXPECT_EQ(picture.plane<float>("depth").height_px, kSize.height_px);
  EXPECT_EQ(status_of([&] { picture.plane<double>("depth"); }), SWELL_BAD_ARGUMENT);
  EXPECT_EQ(status_of([&] { picture.plane<float>("deepness"); }), SWELL_BAD_ARGUMENT);
}

TEST(Door, AsksTheWater) {
  swell::World world = small_world();
  const std::vector<swell::Point2> points = {{0.0, 50.0}, {3.0, 60.0}};
  EXPECT_EQ(world.height(points, 5.0), (std::vector<float>{0.0f, 0.0f}));
  EXPECT_EQ(world.height({{0, 50}, {3, 60}, {4, 70}}, 5.0).size(), 3u);
  EXPECT_EQ(world.slope(points, 5.0)[1], (std::array<float, 2>{0.0f, 0.0f}));
  EXPECT_EQ(world.normal(points, 5.0)[1], (std::array<float, 3>{0.0f, 0.0f, 1.0f}));
  EXPECT_EQ(world.velocity(points, 5.0)[0], (std::array<float, 3>{0.0f, 0.0f, 0.0f}));
  EXPECT_EQ(world.foam(points, 5.0)[0], 0.0f);
  EXPECT_TRUE(std::isinf(world.still_depth(points)[0]));
  EXPECT_TRUE(world.height({}, 5.0).empty());

  const swell::Disturbance drop = {
      .position_m = {0.0, 50.0}, .t_s = 5.0, .radius_m = 3.0, .height_m = 0.5};
  EXPECT_NEAR(world.height(points, 5.0, {drop})[0], 0.5f, 0.02f);

  const std::optional<swell::Hit> hit = world.ray({1.0, 2.0, 10.0}, {0.0, 0.0, -3.0}, 5.0);
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->distance_m, 10.0, 1e-5);
  EXPECT_TRUE(hit->from_above);
  EXPECT_FALSE(world.ray({1.0, 2.0, 10.0}, {0.0, 0.0, -3.0}, 5.0, 9.0).has_value());
}

TEST(Door, ScansWithALidar) {
  swell::World world = swell::World::of_text(
      "[sea]\nspectrum = false\n[[object]]\nkind = \"box\"\nmotion = \"fixed\"\n"
      "position_m = [20, 0]\nsize_m = [4, 4, 4]\ndraught = 0.5\n");
  const swell::LidarPose pose{{0.0, 0.0, 1.0}};
  const auto returns = world.lidar(0.0, pose, {{0.0, 0.0}, {90.0, -30.0}, {45.0, 20.0}});
  ASSERT_EQ(returns.size(), 3u);
  EXPECT_NEAR(returns[0].range_m, 18.0f, 1e-4f);
  EXPECT_NEAR(returns[0].point_m[0], 18.0f, 1e-4f);
  EXPECT_EQ(returns[1].id, 1u);
  EXPECT_NEAR(returns[1].incidence_deg, 60.0f, 1e-2f);
  EXPECT_TRUE(std::isinf(returns[2].range_m));
  swell::LidarOptions options;
  options.most_m = 10.0;
  options.end = swell::LidarPose{{0.0, 0.0, 3.0}};
  options.duration_s = 0.5;
  const auto moved = world.lidar(0.0, pose, {{0.0, 0.0}, {0.0, -90.0, 0.25}}, options);
  EXPECT_TRUE(std::isinf(moved[0].range_m));
  EXPECT_NEAR(moved[1].range_m, 2.0f, 1e-4f);

  EXPECT_EQ(swell::spinning_beams("hdl-32e", 8).size(), 8u * 32u);
  EXPECT_NEAR(swell::grid_beams({8, 8}, 80.0, 40.0)[0].azimuth_deg, 35.0, 1e-9);
  EXPECT_EQ(status_of([] { swell::spinning_beams("none"); }), SWELL_BAD_ARGUMENT);
  EXPECT_EQ(status_of([&] { world.lidar(0.0, {{2e6, 0.0, 0.0}}, {}); }), SWELL_BAD_ARGUMENT);
}

TEST(Door, AsksBelowTheSurface) {
  swell::World world = swell::World::of_text(
      "[sea]\nspectrum = false\n[[sea.sines]]\namplitude_m = 1.0\nwavelength_m = 60.0\n");
  const std::vector<swell::Point3> points = {{0.0, 7.0, 5.0}, {0.0, 7.0, -4.0}};
  const std::vector<swell::Motion> motion = world.below(points, 2.0);
  EXPECT_EQ(motion[0].place, SWELL_ABOVE_WATER);
  EXPECT_EQ(motion[0].pressure_pa, 0.0f);
  EXPECT_EQ(motion[1].place, SWELL_IN_WATER);
  EXPECT_NEAR(world.below(points, 2.0, 1000.0)[1].pressure_pa, motion[1].pressure_pa / 1.025f,
              1e-3f * std::abs(motion[1].pressure_pa));
  // The wave's circle: v^2 / omega^2 = a^2 / omega^4 = e^(-2 k s).
  const double height_m = world.height({{0.0, 7.0}}, 2.0)[0], k = 6.283185307179586 / 60.0;
  const auto square = [](const std::array<float, 3>& v) {
    return static_cast<double>(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  };
  const double decay2 = std::exp(-2.0 * k * (height_m + 4.0)), omega2 = 9.81 * k;
  EXPECT_NEAR(square(motion[1].velocity_mps) / omega2, decay2, 0.005);
  EXPECT_NEAR(square(motion[1].acceleration_mps2) / (omega2 * omega2), decay2, 0.005);
  EXPECT_EQ(status_of([&] { world.below({{0.0, 0.0, std::nan("")}}, 0.0); }), SWELL_BAD_ARGUMENT);

  swell::World still = small_world();
  swell::Hull hull{{{0, 0, -4}, {2, 0, -4}, {0, 3, -4}, {0, 0, 0}},
                   {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}},
                   {0.5, 0.75, -3.0}};
  const swell::HullLoads loads = still.hull_loads(hull, 1.0);
  EXPECT_NEAR(loads.buoyancy.force_n[2], 1025.0 * 9.81 * 4.0, 0.1);
  EXPECT_NEAR(loads.buoyancy.moment_nm[0], 0.0, 0.1);
  EXPECT_EQ(loads.froude_krylov.force_n[2], 0.0);
  hull.triangles[0][0] = 4;
  EXPECT_EQ(status_of([&] { still.hull_loads(hull, 1.0); }), SWELL_BAD_ARGUMENT);
}

TEST(Door, PicksAndPlacesObjects) {
  swell::World world = small_world();
  swell::RenderOptions options{.labels = {"id"}, .camera = camera_at_buoy()};
  world.render(2.0, kSize, options);
  const swell::Pick pick = world.pick({48.5, 32.5});
  EXPECT_EQ(pick.what, SWELL_SHOWS_OBJECT);
  EXPECT_EQ(pick.object, 0u);
  EXPECT_EQ(pick.id, world.objects()[0].id);
  EXPECT_EQ(world.pick({48.5, 0.5}).what, SWELL_SHOWS_SKY);
  EXPECT_FALSE(world.pick({48.5, 0.5}).object.has_value());

  options.poses = world.poses(2.0);
  ASSERT_EQ(options.poses.size(), 1u);
  EXPECT_NEAR(options.poses[0].position_m[1], 30.0, 1e-9);
  options.poses[0].position_m[1] = -500.0;
  const swell::Picture elsewhere = world.render(2.0, kSize, options);
  EXPECT_EQ(elsewhere.plane<std::uint32_t>("id").at(48, 32), 1u);  // water
}

TEST(Door, SaysWhatASceneHas) {
  const swell::World world =
      swell::World::of_text(kSmall, {.settings = {"wind.speed_mps=7.5"}, .threads = 1});
  EXPECT_NE(world.text().find("speed_mps = 7.5"), std::string::npos);
  EXPECT_EQ(world.hash().size(), 16u);
  ASSERT_EQ(world.objects().size(), 1u);
  EXPECT_EQ(world.objects()[0].name, "red");
  EXPECT_EQ(world.classes().at(world.objects()[0].klass), "buoy");
  EXPECT_EQ(swell::labels().front(), "depth");
  EXPECT_EQ(swell::parts().front(), "water");
  EXPECT_GT(swell::keys().size(), 100u);
}

TEST(Door, CamerasOfThreeKindsAreTheSame) {
  const swell::Camera look = swell::Camera::look({1.0, 2.0, 4.0}, {.heading_deg = 90.0}, kSize);
  // Looks east: x is south, y down.
  const swell::Matrix3 world_from_optical = {{{0, 0, 1}, {-1, 0, 0}, {0, -1, 0}}};
  const double f = look.focal_px[0];
  const swell::Matrix3 k = {{{f, 0, 48}, {0, f, 32}, {0, 0, 1}}};
  const swell::Camera pose = swell::Camera::from_pose({1.0, 2.0, 4.0}, world_from_optical, k);
  const swell::Matrix3 opencv_k = {{{f, 0, 47.5}, {0, f, 31.5}, {0, 0, 1}}};
  const swell::Matrix3 optical_from_world = {{{0, -1, 0}, {0, 0, -1}, {1, 0, 0}}};
  const swell::Camera opencv =
      swell::Camera::from_opencv(opencv_k, optical_from_world, {2.0, 4.0, -1.0});
  swell::World world = small_world();
  const std::string hash = world.render(1.0, kSize, {.camera = look}).hash();
  EXPECT_EQ(world.render(1.0, kSize, {.camera = pose}).hash(), hash);
  EXPECT_EQ(world.render(1.0, kSize, {.camera = opencv}).hash(), hash);
  swell::Matrix3 mirrored = world_from_optical;
  mirrored[0] = {0, 0, -1};
  EXPECT_EQ(status_of([&] { swell::Camera::from_pose({}, mirrored, k); }), SWELL_BAD_ARGUMENT);
  EXPECT_EQ(status_of([&] { swell::Camera::from_pose({}, world_from_optical, {}); }),
            SWELL_BAD_ARGUMENT);

  const swell::Picture drawn = world.render(1.0, kSize, {.camera = look});
  EXPECT_NEAR(drawn.camera().focal_px[0], f, 1e-4);
  EXPECT_EQ(world.camera(1.0, kSize).near_m, 0.25);
}

TEST(Door, FaultsAreExceptionsWithTheirStatus) {
  EXPECT_EQ(status_of([] { swell::World("no such scene.toml"); }), SWELL_BAD_SCENE);
  EXPECT_EQ(status_of([] { swell::World::of_text("wind.speed_mps = nan"); }), SWELL_BAD_SCENE);
  EXPECT_EQ(status_of([] { swell::World::of_text(std::string("a\0b", 3)); }), SWELL_BAD_ARGUMENT);
  EXPECT_EQ(status_of([] { swell::World::of_text("", {.threads = -1}); }), SWELL_BAD_ARGUMENT);
  EXPECT_EQ(status_of([] { swell::World::of_text(kSmall, {.most_bytes = 1}); }), SWELL_NO_MEMORY);
  swell::World world = small_world();
  for (const double bad : {kNaN, HUGE_VAL, -HUGE_VAL, 1e300}) {
    EXPECT_EQ(status_of([&] { world.render(bad, kSize); }), SWELL_BAD_ARGUMENT);
    EXPECT_EQ(status_of([&] { world.height({{0.0, 0.0}}, bad); }), SWELL_BAD_ARGUMENT);
    EXPECT_EQ(status_of([&] { world.height({{bad, 0.0}}, 0.0); }), SWELL_BAD_ARGUMENT);
    EXPECT_EQ(status_of([&] { world.ray({bad, 0, 1}, {0, 0, -1}, 0.0); }), SWELL_BAD_ARGUMENT);
    EXPECT_EQ(status_of([&] { world.poses(bad); }), SWELL_BAD_ARGUMENT);
    EXPECT_EQ(status_of([&] { world.camera(bad); }), SWELL_BAD_ARGUMENT);
  }
  swell::Camera wide = camera_at_buoy();
  wide.projection = SWELL_FISHEYE;
  wide.fisheye_k[0] = -1.0;  // folds
  EXPECT_EQ(status_of([&] { world.render(0.0, kSize, {.camera = wide}); }), SWELL_BAD_ARGUMENT);
  EXPECT_EQ(status_of([&] { world.render(0.0, {0, 9}); }), SWELL_BAD_ARGUMENT);
  EXPECT_EQ(status_of([&] { world.render(0.0, {1 << 30, 9}); }), SWELL_BAD_ARGUMENT);
  EXPECT_EQ(status_of([&] { world.pick({1.0, 1.0}); }), SWELL_BAD_ARGUMENT);
  EXPECT_EQ(status_of([] { swell::Picture().hash(); }), SWELL_BAD_ARGUMENT);

  const swell::World moved = std::move(world);
  EXPECT_EQ(status_of([&] { world.render(0.0, kSize); }), SWELL_BAD_ARGUMENT);  // NOLINT: meant
  EXPECT_TRUE(world.text().empty());
}

TEST(Door, WideCamerasComeBackAsTheyWent) {
  swell::World world = small_world();
  swell::Camera fish = camera_at_buoy();
  fish.projection = SWELL_FISHEYE;
  fish.focal_px = {30.0, 31.0};
  fish.principal_px = {40.0, 20.0};
  fish.fisheye_k = {0.01, -0.002, 0.0, 0.0};
  fish.fisheye_fov_deg = 200.0;
  const swell::Picture drawn = world.render(1.0, kSize, {.labels = {"all"}, .camera = fish});
  const swell::Camera back = drawn.camera();
  EXPECT_EQ(back.projection, SWELL_FISHEYE);
  EXPECT_EQ(back.focal_px, fish.focal_px);
  EXPECT_EQ(back.principal_px, fish.principal_px);
  EXPECT_EQ(back.fisheye_k, fish.fisheye_k);
  EXPECT_NEAR(back.fisheye_fov_deg, 200.0, 1e-9);
  swell::Camera all = camera_at_buoy();
  all.projection = SWELL_EQUIRECTANGULAR;
  EXPECT_NE(world.render(1.0, kSize, {.camera = all}).hash(), drawn.hash());
  EXPECT_EQ(status_of([&] { world.pick({1.0, 1.0}); }), SWELL_BAD_ARGUMENT);  // of a wide picture
}

TEST(Door, CopiesShareTheWorldAndDrawSideBySide) {
  swell::World world = small_world();
  const std::string hash = world.render(2.0, kSize).hash();
  std::vector<std::string> hashes(4);
  {
    std::vector<std::jthread> threads;
    for (std::string& drawn : hashes)
      threads.emplace_back([&drawn, copy = world]() mutable {
        for (int i = 0; i < 5; ++i) drawn = copy.render(2.0, kSize).hash();
      });
  }
  for (const std::string& drawn : hashes) EXPECT_EQ(drawn, hash);

  swell::World copy = world;
  EXPECT_EQ(copy.handle(), world.handle());
  EXPECT_NE(copy.session(), world.session());
  world = swell::World::of_text(kSmall, {.threads = 1});
  EXPECT_EQ(copy.render(2.0, kSize).hash(), hash);  // it keeps what it shares
}

TEST(Door, PicturesOutliveTheirWorldAndAreDrawnIntoAgain) {
  swell::Picture picture;
  std::string hash;
  {
    swell::World world = small_world();
    world.render_into(picture, 2.0, kSize);
    const void* const first = picture.plane<std::uint8_t>("rgba").values.data();
    world.render_into(picture, 3.0, kSize);
    EXPECT_EQ(picture.plane<std::uint8_t>("rgba").values.data(), first);
    hash = picture.hash();
  }
  const swell::Picture moved = std::move(picture);
  EXPECT_EQ(moved.hash(), hash);
}

TEST(Door, TellsHowFarAWorldIsAndEndsItsMaking) {
  double done = 0.0;
  int lines = 0;
  swell::World::of_text("", {.progress =
                                 [&](double part) {
                                   EXPECT_GE(part, done);
                                   done = part;
                                   return true;
                                 },
                             .log = [&](std::string_view) { ++lines; }});
  EXPECT_EQ(done, 1.0);
  EXPECT_GT(lines, 3);
  EXPECT_EQ(
      status_of([] { swell::World::of_text("", {.progress = [](double) { return false; }}); }),
      SWELL_CANCELLED);
}

TEST(Door, WhatACallbackThrowsArrives) {
  const auto throwing = [](auto...) -> bool { throw std::out_of_range("of the caller"); };
  EXPECT_THROW(swell::World::of_text("", {.progress = throwing}), std::out_of_range);
  EXPECT_THROW(swell::World::of_text("", {.log = throwing}), std::out_of_range);
}

}  // namespace
