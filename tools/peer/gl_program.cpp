#include "tools/peer/gl_program.h"

#include <array>
#include <stdexcept>

namespace swell::apps {
namespace {

// `get_log` is glGetShaderInfoLog or glGetProgramInfoLog.
[[noreturn]] void fail(const char* what, GLuint object, PFNGLGETSHADERINFOLOGPROC get_log) {
  std::array<char, 4096> log{};
  get_log(object, static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw std::runtime_error(std::string("OpenGL: ") + what + ": " + log.data());
}

GLuint compile(const Gl& gl, GLenum stage, const std::string& defines, const std::string& text) {
  const GLuint shader = gl.CreateShader(stage);
  const std::string whole = "#version 330 core\n" + defines + text;
  const char* const lines = whole.c_str();
  gl.ShaderSource(shader, 1, &lines, nullptr);
  gl.CompileShader(shader);
  GLint done = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (!done) fail("a shader does not compile", shader, gl.GetShaderInfoLog);
  return shader;
}

}  // namespace

GlProgram::GlProgram(const Gl& gl, const ProgramText& text) : gl_(gl) {
  program_ = gl.CreateProgram();
  for (const GLuint shader : {compile(gl, GL_VERTEX_SHADER, text.defines, text.vertex),
                              compile(gl, GL_FRAGMENT_SHADER, text.defines, text.fragment)}) {
    gl.AttachShader(program_, shader);
    gl.DeleteShader(shader);
  }
  gl.LinkProgram(program_);
  GLint done = 0;
  gl.GetProgramiv(program_, GL_LINK_STATUS, &done);
  if (!done) fail("a program does not link", program_, gl.GetProgramInfoLog);
}

GLint GlProgram::location(const std::string& name) const {
  use();
  return gl_.GetUniformLocation(program_, name.c_str());
}

void GlProgram::set(const std::string& name, float value) const {
  gl_.Uniform1f(location(name), value);
}

void GlProgram::set(const std::string& name, glm::vec2 v) const {
  gl_.Uniform2f(location(name), v.x, v.y);
}

void GlProgram::set(const std::string& name, glm::vec3 v) const {
  gl_.Uniform3f(location(name), v.x, v.y, v.z);
}

void GlProgram::set(const std::string& name, const glm::vec4& v) const {
  gl_.Uniform4fv(location(name), 1, &v.x);
}

void GlProgram::set(const std::string& name, const glm::mat4& value) const {
  gl_.UniformMatrix4fv(location(name), 1, GL_FALSE, &value[0][0]);
}

void GlProgram::set(const std::string& name, std::span<const glm::vec4> values) const {
  if (values.empty()) return;
  gl_.Uniform4fv(location(name), static_cast<GLsizei>(values.size()), &values[0][0]);
}

void GlProgram::set_sampler(const std::string& name, int unit) const {
  gl_.Uniform1i(location(name), unit);
}

}  // namespace swell::apps
