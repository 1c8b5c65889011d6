// The window: shows finished pictures. Drawing happens elsewhere, into a buffer of our own; a
// resize, a lost device or a closed window can only cost a presentation.
#pragma once

#include <SDL.h>

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/frame.h"

namespace swell::view {

// There is no display to open a window on; what() is 'no display: why'.
class DisplayError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct WindowSize {
  int width_px = 1, height_px = 1;
  bool operator==(const WindowSize&) const = default;
};

// One at a time, on the main thread. Presents through SDL's software renderer, which is faster
// than OpenGL on a CPU and needs no driver; SDL_RENDER_DRIVER in the environment names another.
class Window {
 public:
  // Throws DisplayError.
  Window(const std::string& title, WindowSize size);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  SDL_Window* handle() const { return window_.get(); }
  SDL_Renderer* renderer() const { return renderer_.get(); }

  // The area to draw, each side in [1, 8192] whatever the window system says.
  WindowSize size_px() const;

  // Pixels of that area for each unit of mouse positions, which count window units.
  glm::vec2 pixels_per_unit() const;

  // False while minimised or hidden.
  bool is_visible() const;

  int refresh_rate_hz() const;
  void toggle_full_screen();

  // Copies the picture into the window's next frame, stretched if the window has another size by
  // now. False if the device refuses; the next call tries again with a new texture.
  bool draw_picture(const render::Target& picture);

  // What was drawn since the last present(): size_px() of red, green, blue and 255, row by row.
  // Black if the device refuses.
  void read_pixels(std::vector<std::uint8_t>& rgba) const;

  // Shows what was drawn since the last call.
  void present();

  // After SDL_RENDER_TARGETS_RESET or SDL_RENDER_DEVICE_RESET: the picture's texture is made anew.
  void forget_textures() { texture_.reset(); }

 private:
  struct Session {  // SDL_Init .. SDL_QuitSubSystem
    Session();
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
  };
  struct Destroy {
    void operator()(SDL_Window* window) const { SDL_DestroyWindow(window); }
    void operator()(SDL_Renderer* renderer) const { SDL_DestroyRenderer(renderer); }
    void operator()(SDL_Texture* texture) const { SDL_DestroyTexture(texture); }
  };
  bool fit_texture(WindowSize size);

  Session session_;
  std::unique_ptr<SDL_Window, Destroy> window_;
  std::unique_ptr<SDL_Renderer, Destroy> renderer_;
  std::unique_ptr<SDL_Texture, Destroy> texture_;
  WindowSize texture_size_;
};

}  // namespace swell::view
