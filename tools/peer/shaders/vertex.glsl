// Vertices of all surfaces, as render/view/render_view.cpp maps them: the world itself, mirrored in
// the water's level (REFLECTION), or moved to where it appears through the surface (REFRACTION).
// The eye is in air.
#ifdef OBJECT
layout(location = 0) in vec3 p_rel;  // relative to the eye [m]
layout(location = 1) in float waterline_rel_m;
layout(location = 2) in vec3 normal;
layout(location = 3) in vec3 albedo;
layout(location = 4) in vec3 finish;  // roughness, metalness, translucency
out vec3 v_normal, v_albedo;
out vec3 v_finish;
out float v_level;
#else
layout(location = 0) in vec2 offset;  // relative to the eye [m]
layout(location = 1) in float height_m;
#endif
uniform mat4 clip_from_rel;
uniform float level_rel_m;  // the mean level over the eye
uniform float refraction_index;
uniform float drop_per_m2;  // of a round earth
uniform float clip_margin_m;  // what the images keep beyond the level
out vec3 v_p;


// As render/view/refracted_image.h.
float apparent_depth(float air, float water, float horizontal) {
  float n2 = refraction_index * refraction_index, m2 = n2 - 1.0;
  float x = max((horizontal - water / sqrt(m2)) / air, horizontal / (air + water / refraction_index));
  for (int i = 0; i < 3; ++i) {
    float inv_g = 1.0 / (n2 + m2 * x * x), run = water * sqrt(inv_g);
    float miss = (air + run) * x - horizontal;
    float bent = run * n2 * inv_g, slope = air + bent, curve = 3.0 * bent * m2 * x * inv_g;
    x -= miss * slope / (slope * slope + 0.5 * miss * curve);
  }
  return water / sqrt(n2 + m2 * x * x);
}

void main() {
#ifdef OBJECT
  vec3 p = p_rel;
  float level = waterline_rel_m, above_m = p.z - level;
  v_normal = normal;
  v_albedo = albedo;
  v_finish = finish;
  v_level = level;
#else
  vec3 p = vec3(offset, height_m + level_rel_m);
  float level = level_rel_m, above_m = height_m;
#endif
#ifdef REFLECTION
  p.z = level - above_m;
#ifdef OBJECT
  gl_ClipDistance[0] = clip_margin_m + above_m;
#else
  gl_ClipDistance[0] = above_m;
#endif
#endif
#ifdef REFRACTION
  gl_ClipDistance[0] = clip_margin_m - above_m;
  // What is cut off above the level goes on as below it, but not high.
  if (above_m <= 10.0)
    p.z = level +
          sign(above_m) * apparent_depth(max(-level_rel_m, 0.05), abs(above_m), length(p.xy));
#endif
  v_p = p;
  p.z -= dot(p.xy, p.xy) * drop_per_m2;
  gl_Position = clip_from_rel * vec4(p, 1.0);
}
