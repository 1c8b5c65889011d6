#include "tools/peer/peer.h"

#include <chrono>
#include <optional>
#include <stdexcept>

#include "render/workspace.h"
#include "tools/peer/egl_context.h"
#include "tools/peer/peer_maps.h"
#include "tools/peer/peer_meshes.h"
#include "tools/peer/peer_programs.h"
#include "tools/peer/peer_targets.h"
#include "tools/peer/texture_units.h"

namespace swell::apps {

using render::Workspace;

namespace {

// In the stencil buffer.
constexpr int kWaterMark = 1, kLandMark = 2;

}  // namespace

struct Peer::State {
  explicit State(int threads);

  void take_maps(const render::FrameState& frame);
  void bind_texture(int unit, GLuint texture) const;
  void bind_layer(int unit, const render::SlopeLayer& layer, Levels levels, bool changed);
  void draw_pass(PeerPass pass) const;
  void draw_planar_map(const PeerTarget& target, const ViewPrograms& programs) const;
  void draw_visible(const PeerTarget& target, const ViewPrograms& programs, bool is_window) const;
  void shade_marked(const GlProgram& program, int mark) const;
  void draw_sky() const;
  void draw_over_screen(const GlProgram& program) const;

  EglContext context;
  const Gl& gl = context.gl();
  PeerMaps maps{gl};
  PeerMesh water{gl}, land{gl}, objects{gl};
  PeerTarget window{gl}, reflection{gl}, refraction{gl};
  GLuint screen = 0;  // a vertex array without vertices
  std::string features;
  std::optional<PeerPrograms> programs;
};

Peer::State::State(int threads) : context(threads) {
  gl.GenVertexArrays(1, &screen);
  gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_GREATER);
  gl.CullFace(GL_FRONT);
  gl.ClearDepth(0.0);
  gl.ClearColor(0.0f, 0.0f, 0.0f, 0.0f);
}

// --- Taking over a frame

void Peer::State::bind_texture(int unit, GLuint texture) const {
  gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  gl.BindTexture(GL_TEXTURE_2D, texture);
}

void Peer::State::bind_layer(int unit, const render::SlopeLayer& layer, Levels levels,
                             bool changed) {
  gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));  // which an upload binds to as well
  bind_texture(unit, maps.slopes(layer, levels, changed));
}

void Peer::State::take_maps(const render::FrameState& frame) {
  const render::Shading& s = frame.shading;
  const auto& sea = s.material<render::Water>();
  bind_texture(kSkySoftUnit, maps.image(*s.light.sky_soft));
  gl.ActiveTexture(GL_TEXTURE0 + kSkyMapUnit);  // which an upload binds to as well
  bind_texture(kSkyMapUnit, maps.changing_image(*s.light.sky_map));
  // Where there is surf nobody sees the step between two levels of the noise.
  bind_layer(kNoiseUnit, sea.uv_noise, sea.trains.on ? Levels::kNearest : Levels::kBlended, true);
  for (int i = 0; i < sea.layer_count; ++i) {
    const bool is_patch = i < sea.layer_count - 2;  // the last two are ripples, whose map stays
    bind_layer(kFirstLayerUnit + i, sea.layers[static_cast<std::size_t>(i)], Levels::kBlended,
               is_patch);
  }
  if (sea.trains.on) {
    bind_layer(kFoamUnit, sea.foam_lace, Levels::kNearest, false);
    bind_layer(kCoastSlopesUnit, sea.trains.slopes, Levels::kBlended, true);
    bind_layer(kCoastSurfUnit, sea.trains.surf, Levels::kNearest, true);
  }
  const auto& terrain = s.material<render::Terrain>();
  if (terrain.albedo.map.texels) {
    bind_layer(kTerrainSlopesUnit, terrain.slopes, Levels::kBlended, false);
    bind_layer(kAroundSlopesUnit, terrain.slopes_around, Levels::kBlended, false);
    bind_layer(kDetailUnit, terrain.detail, Levels::kBlended, false);
    bind_texture(kAlbedoUnit, maps.image(*terrain.albedo.map.texels));
    bind_texture(kAroundAlbedoUnit, maps.image(*terrain.albedo.around.texels));
  }
  bind_texture(kReflectionUnit, reflection.colour());
  bind_texture(kRefractionUnit, refraction.colour());
  bind_texture(kWindowDistanceUnit, window.distance());
  bind_texture(kReflectionDistanceUnit, reflection.distance());
  bind_texture(kRefractionDistanceUnit, refraction.distance());
}

void Peer::take(const Workspace& workspace) {
  const render::FrameState& frame = workspace.state();
  State& peer = *state_;
  const ShaderFeatures features = features_of(frame);
  const std::string key = features.water_defines + features.water_layers + features.terrain_defines;
  if (!peer.programs || key != peer.features) peer.programs.emplace(peer.gl, features);
  peer.features = key;

  const View& camera = frame.window.camera;
  peer.window.resize(camera.width_px, camera.height_px);
  const View& planar = frame.planar_maps.reflection.view.camera;
  peer.reflection.resize(planar.width_px, planar.height_px);
  peer.refraction.resize(planar.width_px, planar.height_px);
  peer.water.take(frame.meshes.water);
  peer.land.take(frame.meshes.land);
  peer.objects.take(frame.meshes.objects.in_window());
  peer.take_maps(frame);
  set_constants(frame, *peer.programs);
  peer.gl.Finish();
  if (const GLenum error = peer.gl.GetError(); error != GL_NO_ERROR)
    throw std::runtime_error("OpenGL: error " + std::to_string(error));
}

// --- Drawing

void Peer::State::draw_over_screen(const GlProgram& program) const {
  program.use();
  gl.BindVertexArray(screen);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

// Objects with their colours; where land and water are nearest: how far, and a mark in the stencil.
void Peer::State::draw_visible(const PeerTarget& target, const ViewPrograms& view,
                               bool is_window) const {
  if (!objects.empty()) {
    target.bind_colour();
    view.object.use();
    objects.draw();
  }
  target.bind_distance();
  view.distance.use();
  // From above, the fronts of waves and hills hide their backs; not where land is cut off at the
  // water's level. In a picture whose rows go down the corners' order is turned round.
  if (is_window) gl.Enable(GL_CULL_FACE);
  gl.Enable(GL_STENCIL_TEST);
  gl.StencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  if (!land.empty()) {
    gl.StencilFunc(GL_ALWAYS, kLandMark, 0xff);
    land.draw();
  }
  if (is_window) {
    gl.StencilFunc(GL_ALWAYS, kWaterMark, 0xff);
    water.draw();
  }
  gl.Disable(GL_CULL_FACE);
  gl.StencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
  gl.Disable(GL_STENCIL_TEST);
  target.bind_colour();
}

// Shades what draw_visible() marked, each pixel once.
void Peer::State::shade_marked(const GlProgram& program, int mark) const {
  gl.Enable(GL_STENCIL_TEST);
  gl.StencilFunc(GL_EQUAL, mark, 0xff);
  gl.Disable(GL_DEPTH_TEST);
  draw_over_screen(program);
  gl.Enable(GL_DEPTH_TEST);
  gl.Disable(GL_STENCIL_TEST);
}

void Peer::State::draw_planar_map(const PeerTarget& target, const ViewPrograms& view) const {
  if (land.empty() && objects.empty()) return;
  target.bind_colour();
  gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
  gl.Enable(GL_CLIP_DISTANCE0);
  draw_visible(target, view, false);
  gl.Disable(GL_CLIP_DISTANCE0);
  if (!land.empty()) shade_marked(view.terrain, kLandMark);
}

void Peer::State::draw_sky() const {
  gl.DepthFunc(GL_GEQUAL);
  draw_over_screen(programs->sky);
  gl.DepthFunc(GL_GREATER);
}

void Peer::State::draw_pass(PeerPass pass) const {
  switch (pass) {
    case PeerPass::kReflection:
      return draw_planar_map(reflection, programs->reflection);
    case PeerPass::kRefraction:
      return draw_planar_map(refraction, programs->refraction);
    case PeerPass::kVisible:
      window.bind_colour();
      gl.Clear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
      return draw_visible(window, programs->window, true);
    case PeerPass::kLand:
      if (!land.empty()) shade_marked(programs->window.terrain, kLandMark);
      return;
    case PeerPass::kWater:
      return shade_marked(programs->water, kWaterMark);
    case PeerPass::kSky:
      return draw_sky();
  }
}

void Peer::draw() {
  for (std::size_t pass = 0; pass < kPeerPasses; ++pass)
    state_->draw_pass(static_cast<PeerPass>(pass));
  state_->gl.Finish();
}

std::array<double, kPeerPasses> Peer::draw_by_pass() {
  using Clock = std::chrono::steady_clock;
  std::array<double, kPeerPasses> pass_ms{};
  for (std::size_t pass = 0; pass < kPeerPasses; ++pass) {
    const Clock::time_point start = Clock::now();
    state_->draw_pass(static_cast<PeerPass>(pass));
    state_->gl.Finish();
    pass_ms[pass] = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  }
  return pass_ms;
}

void Peer::read(std::span<std::uint32_t> rgba) const {
  state_->window.bind_colour();
  state_->gl.ReadPixels(0, 0, state_->window.width_px(), state_->window.height_px(), GL_RGBA,
                        GL_UNSIGNED_BYTE, rgba.data());
}

// --- The rest

Peer::Peer(int threads) : state_(std::make_unique<State>(threads)) {}
Peer::~Peer() = default;
std::string Peer::renderer() const { return state_->context.renderer(); }
std::string Peer::version() const { return state_->context.version(); }

}  // namespace swell::apps
