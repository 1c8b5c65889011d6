// The point that a pixel shows, from its distance along the view: each pixel is shaded once, however
// many triangles lie in it.
uniform sampler2D distance_map;
uniform vec3 ray, ray_dx, ray_dy;  // through window point (0, 0); per pixel right and down

struct SurfacePoint {
  vec3 p;  // relative to the eye; of the mirrored or squeezed world, if any
  vec3 to_eye;
  float distance_m;  // to the eye
  float across;      // log2 of the pixel's footprint [m] across the view
};

SurfacePoint surface_point() {
  float depth = texelFetch(distance_map, ivec2(gl_FragCoord.xy), 0).r;
  vec3 d = ray + gl_FragCoord.x * ray_dx + gl_FragCoord.y * ray_dy;
  float length2 = dot(d, d), inv_length = inversesqrt(length2);
  // In the flat world: raised by what the place has sunk, and as the level there has it.
  float sunk = dot(d.xy, d.xy) * depth * drop_per_m2;
  vec3 p = d * depth + vec3(0.0, 0.0, sunk * depth);
  vec3 to_eye = (d + vec3(0.0, 0.0, 2.0 * sunk)) * -inv_length;
  return SurfacePoint(p, to_eye, depth * length2 * inv_length, pixel_angle_log2 + log2(depth));
}
