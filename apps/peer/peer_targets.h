// What the peer draws into.
#pragma once

#include "apps/peer/gl.h"

namespace swell::apps {

// A colour and a depth texture. Depths are reversed, as Swell's: near / distance, 0 infinitely far.
class PeerTarget {
 public:
  // `depth` may be another target's; then that one is sized first.
  PeerTarget(const Gl& gl, GLenum colour_format, GLuint depth = 0);

  void resize(int width_px, int height_px);
  void bind() const;  // for drawing, with the viewport
  GLuint colour() const { return colour_; }
  GLuint depth() const { return depth_; }
  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }

 private:
  const Gl& gl_;
  GLenum colour_format_;
  bool owns_depth_;
  GLuint framebuffer_ = 0, colour_ = 0, depth_ = 0;
  int width_px_ = 0, height_px_ = 0;
};

}  // namespace swell::apps
