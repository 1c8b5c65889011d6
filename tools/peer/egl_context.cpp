#include "tools/peer/egl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <fmt/core.h>

#include <cstdlib>
#include <stdexcept>

namespace swell::apps {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(fmt::format(
      "OpenGL does not start: {}; Debian's libegl1 and libgl1-mesa-dri have what is needed", what));
}

#define SWELL_EGL_FUNCTIONS(X) \
  X(BindAPI)                   \
  X(CreateContext)             \
  X(DestroyContext)            \
  X(GetError)                  \
  X(GetPlatformDisplay)        \
  X(GetProcAddress)            \
  X(Initialize)                \
  X(MakeCurrent)               \
  X(Terminate)

struct Egl {
#define SWELL_EGL_MEMBER(name) decltype(&egl##name) name = nullptr;
  SWELL_EGL_FUNCTIONS(SWELL_EGL_MEMBER)
#undef SWELL_EGL_MEMBER
};

Egl load_egl() {
  void* const library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
  if (!library) fail(dlerror());
  Egl egl;
#define SWELL_EGL_LOAD(name)                                                    \
  egl.name = reinterpret_cast<decltype(egl.name)>(dlsym(library, "egl" #name)); \
  if (!egl.name) fail("no egl" #name);
  SWELL_EGL_FUNCTIONS(SWELL_EGL_LOAD)
#undef SWELL_EGL_LOAD
  return egl;
}

// Loaded when it is first asked for: nothing else in swell-bench needs Mesa's packages.
const Egl& egl() {
  static const Egl loaded = load_egl();
  return loaded;
}

[[noreturn]] void fail_with_code(const char* what) {
  fail(fmt::format("{} (EGL code {:#x})", what, egl().GetError()));
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
  return egl().CreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kAttributes);
}

Gl load_functions() {
  Gl gl;
#define SWELL_GL_LOAD(name, type) \
  gl.name = reinterpret_cast<PFNGL##type##PROC>(egl().GetProcAddress("gl" #name));
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
  display_ = egl().GetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (!display_) fail_with_code("no display without a window");
  if (!egl().Initialize(display_, nullptr, nullptr)) fail_with_code("no EGL");
  if (egl().BindAPI(EGL_OPENGL_API)) context_ = create_context(display_);
  if (!context_ || !egl().MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
    egl().Terminate(display_);
    fail_with_code("no context of version 3.3");
  }
  gl_ = load_functions();
}

EglContext::~EglContext() {
  egl().MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  egl().DestroyContext(display_, context_);
  egl().Terminate(display_);
}

std::string EglContext::renderer() const { return text_of(gl_, GL_RENDERER); }
std::string EglContext::version() const { return text_of(gl_, GL_VERSION); }

}  // namespace swell::apps
