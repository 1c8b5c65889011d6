// What the peer draws a view into.
#pragma once

#include "tools/peer/gl.h"

namespace swell::apps {

// Three textures of one size: colours; the distance along the view of what is shaded later; depth
// and stencil. Depths are reversed, as Swell's: near / distance, 0 infinitely far.
class PeerTarget {
 public:
  explicit PeerTarget(const Gl& gl);

  void resize(int width_px, int height_px);
  // For drawing, with the viewport. Both have the same depth and stencil.
  void bind_colour() const { bind(colour_framebuffer_); }
  void bind_distance() const { bind(distance_framebuffer_); }
  GLuint colour() const { return colour_; }
  GLuint distance() const { return distance_; }
  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }

 private:
  void bind(GLuint framebuffer) const;
  void attach(GLuint framebuffer, GLuint texture) const;

  const Gl& gl_;
  GLuint colour_framebuffer_ = 0, distance_framebuffer_ = 0;
  GLuint colour_ = 0, distance_ = 0, depth_ = 0;
  int width_px_ = 0, height_px_ = 0;
};

}  // namespace swell::apps
