// The sky as the eye sees it, as render/tile/sky-inl.h.
out vec4 colour;

uniform sampler2D sky_clear;
uniform float sky_clear_range, pixel_angle;
uniform vec3 disc_radiance;
uniform vec3 ray, ray_dx, ray_dy;  // through window point (0, 0); per pixel right and down

const float disc_radius = 0.004654;

vec3 clear_sky(vec3 d) {
  float across = length(d.xy);
  float warped = 1.0 - sqrt(1.0 - min(across / (1.0 + d.z), 1.0));
  vec3 code = texture(sky_clear, d.xy * (0.5 * warped / max(across, 1e-6)) + 0.5).rgb;
  return sky_clear_range * code * code;
}

void main() {
  vec3 d = ray + gl_FragCoord.x * ray_dx + gl_FragCoord.y * ray_dy;
  vec3 level = vec3(d.xy, max(d.z, 0.0));
  vec3 light = clear_sky(level * inversesqrt(max(dot(level, level), 1e-12)));
  float inside = disc_radius - distance(normalize(d), sun_direction);
  float disc = clamp(inside / max(pixel_angle, 0.02 * disc_radius) + 0.5, 0.0, 1.0);
  light += disc_radiance * (d.z > 0.0 ? disc : 0.0);
  colour = to_display(light);
}
