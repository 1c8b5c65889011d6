// The water, as render/water/topside-inl.h. ADD_LAYERS() is written by peer_programs.cpp: a call for
// each of the scene's maps.
out vec4 colour;

uniform float base_variance, short_variance, visible_slopes, least_cos;
uniform vec4 layer_place[LAYERS], layer_scale[LAYERS], layer_tiles[LAYERS];
#if SINES > 0
uniform vec4 sine_wave[SINES];  // cycles per metre along x and y, cycles under the eye, level lost
uniform vec4 sine_slope[SINES];  // slopes, variance
#endif
uniform sampler2D noise;
uniform vec4 noise_place, noise_scale;
uniform vec3 crest_glow, mirrored_sea;
uniform float mirrored_floor_part;
uniform float inv_crest_height, inv_wave_reach, wave_horizon;
#ifdef COAST
uniform sampler2D coast_slopes, coast_surf;
uniform vec4 coast_slopes_place, coast_slopes_scale, coast_surf_place, coast_surf_scale;
#endif
#ifdef LOOKUPS
uniform sampler2D reflection, refraction;
uniform vec2 inv_window;
uniform float distortion_px, max_distortion_px, distortion_by_sine, least_distortion;
uniform vec2 view_right, view_ahead;
#endif

#if SINES > 0
void add_sine(vec4 wave, vec4 slope, vec2 p, float level_m, inout Slopes s) {
  float cycles = dot(wave.xy, p) + wave.z;
  float seen = clamp(wave.w - level_m, 0.0, 1.0);
  s.slope += slope.xy * (seen * cos(6.2831853 * cycles));
  s.variance += slope.z * (1.0 - seen * seen);
}
#endif

#ifdef COAST
// What the sea's own waves cede to the coast's trains, and foam; both 0 outside.
vec2 sample_surf(vec2 p, float level_m, out float inside) {
  vec2 uv = p * coast_surf_place.x + coast_surf_place.yz;
  vec2 from_rim = min(uv, 0.999 - uv);
  inside = min(from_rim.x, from_rim.y) > 0.0 ? 1.0 : 0.0;
  // Half a level less: the sampler rounds, the level is cut.
  vec2 found = sample_map(coast_surf, coast_surf_place, p, level_m - 0.5).rg * coast_surf_scale.x +
               coast_surf_scale.y;
  if (found.x > 0.996) found.x = 1.0;
  return found * inside;
}

void blend_coast(vec2 p, float level_m, float ceded, float inside, inout Slopes s) {
  float kept = 1.0 - ceded;
  s.slope *= kept;
  s.variance = (s.variance - base_variance) * (kept * kept) + base_variance;
  vec4 found = sample_map(coast_slopes, coast_slopes_place, p, level_m);
  s.slope += (found.rg * coast_slopes_scale.x + coast_slopes_scale.y) * inside;
  s.variance += found.b * (coast_slopes_scale.z * inside);
}
#endif

float cosine_of_slopes(vec3 to_eye, vec2 slope) { return to_eye.z - dot(slope, to_eye.xy); }

#ifdef LOOKUPS
vec4 look_up(sampler2D image, vec2 slope, float to_eye_z, float sign) {
  float gain = sign * distortion_px * clamp(distortion_by_sine * to_eye_z, least_distortion, 1.0);
  vec2 moved = vec2(-0.5 * gain * dot(slope, view_right), gain * dot(slope, view_ahead));
  vec2 bounded = clamp(moved, vec2(-max_distortion_px), vec2(max_distortion_px));
  vec4 found = texture(image, (gl_FragCoord.xy + bounded) * inv_window);
  return vec4(from_lookup(found.rgb), found.a);
}
#endif

// As render/water/visible_slopes-inl.h.
float seen_cosine(float c, float variance) { return 0.5 * (c + sqrt(2.4 * variance + c * c)); }
float seen_area(float c, float variance) {
  float near = max(1.0 - abs(c) * inversesqrt(0.5 * variance) / 2.4, 0.0);
  return near * near * near * sqrt(0.0795774715 * variance) + max(c, 0.0);
}
float unhidden_cosine(float c, float level_cosine, float variance_all, float drawn) {
  float raised = drawn * (seen_cosine(level_cosine, variance_all) - level_cosine);
  float lost = 0.276 * raised * inversesqrt(0.5 * variance_all);
  return c + raised - (c - level_cosine) * min(lost, 1.0);
}

float part_of_sea_mirrored(float r_z, float to_eye_z, float variance) {
  float scale = 0.125 / variance;
  float r_z2 = r_z * abs(r_z);
  float turn = clamp(scale * r_z2, -1.0, 1.0);
  float hidden = max(1.0 - (to_eye_z * to_eye_z - 0.125 * min(r_z2, 0.0)) * scale, 0.0);
  return (0.5 - 0.5 * turn * (2.0 - abs(turn))) * (1.0 - hidden * hidden);
}

float sun_glint(vec3 to_eye, Slopes s, float area) {
  vec3 half_way = to_eye + sun_direction;
  float z = max(half_way.z, 1e-3);
  float cos4 = 4.0 * max(area, 0.02);
  // One division for three quotients.
  float z_cos4 = z * cos4;
  float inverse = 1.0 / (z_cos4 * s.variance);
  float inv_variance = inverse * z_cos4, inverse_z_cos4 = inverse * s.variance;
  float inv_z = inverse_z_cos4 * cos4, inv_cos4 = inverse_z_cos4 * z;
  vec2 d = half_way.xy * inv_z + s.slope;
  float density = exp(max(-dot(d, d) * inv_variance, -80.0)) * (inv_variance * 0.318309886);
  float inv_cos2 = dot(half_way, half_way) * (inv_z * inv_z);
  float reflectance = fresnel(0.5 * sqrt(dot(half_way, half_way)), refraction_index);
  return reflectance * density * (inv_cos2 * inv_cos2 * inv_cos4);
}

void main() {
  SurfacePoint point = surface_point();
  vec3 p = point.p, to_eye = point.to_eye;
  float level_flat_m = footprint_level(point.across, clamp(to_eye.z, 0.02, 1.0));
  float level_m = level_flat_m, fine_variance = 0.0, long_cosine = to_eye.z;

  // Slopes: long waves, then what is finer at the level that their slopes give.
  Slopes s = Slopes(vec2(0.0), base_variance);
#ifdef COAST
  float inside;
  vec2 surf = sample_surf(p.xy, level_flat_m, inside);
#endif
  vec2 bend;
#if SINES > 0
  for (int i = 0; i < SINES; ++i) add_sine(sine_wave[i], sine_slope[i], p.xy, level_flat_m, s);
#endif
  ADD_LAYERS();

  // Light from above and from below.
  vec3 normal = normal_of(s.slope);
  float drawn = visible_slopes * max(1.0 - s.variance / fine_variance, 0.0);
  float cos_eye = dot(normal, to_eye);
  if (least_cos > 0.0) {
    float least = least_cos / sqrt(1.0 - least_cos * least_cos);
    normal = normalize(normal + max(least - cos_eye, 0.0) * to_eye);
    cos_eye = dot(normal, to_eye);
  } else {
    cos_eye = unhidden_cosine(cos_eye, long_cosine, fine_variance, drawn);
  }
  float raised = seen_cosine(cos_eye, s.variance) - cos_eye;
  float away = 1.0 - cos_eye;
  float reflectance = fresnel(cos_eye + raised * away * away, refraction_index);
  float r_z = 2.0 * cos_eye * normal.z - to_eye.z;
  float sea = part_of_sea_mirrored(r_z - wave_horizon, to_eye.z + wave_horizon, s.variance);
  float mirror_raised = least_cos > 0.0 ? 0.0 : visible_slopes * raised * away;
  vec3 r = normal * (2.0 * (cos_eye + mirror_raised)) - to_eye;
  r.z = max(r.z, -0.25);
  float share = clamp(2.0 - 1.25 * inv_wave_reach * point.distance_m, 0.0, 1.0);
  float crest = clamp(share * (p.z + eye_z) * inv_crest_height + 0.4, 0.0, 1.5);
  float towards_sun = max(-dot(to_eye.xy, sun_direction.xy), 0.0);
  vec3 crest_light = crest_glow * (crest * crest * (towards_sun + 0.35));
  vec3 refracted = body + crest_light;
  vec3 floor_added = vec3(0.0);
#ifdef LOOKUPS
  vec4 floor_seen = look_up(refraction, s.slope, to_eye.z, -0.5);
  floor_added = floor_seen.a * (floor_seen.rgb + crest_light - refracted);
  refracted += floor_added;
#endif
  vec3 sea_light = mirrored_sea + mirrored_floor_part * floor_added;
  vec3 mirrored = mix(sky_radiance(sky_soft, r, sqrt(dot(r, r))), sea_light, sea);
#ifdef LOOKUPS
  vec4 mirror = look_up(reflection, s.slope, to_eye.z, 1.0);
  mirrored = mix(mirrored, mirror.rgb, mirror.a);
#endif
  float glint = sun_glint(to_eye, s, seen_area(long_cosine, fine_variance));
  vec3 seen = mix(refracted, mirrored, reflectance) + sun_irradiance * glint;
#ifdef COAST
  seen = add_foam(foam_cover(p.xy, level_flat_m, surf.y), seen);
#endif
  colour = to_display(add_haze(seen, p, to_eye, point.distance_m));
}
