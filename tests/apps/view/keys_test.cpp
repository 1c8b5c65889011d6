#include "apps/view/keys.h"

#include <gtest/gtest.h>

namespace swell::view {
namespace {

TEST(Keys, TheKeysOfTheHelpScreenDoWhatItSays) {
  EXPECT_EQ(command_for(SDLK_F1), Command::kHelp);
  EXPECT_EQ(command_for(SDLK_F2), Command::kPanel);
  EXPECT_EQ(command_for(SDLK_F3), Command::kWireframe);
  EXPECT_EQ(command_for(SDLK_F4), Command::kLabel);
  EXPECT_EQ(command_for(SDLK_F5), Command::kSaveScene);
  EXPECT_EQ(command_for(SDLK_F11), Command::kFullScreen);
  EXPECT_EQ(command_for(SDLK_F12), Command::kScreenshot);
  EXPECT_EQ(command_for(SDLK_p), Command::kPause);
  EXPECT_EQ(command_for(SDLK_PERIOD), Command::kStep);
  EXPECT_EQ(command_for(SDLK_c), Command::kCopyCamera);
  EXPECT_EQ(command_for(SDLK_ESCAPE), Command::kEscape);
  EXPECT_EQ(command_for(SDLK_w), std::nullopt);
}

TEST(Keys, DigitsChooseSeaStatesAndNothingElseDoes) {
  EXPECT_EQ(sea_state_for(SDLK_0), 0);
  EXPECT_EQ(sea_state_for(SDLK_5), 5);
  EXPECT_EQ(sea_state_for(SDLK_9), 9);
  EXPECT_EQ(sea_state_for(SDLK_9 + 1), std::nullopt);
  EXPECT_EQ(sea_state_for(SDLK_F5), std::nullopt);
  EXPECT_EQ(command_for(SDLK_5), std::nullopt);
}

TEST(Keys, NoKeysAskForNoMotion) { EXPECT_TRUE(is_idle(motion_of({}))); }

TEST(Keys, LettingGoOfOneOfTwoKeysForUpGoesOnUp) {
  HeldKeys held;
  held.set(SDL_SCANCODE_E).set(SDL_SCANCODE_SPACE);
  held.reset(SDL_SCANCODE_E);
  EXPECT_TRUE(motion_of(held).up);
}

TEST(Keys, EveryMotionHasItsKey) {
  const auto held = [](SDL_Scancode key) { return motion_of(HeldKeys().set(key)); };
  EXPECT_TRUE(held(SDL_SCANCODE_W).forward);
  EXPECT_TRUE(held(SDL_SCANCODE_S).back);
  EXPECT_TRUE(held(SDL_SCANCODE_A).left);
  EXPECT_TRUE(held(SDL_SCANCODE_D).right);
  EXPECT_TRUE(held(SDL_SCANCODE_Q).down);
  EXPECT_TRUE(held(SDL_SCANCODE_LCTRL).down);
  EXPECT_TRUE(held(SDL_SCANCODE_E).up);
  EXPECT_TRUE(held(SDL_SCANCODE_LSHIFT).fast);
  EXPECT_TRUE(is_idle(held(SDL_SCANCODE_LSHIFT)));
}

}  // namespace
}  // namespace swell::view
