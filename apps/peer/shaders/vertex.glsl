// Vertices of all surfaces, as render/view/render_view.cpp maps them: the world itself, mirrored in
// the water's level (REFLECTION), or squeezed towards it (REFRACTION).
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
out vec3 v_p;

const float clip_margin_m = 0.3;

float squeeze(vec3 p) {
  float horizontal2 = dot(p.xy, p.xy);
  float sin2 = horizontal2 / (horizontal2 + p.z * p.z + 1e-6);
  return sqrt((1.0 - sin2) / (refraction_index * refraction_index - sin2));
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
  p.z = level + (above_m < 0.0 ? above_m * squeeze(p) : above_m);
#endif
  v_p = p;
  p.z -= dot(p.xy, p.xy) * drop_per_m2;
  gl_Position = clip_from_rel * vec4(p, 1.0);
}
