// Objects, as render/materials/object-inl.h.
in vec3 v_p, v_normal, v_albedo;
in vec3 v_finish;  // roughness, metalness, translucency
in float v_level;
out vec4 colour;

uniform vec3 sea_light;

vec3 matt_light(vec3 normal) {
  float facing = dot(normal, sun_direction);
  float cos_sun = max(max(facing, -facing * v_finish.z), 0.0);
  vec3 around = mix(sea_light, ambient, 0.5 * normal.z + 0.5);
  return v_albedo * (1.0 - v_finish.y) * (sun_irradiance * (cos_sun * 0.318309886) + around);
}

vec3 gloss(vec3 normal, vec3 to_eye) {
  float cos_eye = max(dot(normal, to_eye), 0.0);
  float varnish = max(1.0 - v_finish.x / 0.84, 0.0) * fresnel(max(cos_eye, 0.1), 1.5);
  vec3 r = normal * (2.0 * cos_eye) - to_eye;
  float below = clamp(0.5 - 1.6 * r.z, 0.0, 1.0);
  float over = r.z - 0.02;
  r.z = 0.5 * (over + sqrt(over * over + 0.01)) + 0.02;
  vec3 sky = mix(sky_radiance(sky_soft, r, sqrt(dot(r, r))), sea_light,
                 below * below * (3.0 - 2.0 * below));
  vec3 half_way = to_eye + sun_direction;
  float cos_half = max(dot(normal, half_way), 0.0) *
                   inversesqrt(max(dot(half_way, half_way), 1e-6));
  float alpha = max(v_finish.x * v_finish.x, 0.0025), exponent = 2.0 / (alpha * alpha) - 2.0;
  float highlight = pow(clamp(cos_half, 1e-6, 1.0), exponent);
  float cos_sun = max(dot(normal, sun_direction), 0.0);
  return mix(vec3(0.04), v_albedo, v_finish.y) * sun_irradiance *
             (highlight * cos_sun * (exponent + 8.0) / (8.0 * 3.14159265)) +
         sky * mix(vec3(varnish), v_albedo, v_finish.y);
}

void main() {
  float length2 = dot(v_p, v_p), inv_length = inversesqrt(length2);
  vec3 to_eye = v_p * -inv_length;
  vec3 normal = normalize(v_normal);
#ifdef REFRACTION
  vec2 path = path_through_water(to_eye, max(v_level - v_p.z, 0.0));
  colour = to_lookup(absorb_in_water(matt_light(normal), path.y));
#else
  // The true direction to the eye, which a mirrored point has upside down.
#ifdef REFLECTION
  vec3 true_to_eye = vec3(to_eye.xy, -to_eye.z);
#else
  vec3 true_to_eye = to_eye;
#endif
  // The side that is seen, of a surface without a back.
  vec3 along = dFdx(v_p), aside = dFdy(v_p);
#ifdef REFLECTION
  along.z = -along.z, aside.z = -aside.z;
#endif
  vec3 flat_normal = cross(along, aside);
  if (dot(flat_normal, true_to_eye) * dot(flat_normal, normal) < 0.0) normal = -normal;
  vec3 light = matt_light(normal) + gloss(normal, true_to_eye);
  light = add_haze(light, v_p, to_eye, length2 * inv_length);
#ifdef REFLECTION
  colour = to_lookup(light);
#else
  colour = to_display(light);
#endif
#endif
}
