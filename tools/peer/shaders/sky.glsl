// The sky as the eye sees it, as render/tile/sky-inl.h.
out vec4 colour;

uniform sampler2D sky_map;
uniform float sky_range, pixel_angle, horizon_sine;
uniform vec2 sky_azimuth;
uniform vec3 to_disc, disc_radiance;
uniform vec3 ray, ray_dx, ray_dy;  // through window point (0, 0); per pixel right and down

const float disc_radius = 0.004654;

const vec2 sky_size = vec2(128.0, 256.0);
const float sky_rows = 192.0;

vec3 clear_sky(vec3 d) {
  float cosine = dot(d.xy, sky_azimuth) / max(length(d.xy), 1e-6);
  float column = sqrt(sqrt(clamp(0.5 - 0.5 * cosine, 0.0, 1.0))) * (sky_size.x - 1.0);
  float part = clamp((d.z - horizon_sine) / (1.0 - horizon_sine), 0.0, 1.0);
  float from_horizon = sqrt(max(1.0 - sqrt((1.0 - part) / (1.0 + part)), 0.0));
  float row = (1.0 - from_horizon) * (sky_rows - 1.0);
  vec3 code = texture(sky_map, (vec2(column, row) + 0.5) / sky_size).rgb;
  return sky_range * code * code;
}

void main() {
  vec3 d = ray + gl_FragCoord.x * ray_dx + gl_FragCoord.y * ray_dy;
  d = normalize(d);
  vec3 light = clear_sky(d);
  float inside = disc_radius - distance(d, to_disc);
  float disc = clamp(inside / max(pixel_angle, 0.02 * disc_radius) + 0.5, 0.0, 1.0);
  light += disc_radiance * (d.z > horizon_sine ? disc : 0.0);
  colour = to_display(light);
}
