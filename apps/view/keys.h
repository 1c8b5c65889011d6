// Which key does what.
#pragma once

#include <SDL.h>

#include <bitset>
#include <optional>
#include <span>

#include "apps/view/camera_controls.h"

namespace swell::view {

enum class Command {
  kHelp,
  kPanel,
  kWireframe,
  kLabel,
  kFullScreen,
  kScreenshot,
  kPause,
  kStep,
  kResetCamera,
  kCopyCamera,
  kSaveScene,
  kEscape
};

// The command of a key that acts once when it goes down.
std::optional<Command> command_for(SDL_Keycode key);

// The sea state, [0, 9], that a key chooses.
std::optional<int> sea_state_for(SDL_Keycode key);

// Keys held down, by place on the keyboard.
using HeldKeys = std::bitset<SDL_NUM_SCANCODES>;

// The motion that the held keys ask for; no mouse motion.
CameraInput motion_of(const HeldKeys& held);

// The help screen's rows: of a window, or of a browser, which gives the viewer fewer keys.
struct KeyHelp {
  const char* keys;
  const char* what;
};
std::span<const KeyHelp> key_help(bool in_browser = false);

}  // namespace swell::view
