// What is said of scene texts that are not as they should be.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "scene/file/parameters.h"
#include "scene/scene_text.h"

namespace swell::scene {
namespace {

struct Fault {
  const char* text;
  const char* message;  // the whole of it
};

class SceneFileFault : public ::testing::TestWithParam<Fault> {};

TEST_P(SceneFileFault, IsNamedWithPlaceAndAllowedValues) {
  EXPECT_EQ(error_of(GetParam().text), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Values, SceneFileFault,
    ::testing::Values(
        Fault{"[camera]\nfov_y_deg = 400\n",
              "test.toml:2: column 13: camera.fov_y_deg, got 400, allowed 1 to 170 deg"},
        Fault{"[camera]\nnear_m = nan\n",
              "test.toml:2: column 10: camera.near_m, got nan, allowed 0.01 to 10 m"},
        Fault{"[camera]\n\nnear_m = -inf\n",
              "test.toml:3: column 10: camera.near_m, got -inf, allowed 0.01 to 10 m"},
        Fault{"[camera]\nnear_m = \"near\"\n",
              "test.toml:2: column 10: camera.near_m, got \"near\", allowed 0.01 to 10 m"},
        Fault{"[camera]\neye_m = [0, 0]\n",
              "test.toml:2: column 9: camera.eye_m, got an array of 2 values, allowed 3 numbers, "
              "each -1000000 to 1000000 m"},
        Fault{"[camera]\neye_m = [0, 0, 2e6]\n",
              "test.toml:2: column 16: camera.eye_m[2], got 2000000, allowed 3 numbers, each "
              "-1000000 to 1000000 m"},
        Fault{"[camera]\neye_m = [0, 0, true]\n",
              "test.toml:2: column 16: camera.eye_m[2], got true, allowed 3 numbers, each -1000000 "
              "to 1000000 m"},
        Fault{"[detail]\nwater_triangles = 1\n",
              "test.toml:2: column 19: detail.water_triangles, got 1, allowed an integer, 2 to "
              "1000000"},
        Fault{"[detail]\nwater_triangles = -30000\n",
              "test.toml:2: column 19: detail.water_triangles, got -30000, allowed an integer, 2 "
              "to 1000000"},
        Fault{"[detail]\nwater_triangles = 100.5\n",
              "test.toml:2: column 19: detail.water_triangles, got 100.5, allowed an integer, 2 "
              "to 1000000"},
        Fault{"[detail]\npriority = \"size\"\n",
              "test.toml:2: column 12: detail.priority, got \"size\", allowed \"projected_size\" "
              "or \"inverse_distance\""},
        Fault{"[sea]\nresolution = 100\n",
              "test.toml:2: column 14: sea.resolution, got 100, allowed a power of two, 16 to 512"},
        Fault{"[sea]\nmap_set = \"pond\"\n",
              "test.toml:2: column 11: sea.map_set, got \"pond\", allowed \"none\", \"river\", "
              "\"lake\", \"coast\" or \"ocean\""},
        Fault{"[sea]\nmap_set = \"lake\"\nspectrum = true\n",
              "test.toml:2: column 11: sea.map_set, got 7 layers beside 3 patches of the spectrum, "
              "allowed at most 8 of both"},
        Fault{"[[sea.maps]]\nlength_m = 20\n",
              "test.toml:1: column 1: sea.maps[0].file, got none, allowed a readable map file"},
        Fault{"[[sea.maps]]\nlength_m = 0\n",
              "test.toml:2: column 12: sea.maps[0].length_m, got 0, allowed one number or 2 "
              "numbers, each 0.5 to 50000 m"},
        Fault{"[[sea.maps]]\nlength_m = -20.5\n",
              "test.toml:2: column 12: sea.maps[0].length_m, got -20.5, allowed one number or 2 "
              "numbers, each 0.5 to 50000 m"},
        Fault{"[[sea.maps]]\nlength_m = [10, 20, 30]\n",
              "test.toml:2: column 12: sea.maps[0].length_m, got an array of 3 values, allowed one "
              "number or 2 numbers, each 0.5 to 50000 m"},
        Fault{"[[sea.maps]]\nlength_m = [10]\n",
              "test.toml:2: column 12: sea.maps[0].length_m, got an array of 1 values, allowed one "
              "number or 2 numbers, each 0.5 to 50000 m"},
        Fault{"[[sea.maps]]\nlength_m = [10, -1]\n",
              "test.toml:2: column 17: sea.maps[0].length_m[1], got -1, allowed one number or 2 "
              "numbers, each 0.5 to 50000 m"},
        Fault{"[[sea.maps]]\nlength_m = true\n",
              "test.toml:2: column 12: sea.maps[0].length_m, got true, allowed one number or 2 "
              "numbers, each 0.5 to 50000 m"},
        Fault{"[[sea.maps]]\nfile = \"/none/none.map\"\nperiod_s = 0.01\n",
              "test.toml:2: column 8: sea.maps[0].file, got \"/none/none.map\" (No such file or "
              "directory), allowed a readable map file"},
        Fault{"[sea]\nspectrum = 1\n",
              "test.toml:2: column 12: sea.spectrum, got 1, allowed true or false"},
        Fault{"[sea]\npatch_lengths_m = [10, 20]\n",
              "test.toml:2: column 19: sea.patch_lengths_m, got [10, 20], allowed lengths that go "
              "down"},
        Fault{"[sea]\npatch_lengths_m = []\n",
              "test.toml:2: column 19: sea.patch_lengths_m, got an array of 0 values, allowed 1 to "
              "8 numbers, each 0.5 to 50000 m"},
        Fault{
            "[[sea.sines]]\nperiod_s = 0.01\n",
            "test.toml:2: column 12: sea.sines[0].period_s, got 0.01, allowed 0 or 0.05 to 1000 s"},
        Fault{"[[camera.path]]\nt_s = 2\n[[camera.path]]\npitch_deg = 90\n",
              "test.toml:4: column 13: camera.path[1].pitch_deg, got 90, allowed -89 to 89 deg"},
        Fault{"[[camera.path]]\nt_s = 2\n[[camera.path]]\nt_s = 2\n",
              "test.toml:4: column 7: camera.path[1].t_s, got 2, allowed more than that of the "
              "table before, 2"},
        Fault{"[camera]\nheading_deg = 3\nquaternion = [1, 0, 0, 0]\n",
              "test.toml:2: column 15: camera.heading_deg, got it besides camera.quaternion in "
              "line 3, allowed one of camera.quaternion, camera.heading_deg"},
        Fault{"[camera]\nquaternion = [1, 1, 0, 0]\n",
              "test.toml:2: column 14: camera.quaternion, got a length of 1.4142135623730951, "
              "allowed a length of 1, within 0.001"},
        Fault{"[camera]\nquaternion = [1, 0, 0, 0]\n[[camera.path]]\n",
              "test.toml:2: column 14: camera.quaternion, got it besides [[camera.path]], allowed "
              "one of them"},
        Fault{"[camera]\nfov_y_deg = 40\nfocal_px = [9, 9]\nsize_px = [9, 9]\n",
              "test.toml:2: column 13: camera.fov_y_deg, got it besides camera.focal_px in line 3, "
              "allowed one of camera.focal_px, camera.fov_y_deg"},
        Fault{
            "[camera]\nfocal_px = [9, 9]\n",
            "test.toml:2: column 12: camera.focal_px, got it without camera.size_px, allowed both "
            "or neither"},
        Fault{
            "[camera]\nprincipal_px = [9, 9]\n",
            "test.toml:2: column 16: camera.principal_px, got it without camera.focal_px, allowed "
            "both or neither"},
        Fault{"[camera]\nfocal_px = [800, 0]\n",
              "test.toml:2: column 18: camera.focal_px[1], got 0, allowed 2 numbers, each 1 to "
              "1000000 pixels"},
        Fault{"[camera]\nmount = \"boat\"\n[[object]]\nname = \"a\"\n[[object]]\nname = \"b\"\n",
              "test.toml:2: column 9: camera.mount, got \"boat\", allowed the name of an object: "
              "\"a\", \"b\""},
        Fault{"[camera]\nmount = \"boat\"\n",
              "test.toml:2: column 9: camera.mount, got \"boat\", allowed the name of an object, "
              "which none has"},
        Fault{"[camera]\neye_m = [0, 0, 9]\nmount = \"a\"\n[[object]]\nname = \"a\"\n",
              "test.toml:2: column 9: camera.eye_m, got it besides camera.mount in line 3, allowed "
              "one of camera.mount, camera.eye_m"},
        Fault{"[camera]\nprojection = \"fish\"\n",
              "test.toml:2: column 14: camera.projection, got \"fish\", allowed \"perspective\", "
              "\"fisheye\" or \"equirectangular\""},
        Fault{"[camera]\nprojection = \"fisheye\"\nfisheye_k = [-1, 0, 0, 0]\n",
              "test.toml:3: column 13: camera.fisheye_k, got [-1, 0, 0, 0], allowed a lens whose "
              "radius grows with the angle up to half of fisheye_fov_deg"},
        Fault{"[camera]\nprojection = \"equirectangular\"\nfocal_px = [9, 9]\nsize_px = [9, 9]\n",
              "test.toml:3: column 12: camera.focal_px, got it for camera.projection "
              "\"equirectangular\", allowed it for the others"},
        Fault{"[camera]\nf_number = 0.4\n",
              "test.toml:2: column 12: camera.f_number, got 0.4, allowed 0 or 0.5 to 128"},
        Fault{"[camera]\nf_number = 8\n",
              "test.toml:2: column 12: camera.f_number, got it without camera.exposure_s, allowed "
              "both"},
        Fault{"[camera]\nf_number = 8\nexposure_s = 0.01\n[sky]\nzenith = [0.1, 0.2, 0.3]\n",
              "test.toml:2: column 12: camera.f_number, got it under a gradient, whose light has "
              "no unit, allowed it where sky.model is \"atmosphere\""},
        Fault{
            "[camera]\nf_number = 8\nexposure_s = 0.01\n[sky]\nexposure = 2\n",
            "test.toml:2: column 12: camera.f_number, got it besides sky.exposure, allowed one of "
            "them"},
        Fault{"[camera]\nfull_well_e = 50\n",
              "test.toml:2: column 15: camera.full_well_e, got 50, allowed 0 or 100 to 10000000 "
              "electrons"},
        Fault{"[camera]\nmount_offset_m = [0, 0, 1]\n",
              "test.toml:2: column 18: camera.mount_offset_m, got it without camera.mount, allowed "
              "both or neither"},
        Fault{"[[object]]\nname = \"a\"\n[[object]]\nname = \"a\"\n",
              "test.toml:4: column 8: object[1].name, got \"a\", allowed a name that no object "
              "before it has"},
        Fault{"[sea.sines]\namplitude_m = 1\n",
              "test.toml:1: column 1: sea.sines, got a table, allowed at most 64 tables "
              "[[sea.sines]]"},
        Fault{"[sky]\nturbidity = 0\n",
              "test.toml:2: column 13: sky.turbidity, got 0, allowed 1 to 10"},
        Fault{"[air]\nattenuation_per_m = [1e-4, -1e-4, 1e-4]\n",
              "test.toml:2: column 28: air.attenuation_per_m[1], got -0.0001, allowed 3 numbers, "
              "each 0 to 1 1/m"},
        Fault{"[[object]]\nkind = \"form\"\n",
              "test.toml:2: column 8: object[0].kind, got \"form\" without a file, allowed a form "
              "with its file"},
        Fault{"[[object]]\n[[object]]\nkind = \"ship\"\n",
              "test.toml:3: column 8: object[1].kind, got \"ship\", allowed \"buoy\", \"sphere\", "
              "\"box\", \"boat\", \"sailboat\", \"pier\", \"lighthouse\", \"rock\", \"mesh\" or "
              "\"form\""},
        Fault{"[[object]]\nkind = \"mesh\"\n",
              "test.toml:2: column 8: object[0].kind, got \"mesh\" without a file, allowed a mesh "
              "with its file"},
        Fault{"[[object]]\npath_m = [[0, 0], [9, 0], [9, 0.1]]\n",
              "test.toml:2: column 27: object[0].path_m[2], got [9, 0.1], allowed a point 0.5 m or "
              "more from the one before"},
        Fault{"[[object]]\npath_m = [[0, 0], [9, 0], [0, 0]]\n",
              "test.toml:2: column 27: object[0].path_m[2], got a last point at the first, allowed "
              "a closed path that does not repeat it"},
        Fault{"[[object]]\nsize_m = [1, 1, 0]\n",
              "test.toml:2: column 17: object[0].size_m[2], got 0, allowed 3 numbers, each 0.05 to "
              "500 m"},
        Fault{"object = 3\n",
              "test.toml:1: column 10: object, got 3, allowed at most 2000 tables [[object]]"},
        Fault{"sea = 3\n", "test.toml:1: column 7: sea, got 3, allowed a table"},
        Fault{"[sky]\nhorizon = [1, 0.1, 1]\nzenith = [0, 0.8, 0]\n",
              "test.toml:3: column 10: sky.zenith[1], got 0.8, allowed at most 7.66 times "
              "sky.horizon[1], which is 0.1"},
        Fault{"[coast]\nmodel = 1979-05-27\n",
              "test.toml:2: column 9: coast.model, got 1979-05-27, allowed \"none\", "
              "\"trains\", \"blend\" or \"fronts\""}));

INSTANTIATE_TEST_SUITE_P(
    Coasts, SceneFileFault,
    ::testing::Values(
        Fault{"[terrain]\ncoast_m = [[1, 2]]\n",
              "test.toml:2: column 11: terrain.coast_m, got an array of 1 values, allowed 2 to 200 "
              "points [east, north], each number -1000000 to 1000000 m"},
        Fault{"[terrain]\ncoast_m = []\n",
              "test.toml:2: column 11: terrain.coast_m, got an array of 0 values, allowed 2 to 200 "
              "points [east, north], each number -1000000 to 1000000 m"},
        Fault{"[terrain]\ncoast_m = [[1, 2],\n  [3, 4, 5]]\n",
              "test.toml:3: column 3: terrain.coast_m[1], got an array of 3 values, allowed 2 to "
              "200 points [east, north], each number -1000000 to 1000000 m"},
        Fault{"[terrain]\ncoast_m = [1, 2]\n",
              "test.toml:2: column 12: terrain.coast_m[0], got 1, allowed 2 to 200 points [east, "
              "north], each number -1000000 to 1000000 m"},
        Fault{"[terrain]\ncoast_m = [[1, 2],\n  [3, nan]]\n",
              "test.toml:3: column 7: terrain.coast_m[1], got nan, allowed 2 to 200 points [east, "
              "north], each number -1000000 to 1000000 m"},
        Fault{"[terrain]\ncoast_m = [[1, 2],\n  [3, 4],\n  [3, 4]]\n",
              "test.toml:4: column 3: terrain.coast_m[2], got [3, 4], allowed a point 0.001 m "
              "or more from the one before"},
        Fault{"[terrain]\ncoast_m = [[1, 0], [0, 0],\n  [0, 1e-300]]\n",
              "test.toml:3: column 3: terrain.coast_m[2], got [0, 1e-300], allowed a point 0.001 m "
              "or more from the one before"},
        Fault{"[terrain]\nground = \"boundary\"\n",
              "test.toml:2: column 10: terrain.ground, got \"boundary\" without "
              "terrain.boundary, allowed \"heights\", or \"boundary\" with its file"},
        Fault{"[terrain]\nbeach_slope = 0\n",
              "test.toml:2: column 15: terrain.beach_slope, got 0, allowed 0.001 to 1"},
        Fault{"[terrain]\nbeach_size_m = 20001\n",
              "test.toml:2: column 16: terrain.beach_size_m, got 20001, allowed 50 to 20000 m"},
        Fault{"[coast]\nmodel = \"peachey\"\n",
              "test.toml:2: column 9: coast.model, got \"peachey\", allowed \"none\", "
              "\"trains\", \"blend\" or \"fronts\""},
        Fault{
            "[[disturbance]]\nkind = \"hull\"\n",
            "test.toml:2: column 8: disturbance[0].kind, got \"hull\" without a path_m, allowed a "
            "hull with its path"},
        Fault{"[[disturbance]]\nkind = \"splash\"\n",
              "test.toml:2: column 8: disturbance[0].kind, got \"splash\", allowed \"drop\", "
              "\"footstep\", \"hull\" or \"rotor\""},
        Fault{"[[disturbance]]\nradius_m = 0\n",
              "test.toml:2: column 12: disturbance[0].radius_m, got 0, allowed 0.02 to 50 m"},
        Fault{"[[disturbance]]\nkind = \"hull\"\npath_m = [[0, 0], [9, 0],\n  [9, 0]]\n",
              "test.toml:4: column 3: disturbance[0].path_m[2], got [9, 0], allowed a point 0.5 m "
              "or more from the one before"},
        Fault{"[terrain]\n[[river]]\npath_m = [[0, 0], [90, 0], [180, 9]]\nsurface_m = [3, 4, 0]\n",
              "test.toml:4: column 13: river[0].surface_m[1], got 4, allowed at most 3, where the "
              "water comes from"},
        Fault{"[terrain]\n[[river]]\npath_m = [[0, 0], [90, 0], [90, 90], [45, -60]]\n"
              "surface_m = [3, 2, 1, 0]\n",
              "test.toml:3: column 38: river[0].path_m[3], got a line that crosses itself, allowed "
              "one that does not"},
        Fault{"[terrain]\n[[river]]\nwidth_m = [nan]\n",
              "test.toml:3: column 12: river[0].width_m[0], got nan, allowed 1 to 200 "
              "numbers, each 1 to 2000 m"},
        Fault{"[[object]]\ndrift = true\n",
              "test.toml:2: column 9: object[0].drift, got it in a scene without rivers, allowed "
              "it on a river"},
        Fault{"[[object]]\nkind = \"rock\"\ndrift = true\n",
              "test.toml:3: column 9: object[0].drift, got it of what does not float, allowed it "
              "with motion = \"float\""},
        Fault{"[[object]]\ndrift = true\npath_m = [[0, 0], [9, 0]]\n",
              "test.toml:2: column 9: object[0].drift, got it besides path_m, allowed one of them"},
        Fault{"[terrain]\n[[river]]\npath_m = [[0, 0], [90, 0]]\nsurface_m = [1, 0]\n[[object]]\n"
              "position_m = [30, 40]\ndrift = true\n",
              "test.toml:6: column 14: object[0].position_m, got [30, 40], where no river flows, "
              "allowed a place in a river for what drifts"},
        Fault{
            "[terrain]\n[[river]]\ninto = \"sea\"\npath_m = [[0, 0], [90, 0]]\n"
            "surface_m = [3, 0]\n",
            "test.toml:3: column 8: river[0].into, got \"sea\", allowed the name of another river "
            "or of a lake"},
        Fault{
            "[[lake]]\nlevel_m = 3\n",
            "test.toml:1: column 1: lake, got it without a terrain, allowed rivers and lakes on a "
            "terrain"},
        Fault{"[coast]\ntrains = 17\n",
              "test.toml:2: column 10: coast.trains, got 17, allowed an integer, 1 to 16"},
        Fault{"[coast]\ngrid_spacing_m = 0.4\n",
              "test.toml:2: column 18: coast.grid_spacing_m, got 0.4, allowed 0 or 0.5 to 100 m"}));

INSTANTIATE_TEST_SUITE_P(
    UnknownKeys, SceneFileFault,
    ::testing::Values(
        Fault{"[camera]\nfov_deg = 50\n",
              "test.toml:2: column 1: unknown key, got 'camera.fov_deg' (did you mean "
              "'fov_y_deg'?), allowed in [camera] "
              "fov_y_deg, roll_deg, pitch_deg, fisheye_fov_deg, turn_deg_s, eye_m, heading_deg, "
              "mount, iso, focal_px, f_number, noise_seed, [[camera.path]], fisheye_k, "
              "full_well_e, near_m, "
              "exposure_s, size_px, velocity_mps, mount_offset_m, projection, read_noise_e, "
              "quaternion, shutter_samples, principal_px"},
        Fault{"[camrea]\nnear_m = 1\n",
              "test.toml:1: column 2: unknown key, got 'camrea' (did you mean 'camera'?), allowed "
              "name, [camera], [air], "
              "[sea], [[lake]], [water], [[camera.path]], [sky], [picture], [coast], [[river]], "
              "[[trees]], [clouds], [wind], [[sea.maps]], [ripples], [terrain], [[sea.swell]], "
              "[[sea.sines]], [detail], [[object]], [[disturbance]], [[clouds.cumulus]]"},
        Fault{"[wind]\nspeed_kn = 3\n",
              "test.toml:2: column 1: unknown key, got 'wind.speed_kn', allowed in [wind] "
              "speed_mps, from_deg"},
        Fault{"[[sea.sines]]\namplitud_m = 3\n",
              "test.toml:2: column 1: unknown key, got 'sea.sines.amplitud_m' (did you mean "
              "'amplitude_m'?), allowed in "
              "[sea.sines] amplitude_m, period_s, wavelength_m, to_deg, phase_deg"},
        Fault{"[[object]]\ncolor = [1, 0, 0]\n",
              "test.toml:2: column 1: unknown key, got 'object.color' (did you mean 'colour'?), "
              "allowed in [object] colour, "
              "motion, file, up, scale, class, kind, top_mark, roll_deg, wake, name, drift, "
              "checker_m, "
              "position_m, path_m, size_m, origin, path_closed, draught, roughness, metalness, "
              "height_m, "
              "speed_mps, heading_deg"},
        Fault{"\"na\\nme\" = 3\n",
              "test.toml:1: column 1: unknown key, got 'na me' (did you mean 'name'?), allowed "
              "name, [[lake]], [air], "
              "[camera], [sky], [sea], [water], [wind], [[sea.maps]], [picture], [ripples], "
              "[coast], [[sea.swell]], [[sea.sines]], [[river]], [[trees]], [clouds], [detail], "
              "[[object]], [terrain], [[camera.path]], [[disturbance]], [[clouds.cumulus]]"},
        Fault{
            "[camera]\nfov = 3\n",
            "test.toml:2: column 1: unknown key, got 'camera.fov', allowed in [camera] fov_y_deg, "
            "mount, iso, focal_px, [[camera.path]], eye_m, roll_deg, near_m, f_number, size_px, "
            "fisheye_k, "
            "quaternion, exposure_s, projection, noise_seed, pitch_deg, fisheye_fov_deg, "
            "full_well_e, velocity_mps, turn_deg_s, read_noise_e, heading_deg, principal_px, "
            "mount_offset_m, shutter_samples"},
        Fault{"[sea]\nstate = 3\n",
              "test.toml:2: column 1: unknown key, got 'sea.state', allowed in [sea] tp_s, seed, "
              "[[sea.maps]], earth, [[sea.swell]], [[sea.sines]], hs_m, spectrum, centre_m, "
              "size_m, gamma, map_set, whitecaps, "
              "beaufort, fetch_km, resolution, tiling, loop_s, douglas, choppiness, gravity_mps2, "
              "map_heights, amplitude_scale, patch_lengths_m"},
        Fault{"[camera]\n\"eye.m\" = 3\n",
              "test.toml:2: column 1: unknown key, got 'camera.eye.m' (did you mean 'eye_m'?), "
              "allowed in [camera] eye_m, near_m, fisheye_k, iso, [[camera.path]], size_px, mount, "
              "exposure_s, f_number, noise_seed, fov_y_deg, roll_deg, velocity_mps, turn_deg_s, "
              "quaternion, "
              "focal_px, projection, read_noise_e, heading_deg, pitch_deg, fisheye_fov_deg, "
              "full_well_e, mount_offset_m, shutter_samples, principal_px"},
        Fault{"a.b = 3\n",
              "test.toml:1: column 1: unknown key, got 'a', allowed [air], [sea], name, [[lake]], "
              "[sky], [water], [coast], [camera], [wind], [detail], [terrain], [[river]], "
              "[[trees]], [clouds], [[sea.maps]], [[object]], [picture], [ripples], [[sea.swell]], "
              "[[sea.sines]], [[camera.path]], [[disturbance]], [[clouds.cumulus]]"},
        Fault{"[[camera.path]]\nt = 0\n",
              "test.toml:2: column 1: unknown key, got 'camera.path.t', allowed in [camera.path] "
              "t_s, eye_m, pitch_deg, roll_deg, heading_deg"},
        Fault{"[terrain]\nheigth = 3\n",
              "test.toml:2: column 1: unknown key, got 'terrain.heigth', allowed in [terrain] "
              "height_image, high_m, seed, method, low_m, island_height_m, coast_m, checker_m, "
              "ground, centre_m, islands, outline_m, boundary, beach_size_m, sea_level_m, "
              "floor_depth_m, "
              "beach_slope, soil_colour, interpolation, dry_colour, rock_slope, sand_colour, "
              "rock_colour, metres_per_pixel, archipelago_size_m, grass_colour, grass_from_m, "
              "island_radius_m"}));

TEST(SceneFileFaults, AnUnknownKeyListsTheKeysOfItsTable) {
  std::set<std::string> tables;
  for (const auto& parameter : scene_parameters())
    tables.insert(std::string(parameter.key.substr(0, parameter.key.find('.'))));
  tables.erase("name");
  for (const std::string& table : tables) {
    const std::string line = error_of("[" + table + "]\nx = 1\n");
    EXPECT_FALSE(line.ends_with("...")) << line;
    for (const auto& parameter : scene_parameters()) {
      if (!parameter.key.starts_with(table + ".")) continue;
      const std::string key(parameter.key.substr(table.size() + 1));
      EXPECT_NE((line + ",").find(" " + key + ","), std::string::npos) << key << ": " << line;
    }
    EXPECT_NE(error_of("x = 1\n").find("[" + table + "]"), std::string::npos);
  }
}

TEST(SceneFileFaults, AMisspeltKeyIsAnsweredWithTheOneThatWasMeant) {
  const auto meant = [](const std::string& text) {
    const std::string error = error_of(text), question = "(did you mean '";
    const std::size_t at = error.find(question);
    if (at == std::string::npos) return std::string();
    return error.substr(at + question.size(), error.find("'?)") - at - question.size());
  };
  EXPECT_EQ(meant("[wind]\nspede_mps = 3\n"), "speed_mps");
  EXPECT_EQ(meant("[[rivr]]\n"), "river");
  EXPECT_EQ(meant("[[sea.swel]]\n"), "swell");
  EXPECT_EQ(meant("[wnid]\n"), "wind");
  EXPECT_EQ(meant("[[object]]\npositon_m = [0, 0]\n"), "position_m");
  EXPECT_EQ(meant("[sea]\nspeed_mps = 3\n"), "wind.speed_mps");  // of another table
  EXPECT_EQ(meant("[sea]\nqqqq = 3\n"), "");
  EXPECT_EQ(meant("x = 3\n"), "");
}

TEST(SceneFileFaults, AtMost2000ObjectsAreTaken) {
  std::string text;
  for (int i = 0; i < 2000; ++i) text += "[[object]]\n";
  EXPECT_EQ(parse_scene(text, "test.toml").objects.size(), 2000u);
  EXPECT_NE(error_of(text + "[[object]]\n").find("allowed at most 2000 tables [[object]]"),
            std::string::npos);
}

TEST(SceneFileFaults, TheFirstOfSeveralFaultsIsTheOneNamed) {
  EXPECT_TRUE(error_of("[water]\nlookup_scale = 7\n[camera]\nnear_m = 77\n")
                  .starts_with("test.toml:2: column 16: water.lookup_scale, got 7,"));
}

TEST(SceneFileFaults, SyntaxErrorsHaveTheirPlace) {
  const auto starts = [](const std::string& text, const std::string& start) {
    const std::string error = error_of(text);
    EXPECT_TRUE(error.starts_with(start)) << error;
    EXPECT_TRUE(error.ends_with(", allowed TOML 1.0")) << error;
  };
  starts("[camera]\nnear_m = 1\nnear_m = 1\n", "test.toml:3: column ");  // twice
  starts("[camera]\nnear_m = 1e999\n", "test.toml:2: column ");
  starts("[camera]\nnear_m = \n", "test.toml:2: column ");
  starts("[camera]\n[camera]\n", "test.toml:2: column ");
  starts("name = \"\xff\"\n", "test.toml:1: column ");  // not UTF-8
  starts("name = 'open\n", "test.toml:1: column ");
  starts(std::string("name = 'a\0b'\n", 13), "test.toml:1: column ");
}

TEST(SceneFileFaults, DeepNestingIsRefusedWithItsLine) {
  const std::string message =
      "test.toml:2: column 1: syntax error, got nesting too deep to be a scene, allowed 16 levels";
  std::string dots = "a";
  for (int i = 0; i < 10000; ++i) dots += ".a";
  EXPECT_EQ(error_of("\n" + dots + " = 1\n"), message);
  EXPECT_EQ(error_of("\n[" + dots + "]\n"), message);
  const std::string arrays(10000, '[');
  EXPECT_EQ(error_of("\na = " + arrays), message);
  std::string tables = "a = ";
  for (int i = 0; i < 10000; ++i) tables += "{a = ";
  EXPECT_EQ(error_of("\n" + tables), message);
  EXPECT_EQ(error_of("# a comment\n" + dots + " = \"\"\"\n\n\"\"\"\n"), message);
}

TEST(SceneFileFaults, DotsAndBracketsInTextAndCommentsAreNoNesting) {
  const std::string many = "................[[[[[[[[[[[[[[[[[[[[[[[[{{{{{{{{{{{{{{{{{{{{{{{";
  EXPECT_EQ(error_of("# \"" + many + "\nname = \"\\\"" + many + "\"  # '" + many + "\n"), "");
  EXPECT_EQ(error_of("name = '''\n" + many + "'\n'''\n"), "");
}

TEST(SceneFileFaults, MessagesAreOneShortLine) {
  const std::string key(5000, 'k');
  const std::string error = error_of("\"" + key + "\\u00e4\\n\" = 1\n");
  EXPECT_LT(error.size(), 500u);
  EXPECT_EQ(std::ranges::count(error, '\n'), 0);
  EXPECT_FALSE(error.empty());
}

}  // namespace
}  // namespace swell::scene
