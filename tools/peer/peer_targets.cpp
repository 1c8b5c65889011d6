#include "tools/peer/peer_targets.h"

#include <stdexcept>

namespace swell::apps {
namespace {

// Clamped, with bilinear weights.
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

}  // namespace

PeerTarget::PeerTarget(const Gl& gl)
    : gl_(gl), colour_(make_texture(gl)), distance_(make_texture(gl)), depth_(make_texture(gl)) {
  gl.GenFramebuffers(1, &colour_framebuffer_);
  gl.GenFramebuffers(1, &distance_framebuffer_);
}

void PeerTarget::resize(int width_px, int height_px) {
  if (width_px == width_px_ && height_px == height_px_) return;
  width_px_ = width_px;
  height_px_ = height_px;
  const auto size = [&](GLuint texture, GLint stored, GLenum format, GLenum type) {
    gl_.BindTexture(GL_TEXTURE_2D, texture);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, stored, width_px, height_px, 0, format, type, nullptr);
  };
  size(colour_, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE);
  size(distance_, GL_R32F, GL_RED, GL_FLOAT);
  size(depth_, GL_DEPTH32F_STENCIL8, GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV);
  attach(colour_framebuffer_, colour_);
  attach(distance_framebuffer_, distance_);
}

void PeerTarget::attach(GLuint framebuffer, GLuint texture) const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D, depth_, 0);
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("OpenGL: a framebuffer cannot be drawn into");
}

void PeerTarget::bind(GLuint framebuffer) const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl_.Viewport(0, 0, width_px_, height_px_);
}

}  // namespace swell::apps
