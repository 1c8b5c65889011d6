// An OpenGL 3.3 core context without a window, on Mesa's software rasterizer llvmpipe.
#pragma once

#include <string>

#include "tools/peer/gl.h"

namespace swell::apps {

// One at a time, used on the thread that made it. What is made in it lives as long as it.
class EglContext {
 public:
  // `threads` rasterizing threads in [1, 256]; llvmpipe takes at most 16. Sets environment
  // variables that Mesa reads, so no other thread may read the environment meanwhile. Throws
  // std::runtime_error if there is no such context.
  explicit EglContext(int threads);
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  const Gl& gl() const { return gl_; }
  std::string renderer() const;  // "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string version() const;   // "3.3 (Core Profile) Mesa 22.3.6"

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
  Gl gl_;
};

}  // namespace swell::apps
