// Coverage against another rasterizer: Mesa's llvmpipe through OSMesa (RAS-02).
#include <gtest/gtest.h>

#ifdef SWELL_HAVE_OSMESA
#include <GL/gl.h>
#include <GL/osmesa.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "raster/picture.h"
#endif

namespace swell::raster {
namespace {

#ifndef SWELL_HAVE_OSMESA

TEST(Llvmpipe, CoversTheSamePixels) { GTEST_SKIP() << "built without OSMesa (libosmesa6-dev)"; }

#else

constexpr Viewport kView{64, 64};  // powers of two: window = (ndc + 1) * 32 is exact in float

// An off-screen context, current while it lives.
class MesaContext {
 public:
  MesaContext()
      : pixels_(64 * 64 * 4), context_(OSMesaCreateContextExt(OSMESA_RGBA, 0, 0, 0, nullptr)) {
    current_ = context_ != nullptr &&
               OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, 64, 64) == GL_TRUE;
    if (!current_) return;
    glViewport(0, 0, 64, 64);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DITHER);
    glDisable(GL_BLEND);
    glColor4f(1, 1, 1, 1);
  }
  ~MesaContext() {
    if (context_ != nullptr) OSMesaDestroyContext(context_);
  }
  MesaContext(const MesaContext&) = delete;
  MesaContext& operator=(const MesaContext&) = delete;

  bool is_llvmpipe() const {
    if (!current_) return false;
    const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return name != nullptr && std::string(name).find("llvmpipe") != std::string::npos;
  }

  // y mirrored, as the rule of the mirrored rows is then top-left: row y of the result is our row
  // y.
  const std::vector<unsigned char>& draw(const std::array<glm::vec4, 3>& p_clip) {
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
    glBegin(GL_TRIANGLES);
    for (const glm::vec4& p : p_clip) glVertex2f(p.x, -p.y);
    glEnd();
    glFinish();
    return pixels_;
  }

 private:
  std::vector<unsigned char> pixels_;
  OSMesaContext context_;
  bool current_ = false;
};

// On the 1/4096 px grid, wholly on the screen: snapping and ties are compared as well.
std::array<glm::vec4, 3> random_triangle(Random& random) {
  std::array<glm::vec4, 3> p;
  const std::int64_t grid = std::int64_t{1} << random.integer(1, 12);  // steps a pixel
  for (glm::vec4& v : p) {
    const auto coordinate = [&] {
      return static_cast<double>(random.integer(0, 64 * grid)) / static_cast<double>(grid);
    };
    const double x = coordinate();
    v = clip_from_window(x, coordinate(), 0.5, 1.0, kView);
  }
  return p;
}

TEST(Llvmpipe, CoversTheSamePixels) {
  setenv("GALLIUM_DRIVER", "llvmpipe", 1);
  MesaContext mesa;
  if (!mesa.is_llvmpipe()) GTEST_SKIP() << "OSMesa does not run on llvmpipe here";
  Random random(1);
  int wrong = 0, covered = 0;
  for (int n = 0; n < 2000; ++n) {
    const std::array<glm::vec4, 3> p = random_triangle(random);
    constexpr std::uint32_t kIndices[] = {0, 1, 2};
    const Picture picture = draw_picture({.p_clip = p, .indices = kIndices}, kView, 64);
    const std::vector<unsigned char>& theirs = mesa.draw(p);
    for (int i = 0; i < 64 * 64; ++i) wrong += (theirs[4 * i] != 0) != (picture.primitive[i] == 0);
    covered += picture.covered;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(covered, 200'000);
}

#endif

}  // namespace
}  // namespace swell::raster
