#include "apps/view/window.h"

#include <algorithm>
#include <cstdlib>

namespace swell::view {
namespace {

constexpr int kLargestSide_px = 8192;

int clamp_side(int side_px) { return std::clamp(side_px, 1, kLargestSide_px); }

[[noreturn]] void fail(const std::string& what) {
  throw DisplayError("no display: " + what + ": " + SDL_GetError());
}

// Names the window systems to try. Left to itself SDL ends with drivers that draw nowhere, and a
// viewer without a display would run on unseen.
void choose_video_driver() {
  if (std::getenv("SDL_VIDEODRIVER")) return;
  std::string drivers;
  if (std::getenv("WAYLAND_DISPLAY")) drivers = "wayland";
  if (std::getenv("DISPLAY")) drivers = drivers.empty() ? "x11" : "x11," + drivers;
  if (drivers.empty()) throw DisplayError("no display: neither DISPLAY nor WAYLAND_DISPLAY is set");
  SDL_SetHint(SDL_HINT_VIDEODRIVER, drivers.c_str());
}

}  // namespace

Window::Session::Session() {
  choose_video_driver();
  // SDL's defaults would put even the software renderer's surface through OpenGL.
  SDL_SetHintWithPriority(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0", SDL_HINT_DEFAULT);
  SDL_SetHintWithPriority(SDL_HINT_RENDER_DRIVER, "software", SDL_HINT_DEFAULT);
  SDL_SetHintWithPriority(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0", SDL_HINT_DEFAULT);
  if (SDL_Init(SDL_INIT_VIDEO) != 0) fail("cannot reach a screen");
}

Window::Session::~Session() { SDL_Quit(); }

Window::Window(const std::string& title, WindowSize size) {
  window_.reset(SDL_CreateWindow(title.c_str(), SDL_WINDOWPOS_UNDEFINED, SDL_WINDOWPOS_UNDEFINED,
                                 clamp_side(size.width_px), clamp_side(size.height_px),
                                 SDL_WINDOW_RESIZABLE));
  if (!window_) fail("cannot open a window");
  renderer_.reset(SDL_CreateRenderer(window_.get(), -1, 0));
  if (!renderer_) renderer_.reset(SDL_CreateRenderer(window_.get(), -1, SDL_RENDERER_SOFTWARE));
  if (!renderer_) fail("cannot draw in the window");
}

Window::~Window() = default;

WindowSize Window::size_px() const {
  int width = 0, height = 0;
  if (SDL_GetRendererOutputSize(renderer_.get(), &width, &height) != 0)
    SDL_GetWindowSize(window_.get(), &width, &height);
  return {clamp_side(width), clamp_side(height)};
}

glm::vec2 Window::pixels_per_unit() const {
  int width = 0, height = 0;
  SDL_GetWindowSize(window_.get(), &width, &height);
  const WindowSize pixels = size_px();
  return glm::vec2(pixels.width_px, pixels.height_px) /
         glm::vec2(clamp_side(width), clamp_side(height));
}

bool Window::is_visible() const {
  return (SDL_GetWindowFlags(window_.get()) & (SDL_WINDOW_MINIMIZED | SDL_WINDOW_HIDDEN)) == 0;
}

int Window::refresh_rate_hz() const {
  SDL_DisplayMode mode;
  const int display = SDL_GetWindowDisplayIndex(window_.get());
  const bool known = display >= 0 && SDL_GetCurrentDisplayMode(display, &mode) == 0;
  return known && mode.refresh_rate >= 30 ? mode.refresh_rate : 60;
}

void Window::toggle_full_screen() {
  const bool is_full = (SDL_GetWindowFlags(window_.get()) & SDL_WINDOW_FULLSCREEN_DESKTOP) != 0;
  SDL_SetWindowFullscreen(window_.get(), is_full ? 0 : SDL_WINDOW_FULLSCREEN_DESKTOP);
}

bool Window::fit_texture(WindowSize size) {
  if (texture_ && texture_size_ == size) return true;
  texture_.reset(SDL_CreateTexture(renderer_.get(), SDL_PIXELFORMAT_ABGR8888,
                                   SDL_TEXTUREACCESS_STREAMING, size.width_px, size.height_px));
  if (!texture_) return false;
  SDL_SetTextureBlendMode(texture_.get(), SDL_BLENDMODE_NONE);
  texture_size_ = size;
  return true;
}

bool Window::draw_picture(const render::Target& picture) {
  SDL_SetRenderDrawColor(renderer_.get(), 0, 0, 0, 255);
  if (!fit_texture({picture.width_px, picture.height_px}) ||
      SDL_UpdateTexture(texture_.get(), nullptr, picture.rgba.data(), picture.width_px * 4) != 0 ||
      SDL_RenderCopy(renderer_.get(), texture_.get(), nullptr, nullptr) != 0) {
    texture_.reset();
    SDL_RenderClear(renderer_.get());
    return false;
  }
  return true;
}

void Window::read_pixels(std::vector<std::uint8_t>& rgba) const {
  const WindowSize size = size_px();
  rgba.resize(4u * static_cast<std::size_t>(size.width_px) *
              static_cast<std::size_t>(size.height_px));
  if (SDL_RenderReadPixels(renderer_.get(), nullptr, SDL_PIXELFORMAT_ABGR8888, rgba.data(),
                           4 * size.width_px) != 0)
    std::ranges::fill(rgba, std::uint8_t{0});
}

void Window::present() { SDL_RenderPresent(renderer_.get()); }

}  // namespace swell::view
