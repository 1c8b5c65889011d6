// Dear ImGui in a window of ours: its SDL2 platform part comes with the library, its draw lists
// go to SDL_RenderGeometryRaw here.
#pragma once

#include <SDL.h>

#include <glm/glm.hpp>
#include <optional>

struct ImDrawList;

namespace swell::view {

// One at a time: Dear ImGui keeps its state in the process.
class Gui {
 public:
  // Both must outlive this. Throws std::runtime_error if the two cannot be joined.
  Gui(SDL_Window* window, SDL_Renderer* renderer);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  void handle(const SDL_Event& event);
  bool wants_mouse() const;  // the pointer is over a panel, or drags something of one
  bool wants_text() const;   // a number is being typed

  // Around the calls that build the panels.
  void begin_frame();
  void end_frame();

  // Draws the panels of the last begin_frame/end_frame over what the renderer holds.
  void draw();

  // After the device was reset: the font's texture is made anew at the next draw.
  void forget_textures();

 private:
  bool make_font_texture();
  void draw_list(const ImDrawList& list) const;

  SDL_Renderer* renderer_;
  SDL_Texture* font_ = nullptr;
  std::optional<glm::vec2> pointer_;  // over the window, in its own units
};

}  // namespace swell::view
