#include "tools/peer/egl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/core.h>

#include <cstdlib>
#include <stdexcept>

namespace swell::apps {
namespace {

[[noreturn]] void fail(const char* what) {
  throw std::runtime_error(
      fmt::format("OpenGL does not start: {} (EGL code {:#x}); Debian's libgl1-mesa-dri and "
                  "libegl-mesa0 have what "
                  "is needed",
                  what, eglGetError()));
}

void choose_llvmpipe(int threads) {
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  setenv("GALLIUM_DRIVER", "llvmpipe", 1);
  setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
  // Code that Mesa kept from another run may be for another vector width.
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
}

EGLContext create_context(EGLDisplay display) {
  constexpr EGLint kAttributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                    3,
                                    EGL_CONTEXT_MINOR_VERSION,
                                    3,
                                    EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                    EGL_NONE};
  return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kAttributes);
}

Gl load_functions() {
  Gl gl;
#define SWELL_GL_LOAD(name, type) \
  gl.name = reinterpret_cast<PFNGL##type##PROC>(eglGetProcAddress("gl" #name));
  SWELL_GL_FUNCTIONS(SWELL_GL_LOAD)
#undef SWELL_GL_LOAD
  return gl;
}

std::string text_of(const Gl& gl, GLenum name) {
  const GLubyte* text = gl.GetString(name);
  return text ? reinterpret_cast<const char*>(text) : "unknown";
}

}  // namespace

EglContext::EglContext(int threads) {
  choose_llvmpipe(threads);
  display_ = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (!display_) fail("no display without a window");
  if (!eglInitialize(display_, nullptr, nullptr)) fail("no EGL");
  if (eglBindAPI(EGL_OPENGL_API)) context_ = create_context(display_);
  if (!context_ || !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
    eglTerminate(display_);
    fail("no context of version 3.3");
  }
  gl_ = load_functions();
}

EglContext::~EglContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

std::string EglContext::renderer() const { return text_of(gl_, GL_RENDERER); }
std::string EglContext::version() const { return text_of(gl_, GL_VERSION); }

}  // namespace swell::apps
