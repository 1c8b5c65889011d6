// A shader program: its text, its constants, its textures.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>

#include "tools/peer/gl.h"

namespace swell::apps {

struct ProgramText {
  std::string defines;  // lines put after "#version 330 core"
  std::string vertex, fragment;
};

class GlProgram {
 public:
  // Throws std::runtime_error with the compiler's words.
  GlProgram(const Gl& gl, const ProgramText& text);

  void use() const { gl_.UseProgram(program_); }

  // Constants, kept until they are set again; names that the compiler removed are skipped. They
  // make the program the current one.
  void set(const std::string& name, float value) const;
  void set(const std::string& name, glm::vec2 value) const;
  void set(const std::string& name, glm::vec3 value) const;
  void set(const std::string& name, const glm::vec4& value) const;
  void set(const std::string& name, const glm::mat4& value) const;
  void set(const std::string& name, std::span<const glm::vec4> values) const;
  // The sampler reads from this texture unit.
  void set_sampler(const std::string& name, int unit) const;

 private:
  GLint location(const std::string& name) const;

  const Gl& gl_;
  GLuint program_ = 0;
};

}  // namespace swell::apps
