#include "apps/peer/peer.h"

#include <chrono>
#include <optional>
#include <stdexcept>

#include "apps/peer/egl_context.h"
#include "apps/peer/peer_maps.h"
#include "apps/peer/peer_meshes.h"
#include "apps/peer/peer_programs.h"
#include "apps/peer/peer_targets.h"
#include "apps/peer/texture_units.h"

namespace swell::apps {

using render::Workspace;

struct Peer::State {
  explicit State(int threads);

  void take_maps(const Workspace::State& frame);
  void bind_texture(int unit, GLuint texture) const;
  void bind_layer(int unit, const render::SlopeLayer& layer, Levels levels, bool changed);
  void draw_pass(PeerPass pass) const;
  void draw_lookup_image(const PeerTarget& target, const ViewPrograms& programs) const;
  void draw_solids(const ViewPrograms& programs) const;
  void draw_water() const;
  void draw_sky() const;

  EglContext context;
  const Gl& gl = context.gl();
  PeerMaps maps{gl};
  PeerMesh water{gl}, land{gl}, objects{gl};
  PeerTarget window{gl, GL_RGBA8}, water_depth{gl, GL_R32F, window.depth()};
  PeerTarget reflection{gl, GL_RGBA8}, refraction{gl, GL_RGBA8};
  GLuint screen = 0;  // a vertex array without vertices
  std::string features;
  std::optional<PeerPrograms> programs;
};

Peer::State::State(int threads) : context(threads) {
  gl.GenVertexArrays(1, &screen);
  gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_GREATER);
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
  gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  bind_texture(unit, maps.slopes(layer, levels, changed));
}

void Peer::State::take_maps(const Workspace::State& frame) {
  const render::Shading& s = frame.shading;
  const auto& sea = s.material<render::Water>();
  bind_texture(kSkySoftUnit, maps.image(*s.light.sky_soft));
  bind_texture(kSkySharpUnit, maps.image(*s.light.sky_sharp));
  // Where there is surf nobody sees the step between two levels of the noise.
  bind_layer(kNoiseUnit, sea.uv_noise, sea.has_coast ? Levels::kNearest : Levels::kBlended, true);
  for (int i = 0; i < sea.layer_count; ++i) {
    const bool is_patch = i < sea.layer_count - 2;
    bind_layer(kFirstLayerUnit + i, sea.layers[static_cast<std::size_t>(i)], Levels::kBlended,
               is_patch);
  }
  if (sea.has_coast) {
    bind_layer(kFoamUnit, sea.foam.pattern, Levels::kNearest, false);
    bind_layer(kCoastSlopesUnit, sea.coast_slopes, Levels::kBlended, true);
    bind_layer(kCoastSurfUnit, sea.coast_surf, Levels::kNearest, true);
  }
  const auto& terrain = s.material<render::Terrain>();
  if (terrain.albedo) {
    bind_layer(kTerrainSlopesUnit, terrain.slopes, Levels::kBlended, false);
    bind_layer(kDetailUnit, terrain.detail, Levels::kBlended, false);
    bind_texture(kAlbedoUnit, maps.image(*terrain.albedo));
  }
  bind_texture(kReflectionUnit, reflection.colour());
  bind_texture(kRefractionUnit, refraction.colour());
  bind_texture(kWaterDepthUnit, water_depth.colour());
}

void Peer::take(const Workspace& workspace) {
  const Workspace::State& frame = workspace.state();
  State& peer = *state_;
  const ShaderFeatures features = features_of(frame);
  const std::string key = features.water_defines + features.water_layers + features.terrain_defines;
  if (!peer.programs || key != peer.features) peer.programs.emplace(peer.gl, features);
  peer.features = key;

  const View& camera = frame.window.camera;
  peer.window.resize(camera.width_px, camera.height_px);
  peer.water_depth.resize(camera.width_px, camera.height_px);
  const View& lookup = frame.lookups.reflection.view.camera;
  peer.reflection.resize(lookup.width_px, lookup.height_px);
  peer.refraction.resize(lookup.width_px, lookup.height_px);
  peer.water.take(frame.meshes.water);
  peer.land.take(frame.meshes.land);
  peer.objects.take(frame.meshes.objects);
  peer.take_maps(frame);
  set_constants(frame, *peer.programs);
  peer.gl.Finish();
  if (const GLenum error = peer.gl.GetError(); error != GL_NO_ERROR)
    throw std::runtime_error("OpenGL: error " + std::to_string(error));
}

// --- Drawing

void Peer::State::draw_solids(const ViewPrograms& view) const {
  if (!objects.empty()) {
    view.object.use();
    objects.draw();
  }
  if (land.empty()) return;
  view.terrain.use();
  land.draw();
}

void Peer::State::draw_lookup_image(const PeerTarget& target, const ViewPrograms& view) const {
  if (land.empty() && objects.empty()) return;
  target.bind();
  gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl.Enable(GL_CLIP_DISTANCE0);
  draw_solids(view);
  gl.Disable(GL_CLIP_DISTANCE0);
}

// First where the water is nearest and how far, then its light, once a pixel.
void Peer::State::draw_water() const {
  gl.Enable(GL_STENCIL_TEST);
  gl.StencilFunc(GL_ALWAYS, 1, 0xff);
  gl.StencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  water_depth.bind();
  programs->water_depth.use();
  water.draw();

  gl.StencilFunc(GL_EQUAL, 1, 0xff);
  gl.StencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
  gl.Disable(GL_DEPTH_TEST);
  window.bind();
  programs->water.use();
  gl.BindVertexArray(screen);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  gl.Enable(GL_DEPTH_TEST);
  gl.Disable(GL_STENCIL_TEST);
}

void Peer::State::draw_sky() const {
  gl.DepthFunc(GL_GEQUAL);
  programs->sky.use();
  gl.BindVertexArray(screen);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  gl.DepthFunc(GL_GREATER);
}

void Peer::State::draw_pass(PeerPass pass) const {
  switch (pass) {
    case PeerPass::kReflection:
      return draw_lookup_image(reflection, programs->reflection);
    case PeerPass::kRefraction:
      return draw_lookup_image(refraction, programs->refraction);
    case PeerPass::kSolids:
      window.bind();
      gl.Clear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
      return draw_solids(programs->window);
    case PeerPass::kWater:
      return draw_water();
    case PeerPass::kSky:
      return draw_sky();
    case PeerPass::kCount:
      break;
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
  state_->window.bind();
  state_->gl.ReadPixels(0, 0, state_->window.width_px(), state_->window.height_px(), GL_RGBA,
                        GL_UNSIGNED_BYTE, rgba.data());
}

// --- The rest

Peer::Peer(int threads) : state_(std::make_unique<State>(threads)) {}
Peer::~Peer() = default;
std::string Peer::renderer() const { return state_->context.renderer(); }
std::string Peer::version() const { return state_->context.version(); }

}  // namespace swell::apps
