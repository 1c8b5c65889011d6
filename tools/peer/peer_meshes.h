// The triangles of a frame as OpenGL buffers.
#pragma once

#include <array>

#include "render/view/meshes.h"
#include "tools/peer/gl.h"

namespace swell::apps {

// A vertex array and how many of its indices there are.
class PeerMesh {
 public:
  explicit PeerMesh(const Gl& gl);

  // Water or land: places relative to the eye and heights.
  void take(const render::Surface& surface);
  // Objects: their corners triangle by triangle, each with its normal and colour.
  void take(const render::ObjectDraws& objects);

  bool empty() const { return index_count_ == 0; }
  void draw() const;

 private:
  // The next vertex attribute: `components` floats a vertex.
  void add_attribute(int components, const void* data, std::size_t vertices);
  void set_indices(const void* data, std::size_t count);
  void begin();

  const Gl& gl_;
  GLuint array_ = 0, indices_ = 0;
  std::array<GLuint, 5> attributes_{};
  std::size_t attribute_count_ = 0;
  GLsizei index_count_ = 0;
};

}  // namespace swell::apps
