// The land and the sea floor, as render/materials/terrain-inl.h.
out vec4 colour;

uniform sampler2D terrain_slopes, detail, albedo_map;
uniform vec4 slopes_place, slopes_scale, detail_place, detail_scale;
uniform vec3 albedo_place;  // turns of the map per metre, under the eye
#ifdef SWASH
uniform float swash_reach_m, swash_cycles;
uniform vec3 lag_a, lag_b;
#endif

vec3 light_ground(vec2 p, vec3 normal) {
  float cos_sun = max(dot(normal, sun_direction), 0.0);
  vec3 arriving = sun_irradiance * (cos_sun * 0.318309886) + ambient * (0.5 * normal.z + 0.5);
  vec3 code = texture(albedo_map, p * albedo_place.x + albedo_place.yz).rgb;
  return arriving * code * code;
}

#ifdef SWASH
vec3 add_swash(vec3 p, vec3 to_eye, float level_m, vec3 ground) {
  const float turn = 6.2831853;
  float height_m = p.z + eye_z;
  float along_a = sin(turn * (dot(lag_a.xy, p.xy) + lag_a.z));
  float along_b = sin(turn * (dot(lag_b.xy, p.xy) + lag_b.z));
  float turns = swash_cycles - 0.3 * (along_a + along_b);
  float leaning = turns - 0.056 * cos(turn * turns);
  float edge_m = (0.5 * sin(turn * leaning) + 0.5) * ((0.85 + 0.15 * along_b) * swash_reach_m);
  float retreat = 0.5 - 0.5 * cos(turn * leaning);

  float dry = clamp(height_m / (1.6 * swash_reach_m), 0.0, 1.0);
  float wet = 1.0 - dry * dry * dry;
  float mirror = fresnel(clamp(to_eye.z, 0.05, 1.0), refraction_index);
  vec3 sky = sky_radiance(sky_soft, vec3(-to_eye.xy, abs(to_eye.z)), 1.0);
  float below = edge_m - height_m;
  float sheet = clamp(40.0 * below, 0.0, 1.0);
  float shine = mirror * 0.5 * (sheet + wet);
  vec3 light = mix(ground * (1.0 - 0.15 * wet), sky, shine);
  float from_rim = below / swash_reach_m;
  float rim = clamp(1.0 - 9.0 * from_rim, 0.0, 1.0);
  float lace = clamp(0.6 - 0.9 * from_rim, 0.0, 1.0);
  float foam = below > 0.0 ? max(rim, lace) * (1.0 - 0.6 * retreat) : 0.0;
  light = add_foam(foam_cover(p.xy, level_m, foam), light);
  return height_m < 1.6 * swash_reach_m ? light : ground;
}
#endif

// 1 over the land's square, falling to 0 at its rim.
float inside_land(vec2 p) {
  float half_texel = 0.5 / float(textureSize(terrain_slopes, 0).x);
  vec2 u = p * slopes_place.x + slopes_place.yz - half_texel;
  vec2 from_rim = min(u, 1.0 - u);
  return clamp(30.0 * min(from_rim.x, from_rim.y), 0.0, 1.0);
}

void main() {
  SurfacePoint point = surface_point();
  vec3 p = point.p, to_eye = point.to_eye;
  float level_m = footprint_level(point.across, clamp(abs(to_eye.z), 0.3, 1.0));

#ifdef WINDOW
  Slopes s = Slopes(vec2(0.0), 0.0);
  add_slopes(terrain_slopes, slopes_place, slopes_scale, p.xy, level_m, s);
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
  vec3 light = light_ground(p.xy, normal_of(slope));
#ifdef REFRACTION
  vec2 path = path_through_water(to_eye, max(-eye_z - p.z, 0.0));
  light = mix(body, absorb_in_water(light, path.y), inside_land(p.xy));
#else
  light = add_haze(light, p, to_eye, point.distance_m);
#endif
  colour = to_lookup(light);
#endif
}
