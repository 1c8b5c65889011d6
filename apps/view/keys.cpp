#include "apps/view/keys.h"

#include <array>

namespace swell::view {

std::optional<Command> command_for(SDL_Keycode key) {
  struct Binding {
    SDL_Keycode key;
    Command command;
  };
  static constexpr std::array kBindings = {
      Binding{SDLK_F1, Command::kHelp},        Binding{SDLK_F2, Command::kPanel},
      Binding{SDLK_h, Command::kPanel},        Binding{SDLK_F3, Command::kWireframe},
      Binding{SDLK_F4, Command::kLabel},       Binding{SDLK_F11, Command::kFullScreen},
      Binding{SDLK_F12, Command::kScreenshot}, Binding{SDLK_p, Command::kPause},
      Binding{SDLK_PERIOD, Command::kStep},    Binding{SDLK_r, Command::kResetCamera},
      Binding{SDLK_c, Command::kCopyCamera},   Binding{SDLK_F5, Command::kSaveScene},
      Binding{SDLK_ESCAPE, Command::kEscape},
  };
  for (const Binding& binding : kBindings)
    if (binding.key == key) return binding.command;
  return std::nullopt;
}

std::optional<int> sea_state_for(SDL_Keycode key) {
  if (key < SDLK_0 || key > SDLK_9) return std::nullopt;
  return key - SDLK_0;
}

CameraInput motion_of(const HeldKeys& held) {
  CameraInput input;
  input.forward = held[SDL_SCANCODE_W];
  input.back = held[SDL_SCANCODE_S];
  input.left = held[SDL_SCANCODE_A];
  input.right = held[SDL_SCANCODE_D];
  input.up = held[SDL_SCANCODE_E] || held[SDL_SCANCODE_SPACE];
  input.down = held[SDL_SCANCODE_Q] || held[SDL_SCANCODE_LCTRL] || held[SDL_SCANCODE_RCTRL];
  input.fast = held[SDL_SCANCODE_LSHIFT] || held[SDL_SCANCODE_RSHIFT];
  return input;
}

std::span<const KeyHelp> key_help(bool in_browser) {
  static constexpr std::array kInBrowser = {
      KeyHelp{"W A S D", "fly"},
      KeyHelp{"E, Space", "up"},
      KeyHelp{"Q", "down"},
      KeyHelp{"Shift", "fast"},
      KeyHelp{"drag", "look around"},
      KeyHelp{"middle button", "drop a stone into the water"},
      KeyHelp{"R", "back to the scene's camera"},
      KeyHelp{"C", "copy the camera as TOML"},
      KeyHelp{"0 ... 9", "the sea state of this number (WMO): calm to phenomenal"},
      KeyHelp{"P", "pause"},
      KeyHelp{".", "pause and step by 1/60 s"},
      KeyHelp{"F1", "this help"},
      KeyHelp{"F2, H", "panel"},
      KeyHelp{"F3", "triangles, tinted by level of detail"},
      KeyHelp{"F4", "the next label as a picture: depth ... flags, then colour"},
  };
  static constexpr std::array kInWindow = {
      KeyHelp{"W A S D", "fly"},
      KeyHelp{"E, Space", "up"},
      KeyHelp{"Q, Ctrl", "down"},
      KeyHelp{"Shift", "fast"},
      KeyHelp{"right button held", "look around"},
      KeyHelp{"left click", "look around until Esc"},
      KeyHelp{"middle button", "drop a stone into the water"},
      KeyHelp{"R", "back to the scene's camera"},
      KeyHelp{"C", "copy the camera as TOML"},
      KeyHelp{"0 ... 9", "the sea state of this number (WMO): calm to phenomenal"},
      KeyHelp{"P", "pause"},
      KeyHelp{".", "pause and step by 1/60 s"},
      KeyHelp{"F1", "this help"},
      KeyHelp{"F2, H", "panel"},
      KeyHelp{"F3", "triangles, tinted by level of detail"},
      KeyHelp{"F4", "the next label as a picture: depth ... flags, then colour"},
      KeyHelp{"F5", "save the scene as it is now, as TOML"},
      KeyHelp{"F11", "full screen"},
      KeyHelp{"F12", "screenshot, at full quality"},
      KeyHelp{"Esc", "release the mouse, then quit"},
  };
  if (in_browser) return kInBrowser;
  return kInWindow;
}

}  // namespace swell::view
