// The land and the sea floor, as render/materials/terrain-inl.h.
out vec4 colour;

uniform sampler2D terrain_slopes, detail, albedo_map, around_slopes, around_albedo;
uniform vec4 slopes_place, slopes_scale, detail_place, detail_scale;
uniform vec4 around_slopes_place, around_slopes_scale;
uniform vec3 albedo_place, around_albedo_place;  // turns of the map per metre, under the eye
#ifdef SWASH
uniform float swash_reach_m, swash_cycles;
uniform vec3 lag_a, lag_b, lag_c;
#endif

// Coordinates on the square of a map of slopes, 0 to 1 from side to side.
vec2 in_square(sampler2D map, vec4 place, vec2 p) {
  return p * place.x + place.yz - 0.5 / float(textureSize(map, 0).x);
}

// 1 on the map, falling to 0 over its last texels.
float on_map(vec2 p) {
  vec2 u = in_square(terrain_slopes, slopes_place, p);
  vec2 from_rim = min(u, 1.0 - u);
  return clamp(40.0 * min(from_rim.x, from_rim.y), 0.0, 1.0);
}

// 1 over the map, falling to 0 where its apron ends.
float floor_shown(vec2 p) {
  vec2 u = in_square(around_slopes, around_slopes_place, p);
  vec2 away = max(abs(4.0 * u - 2.0) - 1.0, 0.0);
  return smoothstep(0.0, 1.0, 2.0 - 2.0 * dot(away, away));
}

vec3 light_ground(vec2 p, vec3 normal) {
  float cos_sun = max(dot(normal, sun_direction), 0.0);
  vec3 arriving = sun_irradiance * (cos_sun * 0.318309886) + ambient * (0.5 * normal.z + 0.5);
  vec3 code = texture(albedo_map, p * albedo_place.x + albedo_place.yz).rgb;
  vec3 around = texture(around_albedo, p * around_albedo_place.x + around_albedo_place.yz).rgb;
  return arriving * mix(around * around, code * code, on_map(p));
}

#ifdef SWASH
vec3 add_swash(vec3 p, vec3 to_eye, float level_m, vec3 ground) {
  const float turn = 6.2831853;
  float height_m = p.z + eye_z;
  float along_a = sin(turn * (dot(lag_a.xy, p.xy) + lag_a.z));
  float along_b = sin(turn * (dot(lag_b.xy, p.xy) + lag_b.z));
  float turns = swash_cycles - 0.3 * (along_a + along_b);
  float leaning = turns - 0.056 * cos(turn * turns);
  float lobes = sin(turn * (dot(lag_c.xy, p.xy) + 0.7 * along_b + lag_c.z));
  float reach_m = (0.85 + 0.09 * along_b + 0.06 * lobes) * swash_reach_m;
  float edge_m = (0.5 * sin(turn * leaning) + 0.5) * reach_m;
  float retreat = 0.5 - 0.5 * cos(turn * leaning);

  float wet = 1.0 - smoothstep(0.5, 1.6, height_m / swash_reach_m);
  float mirror = fresnel(clamp(to_eye.z, 0.05, 1.0), refraction_index);
  vec3 sky = sky_radiance(sky_soft, vec3(-to_eye.xy, abs(to_eye.z)), 1.0);
  float below = edge_m - height_m;
  float sheet = smoothstep(0.0, 1.0, 8.0 * below / swash_reach_m);
  float shine = mirror * 0.5 * (sheet + wet);
  vec3 light = mix(ground * (1.0 - 0.15 * wet), sky, shine);
  float from_rim = below / swash_reach_m;
  float rim = clamp(1.0 - 9.0 * from_rim, 0.0, 1.0);
  float lace = clamp(0.6 - 0.9 * from_rim, 0.0, 1.0);
  float front = clamp(40.0 * from_rim, 0.0, 1.0);
  float foam = max(rim, lace) * front * (1.0 - 0.6 * retreat);
  light = add_foam(foam_cover(p.xy, level_m, foam), light);
  return height_m < 1.6 * swash_reach_m ? light : ground;
}
#endif

void main() {
  SurfacePoint point = surface_point();
  vec3 p = point.p, to_eye = point.to_eye;
  float level_m = footprint_level(point.across, clamp(abs(to_eye.z), 0.3, 1.0));

#ifdef WINDOW
  Slopes s = Slopes(vec2(0.0), 0.0);
  Slopes around = s;
  add_slopes(terrain_slopes, slopes_place, slopes_scale, p.xy, level_m, s);
  add_slopes(around_slopes, around_slopes_place, around_slopes_scale, p.xy, level_m, around);
  s.slope = mix(around.slope, s.slope, on_map(p.xy));
  add_slopes(detail, detail_place, detail_scale, p.xy, level_m, s);
  vec3 light = light_ground(p.xy, normal_of(s.slope));
#ifdef SWASH
  light = add_swash(p, to_eye, level_m, light);
#endif
  colour = to_display(add_haze(light, p, to_eye, point.distance_m));
#else
  // What is seen in or through water: the nearest level, no detail.
  float nearest = floor(level_m + slopes_place.w + 0.5) - slopes_place.w;
  vec2 slope = sample_map(terrain_slopes, slopes_place, p.xy, nearest).rg * slopes_scale.x +
               slopes_scale.y;
  nearest = floor(level_m + around_slopes_place.w + 0.5) - around_slopes_place.w;
  vec2 around = sample_map(around_slopes, around_slopes_place, p.xy, nearest).rg *
                    around_slopes_scale.x + around_slopes_scale.y;
  slope = mix(around, slope, on_map(p.xy));
  vec3 light = light_ground(p.xy, normal_of(slope));
#ifdef REFRACTION
  vec2 path = path_through_water(to_eye, max(-eye_z - p.z, 0.0));
  light = mix(body, absorb_in_water(light, path.y), floor_shown(p.xy));
#else
  light = add_haze(light, p, to_eye, point.distance_m);
#endif
  colour = to_lookup(light);
#endif
}
