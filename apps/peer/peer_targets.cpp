#include "apps/peer/peer_targets.h"

#include <stdexcept>

namespace swell::apps {
namespace {

constexpr GLenum kDepthFormat = GL_DEPTH32F_STENCIL8;

// What glTexImage2D wants to know of data that it does not get.
struct PixelLayout {
  GLenum format, type;
};

PixelLayout layout_of(GLenum internal_format) {
  switch (internal_format) {
    case GL_DEPTH32F_STENCIL8:
      return {GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV};
    case GL_DEPTH24_STENCIL8:
      return {GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8};
    case GL_R32F:
      return {GL_RED, GL_FLOAT};
    default:
      return {GL_RGBA, GL_UNSIGNED_BYTE};
  }
}

GLuint make_texture(const Gl& gl) {
  GLuint texture = 0;
  gl.GenTextures(1, &texture);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  return texture;
}

void size_texture(const Gl& gl, GLuint texture, GLenum format, int width_px, int height_px) {
  const PixelLayout layout = layout_of(format);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), width_px, height_px, 0, layout.format,
                layout.type, nullptr);
}

}  // namespace

PeerTarget::PeerTarget(const Gl& gl, GLenum colour_format, GLuint depth)
    : gl_(gl),
      colour_format_(colour_format),
      owns_depth_(depth == 0),
      colour_(make_texture(gl)),
      depth_(depth == 0 ? make_texture(gl) : depth) {
  gl.GenFramebuffers(1, &framebuffer_);
}

void PeerTarget::resize(int width_px, int height_px) {
  if (width_px == width_px_ && height_px == height_px_) return;
  width_px_ = width_px;
  height_px_ = height_px;
  size_texture(gl_, colour_, colour_format_, width_px, height_px);
  if (owns_depth_) size_texture(gl_, depth_, kDepthFormat, width_px, height_px);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_, 0);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D, depth_, 0);
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("OpenGL: a framebuffer cannot be drawn into");
}

void PeerTarget::bind() const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.Viewport(0, 0, width_px_, height_px_);
}

}  // namespace swell::apps
