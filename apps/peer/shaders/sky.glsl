// The sky as the eye sees it, as render/tile/sky-inl.h.
out vec4 colour;

uniform sampler2D sky_sharp;
uniform vec3 ray, ray_dx, ray_dy;  // through window point (0, 0); per pixel right and down

const float cos_rim = 0.99998, cos_core = 0.999992;

void main() {
  vec3 d = ray + gl_FragCoord.x * ray_dx + gl_FragCoord.y * ray_dy;
  vec3 above = vec3(d.xy, max(d.z, 0.0));
  vec3 light = sky_radiance(sky_sharp, above, sqrt(max(dot(above, above), 1e-12)));
  float cos_sun = dot(d, sun_direction) * inversesqrt(dot(d, d));
  float rim = clamp((cos_sun - cos_rim) * (1.0 / (cos_core - cos_rim)), 0.0, 1.0);
  light += sun_irradiance * (d.z > 0.0 ? 8.0 * rim : 0.0);
  colour = to_display(light);
}
