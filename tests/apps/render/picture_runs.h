// Runs of swell-render that keep their pictures, so that two runs can be compared pixel by pixel.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "apps/shared/program_runner.h"
#include "texture/image/image.h"

namespace swell::apps {

// The frames of one run: printed hashes and pictures by frame number.
struct PictureRun {
  std::map<int, std::string> hashes;
  std::map<int, std::filesystem::path> pictures;
};

// Runs swell-render on a scene file at 160 x 90 with more arguments; the pictures go into `folder`
// under a name of their own. A run that fails is a failure of the test.
PictureRun run_pictures(const std::string& scene, const ScratchFolder& folder,
                        const Arguments& more);

// Fails the test unless both runs have the same frames with the same hashes. `name` says what is
// compared; it becomes a part of file names.
void expect_same_pictures(const PictureRun& actual, const PictureRun& expected,
                          const std::string& name);

// Fails the test unless these frames of both runs have the same hash; `name` as above.
void expect_same_picture(const PictureRun& actual, int actual_frame, const PictureRun& expected,
                         int expected_frame, const std::string& name);

// Says how many pixels differ and where the first one is, or nothing if the pictures are equal;
// then writes both and their difference, eight times enlarged, as `name`_*.png into `folder`.
std::string picture_difference(const texture::Image8& actual, const texture::Image8& expected,
                               const std::filesystem::path& folder, const std::string& name);

// Where pictures that should be equal and are not are kept.
std::filesystem::path difference_folder();

// The name of the running test, then `name`: letters, digits, '_' and '-' only.
std::string picture_name(const std::string& name);

}  // namespace swell::apps
