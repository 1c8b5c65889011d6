#include "apps/view/gui.h"

#if __has_include(<backends/imgui_impl_sdl2.h>)
#include <backends/imgui_impl_sdl2.h>  // from Dear ImGui 1.89 on
#else
#include <backends/imgui_impl_sdl.h>
#endif
#include <imgui.h>
#include <imgui_internal.h>  // its windows

#include <algorithm>
#include <cfloat>
#include <stdexcept>

namespace swell::view {
namespace {

void set_style() {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 0.0f;  // rounded corners cost hundreds of triangles
  style.FrameRounding = 0.0f;
  style.ItemSpacing.y = 3.0f;  // the panel fits a window of 720 rows
  style.AntiAliasedLines = false;
  style.AntiAliasedFill = false;
  style.Colors[ImGuiCol_WindowBg].w = 0.75f;
}

// The command's rectangle inside the window; false if nothing of it is.
bool clip_rect(const ImVec4& rect, const ImVec2& display_size, SDL_Rect& clip) {
  const int x0 = static_cast<int>(std::max(rect.x, 0.0f));
  const int y0 = static_cast<int>(std::max(rect.y, 0.0f));
  const int x1 = static_cast<int>(std::min(rect.z, display_size.x));
  const int y1 = static_cast<int>(std::min(rect.w, display_size.y));
  clip = {x0, y0, x1 - x0, y1 - y0};
  return x1 > x0 && y1 > y0;
}

}  // namespace

Gui::Gui(SDL_Window* window, SDL_Renderer* renderer) : renderer_(renderer) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // leaves no file behind
  io.BackendRendererName = "swell SDL_Renderer";
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  set_style();
#if IMGUI_VERSION_NUM >= 18700
  const bool is_usable = ImGui_ImplSDL2_InitForSDLRenderer(window, renderer);
#else
  const bool is_usable = ImGui_ImplSDL2_InitForSDLRenderer(window);
#endif
  if (!is_usable) {
    ImGui::DestroyContext();
    throw std::runtime_error("Dear ImGui cannot use this window");
  }
}

Gui::~Gui() {
  forget_textures();
  ImGui_ImplSDL2_Shutdown();
  ImGui::DestroyContext();
}

void Gui::handle(const SDL_Event& event) {
  ImGui_ImplSDL2_ProcessEvent(&event);
  if (event.type == SDL_MOUSEMOTION && !SDL_GetRelativeMouseMode())
    pointer_ = glm::vec2(event.motion.x, event.motion.y);
  if (event.type == SDL_WINDOWEVENT && event.window.event == SDL_WINDOWEVENT_LEAVE &&
      !ImGui::IsAnyMouseDown())
    pointer_.reset();
}

// By where the pointer is now. Dear ImGui's own answer is of its last frame, when a pointer that
// moves and presses at once (a remote desktop's) was elsewhere.
bool Gui::wants_mouse() const {
  if (ImGui::IsAnyItemActive()) return true;
  if (!pointer_) return false;
  const auto is_under = [this](const ImGuiWindow* window) {
    return window->WasActive && !window->Hidden && !(window->Flags & ImGuiWindowFlags_NoInputs) &&
           window->Rect().Contains({pointer_->x, pointer_->y});
  };
  return std::ranges::any_of(ImGui::GetCurrentContext()->Windows, is_under);
}

bool Gui::wants_text() const { return ImGui::GetIO().WantTextInput; }

void Gui::begin_frame() {
  // Dear ImGui needs its font laid out before the first frame, with or without a texture of it.
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
  ImGui_ImplSDL2_NewFrame();
#if IMGUI_VERSION_NUM >= 18700 && IMGUI_VERSION_NUM < 19150 && \
    !defined(IMGUI_DISABLE_OBSOLETE_KEYIO)
  // Its way of old to know keys, by their place on the keyboard, ends the program where a place
  // stands for two keys: where it is unknown (a remote desktop's), or the layout changes.
  std::ranges::fill(ImGui::GetIO().KeyMap, -1);
  std::ranges::fill(ImGui::GetIO().KeysDown, false);
#endif
  // That asks X for the pointer's place on the screen, which SDL knows from the motion of devices
  // alone: where a program moves the pointer (a remote desktop, a test) it is that of the last
  // press. Events have the place in the window always.
  ImGui::GetIO().MousePos =
      pointer_ ? ImVec2(pointer_->x, pointer_->y) : ImVec2(-FLT_MAX, -FLT_MAX);
  ImGui::NewFrame();
}

void Gui::end_frame() { ImGui::Render(); }

void Gui::forget_textures() {
  if (font_) SDL_DestroyTexture(font_);
  font_ = nullptr;
}

bool Gui::make_font_texture() {
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
  font_ = SDL_CreateTexture(renderer_, SDL_PIXELFORMAT_ABGR8888, SDL_TEXTUREACCESS_STATIC, width,
                            height);
  if (!font_) return false;
  SDL_UpdateTexture(font_, nullptr, pixels, 4 * width);
  SDL_SetTextureBlendMode(font_, SDL_BLENDMODE_BLEND);
  return true;
}

void Gui::draw() {
  const ImDrawData* data = ImGui::GetDrawData();
  if (!data || data->DisplaySize.x < 1.0f || data->DisplaySize.y < 1.0f) return;
  if (!font_ && !make_font_texture()) return;
  for (int i = 0; i < data->CmdListsCount; ++i) draw_list(*data->CmdLists[i]);
  SDL_RenderSetClipRect(renderer_, nullptr);
}

void Gui::draw_list(const ImDrawList& list) const {
  constexpr int kStride = sizeof(ImDrawVert);
  const ImVec2 display_size = ImGui::GetIO().DisplaySize;
  for (const ImDrawCmd& command : list.CmdBuffer) {
    SDL_Rect clip;
    if (command.UserCallback || !clip_rect(command.ClipRect, display_size, clip)) continue;
    SDL_RenderSetClipRect(renderer_, &clip);

    // Positions, colours and texture coordinates lie interleaved in ImDrawVert.
    const ImDrawVert* vertices = list.VtxBuffer.Data + command.VtxOffset;
    const int vertex_count = list.VtxBuffer.Size - static_cast<int>(command.VtxOffset);
    const auto* colours = reinterpret_cast<const SDL_Color*>(&vertices->col);
    SDL_RenderGeometryRaw(renderer_, font_, &vertices->pos.x, kStride, colours, kStride,
                          &vertices->uv.x, kStride, vertex_count,
                          list.IdxBuffer.Data + command.IdxOffset,
                          static_cast<int>(command.ElemCount), sizeof(ImDrawIdx));
  }
}

}  // namespace swell::view
