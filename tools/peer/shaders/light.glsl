// What all fragment shaders share: sky, haze, water's absorption, from light to a picture.
uniform sampler2D sky_soft;
uniform vec3 sun_direction, sun_irradiance, ambient, horizon;
uniform float inv_haze_m, inv_haze_height_m, exposure, refraction_index;
uniform float drop_per_m2;  // of a round earth
uniform vec3 body, absorption_per_m;
uniform float pixel_angle_log2;
uniform float eye_z;

// Radiance from the blurred sky's square-root code.
vec3 decode_sky(vec3 code) { return 4.0 * code * code; }

// The blurred sky in a direction, any length of it equal to `size`.
vec3 sky_radiance(sampler2D map, vec3 direction, float size) {
  return decode_sky(texture(map, direction.xy * (0.5 / (size + direction.z)) + 0.5).rgb);
}

// log2 of a pixel's footprint [m], `across` of it across the view, on a surface that the eye meets at
// cos_view.
float footprint_level(float across, float cos_view) { return across - 0.8 * log2(cos_view); }

float fresnel(float cos_theta, float n) {
  float c = clamp(cos_theta, 0.0, 1.0);
  float g = sqrt(c * c + (n * n - 1.0));
  float minus = g - c, plus = g + c;
  float s = c * plus - 1.0, t = c * minus + 1.0;
  float minus_t = minus * t, minus_s = minus * s, plus_t = plus * t;
  return 0.5 * (minus_t * minus_t + minus_s * minus_s) / (plus_t * plus_t);
}

// The mean density of haze on the way to p, as render/tile/attenuate-inl.h has it.
float mean_haze(vec3 p) {
  float eye = 1.0 + max(eye_z, 0.0) * inv_haze_height_m;
  float place = 1.0 + abs(p.z + eye_z) * inv_haze_height_m;
  float sagging = dot(p.xy, p.xy) * (0.25 * drop_per_m2 * inv_haze_height_m);
  float middle = max(0.5 * (eye + place) - sagging, 1.0);
  return 0.5 * (eye + place) / (eye * place * middle);
}

vec3 add_haze(vec3 colour, vec3 p, vec3 to_eye, float distance_m) {
  float amount = max((1.0 - 1.0 / 512.0) - exp(-inv_haze_m * mean_haze(p) * distance_m), 0.0);
  vec2 away = -to_eye.xy;
  float horizontal2 = max(dot(away, away), 1e-12);
  float to_rim = 0.5 * inversesqrt(horizontal2), level4 = horizontal2 * horizontal2;
  vec3 sky = mix(decode_sky(texture(sky_soft, away * to_rim + 0.5).rgb), horizon,
                 1.0 - level4 * level4 * level4 * level4);
  return mix(colour, sky, amount);
}

// Light's way through water to something at an apparent depth: x is the true depth, y the length of
// the way down and up.
vec2 path_through_water(vec3 to_eye, float apparent) {
  float cos_eye = max(to_eye.z, 0.02);
  float sin2 = max(1.0 - cos_eye * cos_eye, 0.0) / (refraction_index * refraction_index);
  float cos_t = sqrt(1.0 - sin2);
  float depth = apparent * (cos_t * refraction_index / cos_eye);
  return vec2(depth, 1.2 * depth + min(depth / cos_t, 200.0));
}

vec3 absorb_in_water(vec3 light, float path_m) {
  return mix(body, light, exp(-absorption_per_m * path_m));
}

// Exposure, tone curve, sRGB and a dither of one step.
vec4 to_display(vec3 light) {
  vec3 x = max(light * exposure, vec3(0.0));
  vec3 over = max(x - 0.4, vec3(0.0));
  vec3 display = min(min(x, vec3(0.4)) + over / (over * (1.0 / 0.6) + 1.0), vec3(1.0));
  vec3 s = sqrt(display);
  vec3 curve = ((((0.5172983 * s - 1.6236454) * s + 2.0315608) * s - 1.4027299) * s + 1.5179496) * s -
               0.0401095;
  vec3 code = mix(curve, 12.92 * display, lessThan(display, vec3(0.0031308)));
  vec2 pixel = gl_FragCoord.xy - 0.5;
  float dither = fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
  return vec4(code + (dither - 0.5) / 255.0, 1.0);
}

// A texel of a lookup image, and radiance from it.
vec4 to_lookup(vec3 light) {
  vec3 x = max(light, vec3(0.0));
  return vec4(min(sqrt(x / (x + 1.0)), 254.0 / 255.0), 1.0);
}
vec3 from_lookup(vec3 code) {
  vec3 c2 = min(code * code, vec3(254.0 / 255.0 * 254.0 / 255.0));
  return c2 / (1.0 - c2);
}
