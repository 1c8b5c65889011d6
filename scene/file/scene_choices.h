// The fields of a scene that its file sets by a word, with their words: for rows of parameters.
#pragma once

#include "math/enum_table.h"
#include "scene/scene.h"

namespace swell::scene {

struct Priority {
  static constexpr auto words =
      enum_words<bool>({{false, "projected_size"}, {true, "inverse_distance"}});
  auto& operator()(auto& scene) const { return scene.detail.inverse_distance_priority; }
};

struct ProjectionName {
  using enum ProjectionKind;
  static constexpr auto words = enum_words<ProjectionKind>({{kPerspective, "perspective"},
                                                            {kFisheye, "fisheye"},
                                                            {kEquirectangular, "equirectangular"}});
  auto& operator()(auto& scene) const { return scene.camera.projection; }
};

struct TriangulationName {
  using enum Triangulation;
  static constexpr auto words =
      enum_words<Triangulation>({{kRoam, "roam"}, {kRadial, "radial"}, {kPlane, "plane"}});
  auto& operator()(auto& scene) const { return scene.detail.triangulation; }
};

struct ShadingRateName {
  using enum ShadingRate;
  static constexpr auto words = enum_words<ShadingRate>({{kAdaptive, "adaptive"}, {kFull, "full"}});
  auto& operator()(auto& scene) const { return scene.picture.shading; }
};

struct TerrainMethodName {
  using enum TerrainMethod;
  static constexpr auto words = enum_words<TerrainMethod>({{kRoam, "roam"}, {kRays, "rays"}});
  auto& operator()(auto& scene) const { return scene.detail.terrain_method; }
};

struct InterpolationName {
  static constexpr auto words = enum_words<bool>({{false, "bilinear"}, {true, "bicubic"}});
  auto& operator()(auto& scene) const { return scene.terrain->bicubic; }
};

struct GroundName {
  static constexpr auto words = enum_words<bool>({{false, "heights"}, {true, "boundary"}});
  auto& operator()(auto& scene) const { return scene.terrain->ground_from_boundary; }
};

struct EarthName {
  static constexpr auto words = enum_words<bool>({{false, "flat"}, {true, "round"}});
  auto& operator()(auto& scene) const { return scene.round_earth; }
};

struct DistortionFactorName {
  using enum DistortionFactor;
  static constexpr auto words =
      enum_words<DistortionFactor>({{kBounded, "bounded"}, {kPaper, "paper"}});
  auto& operator()(auto& scene) const { return scene.water.distortion_factor; }
};

struct GlitterName {
  using enum Glitter;
  static constexpr auto words =
      enum_words<Glitter>({{kSlopes, "slopes"}, {kProjective, "projective"}});
  auto& operator()(auto& scene) const { return scene.water.glitter; }
};

struct RippleKindName {
  using enum RippleKind;
  static constexpr auto words =
      enum_words<RippleKind>({{kLayers, "layers"}, {kSequence, "sequence"}});
  auto& operator()(auto& scene) const { return scene.ripples.kind; }
};

struct RippleLightingName {
  using enum RippleLighting;
  static constexpr auto words =
      enum_words<RippleLighting>({{kOptics, "optics"}, {kPaper, "paper"}});
  auto& operator()(auto& scene) const { return scene.ripples.lighting; }
};

struct RipplePicturesName {
  using enum RipplePictures;
  static constexpr auto words =
      enum_words<RipplePictures>({{kHeights, "heights"}, {kNormals, "normals"}});
  auto& operator()(auto& scene) const { return scene.ripples.pictures; }
};

struct WaterTypeName {
  static constexpr auto words = kWaterTypeNames;
  auto& operator()(auto& scene) const { return scene.water.type; }
};

struct RefractionName {
  using enum RefractionModel;
  static constexpr auto words = enum_words<RefractionModel>({{kExact, "exact"}, {kPaper, "paper"}});
  auto& operator()(auto& scene) const { return scene.water.refraction; }
};

struct BackSidesName {
  static constexpr auto words = enum_words<bool>({{false, "seen"}, {true, "tilted"}});
  auto& operator()(auto& scene) const { return scene.water.tilted_backs; }
};

struct MapSetName {
  using enum ocean::MapSet;
  static constexpr auto words = enum_words<ocean::MapSet>(
      {{kNone, "none"}, {kRiver, "river"}, {kLake, "lake"}, {kCoast, "coast"}, {kOcean, "ocean"}});
  auto& operator()(auto& scene) const { return scene.sea.map_set; }
};

struct MapHeightsName {
  using enum ocean::MapHeights;
  static constexpr auto words =
      enum_words<ocean::MapHeights>({{kExact, "exact"}, {kPacked, "packed"}});
  auto& operator()(auto& scene) const { return scene.sea.map_heights; }
};

struct CoastModelName {
  using enum CoastModel;
  static constexpr auto words = enum_words<CoastModel>(
      {{kNone, "none"}, {kTrains, "trains"}, {kBlend, "blend"}, {kFronts, "fronts"}});
  auto& operator()(auto& scene) const { return scene.coast.model; }
};

struct CoastMethod {
  static constexpr auto words = enum_words<bool>({{false, "straight"}, {true, "eikonal"}});
  auto& operator()(auto& scene) const { return scene.coast.eikonal; }
};

}  // namespace swell::scene
