// glTF 2.0's metallic-roughness material, appendix B of its specification.
#ifndef FOVERAY_RENDER_BRDF_GLSL
#define FOVERAY_RENDER_BRDF_GLSL

const float PI = 3.141592653589793;

struct Brdf {
    vec3 diffuse;  // albedo of the diffuse part
    vec3 f0;       // mirror reflection at normal incidence
    float alpha;   // roughness²
};

Brdf make_brdf(vec3 base_color, float metallic, float roughness) {
    // Below this a highlight of a punctual light is too small to be sampled.
    const float least_roughness = 0.045;
    float r = max(roughness, least_roughness);
    return Brdf(base_color * (1.0 - metallic), mix(vec3(0.04), base_color, metallic), r * r);
}

// Appendix B.2.3, eq. of Schlick.
vec3 fresnel(vec3 f0, float v_dot_h) {
    float c = clamp(1.0 - v_dot_h, 0.0, 1.0);
    float c2 = c * c;
    return f0 + (1.0 - f0) * (c2 * c2 * c);
}

// Trowbridge-Reitz (GGX) distribution of normals.
float normal_distribution(float alpha, float n_dot_h) {
    float a2 = alpha * alpha;
    float d = n_dot_h * n_dot_h * (a2 - 1.0) + 1.0;
    return a2 / (PI * d * d);
}

// Smith's masking and shadowing over 4 (n·l)(n·v).
float visibility(float alpha, float n_dot_l, float n_dot_v) {
    float a2 = alpha * alpha;
    float l = n_dot_l + sqrt(a2 + (1.0 - a2) * n_dot_l * n_dot_l);
    float v = n_dot_v + sqrt(a2 + (1.0 - a2) * n_dot_v * n_dot_v);
    return 1.0 / max(l * v, 1e-7);
}

vec3 brdf_diffuse(Brdf brdf, float v_dot_h) { return (1.0 - fresnel(brdf.f0, v_dot_h)) * brdf.diffuse / PI; }

vec3 brdf_specular(Brdf brdf, float n_dot_l, float n_dot_v, float n_dot_h, float v_dot_h) {
    return fresnel(brdf.f0, v_dot_h) * normal_distribution(brdf.alpha, n_dot_h) *
           visibility(brdf.alpha, n_dot_l, n_dot_v);
}

// Value for one direction of light, unit vectors; without n·l.
vec3 brdf_value(Brdf brdf, vec3 n, vec3 v, vec3 l) {
    vec3 h = normalize(l + v);
    float v_dot_h = clamp(dot(v, h), 0.0, 1.0);
    return brdf_diffuse(brdf, v_dot_h) + brdf_specular(brdf, clamp(dot(n, l), 0.0, 1.0), clamp(dot(n, v), 1e-4, 1.0),
                                                       clamp(dot(n, h), 0.0, 1.0), v_dot_h);
}

// Mirror part of a light that is `widening` broader (tangent of half its angle, about) than a point in the direction
// l: Karis 2013, "Real Shading in Unreal Engine 4", eq. 10 and 14.
vec3 brdf_specular_widened(Brdf brdf, vec3 n, vec3 v, vec3 l, float widening) {
    vec3 h = normalize(l + v);
    float ratio = brdf.alpha / min(brdf.alpha + widening, 1.0);
    return ratio * ratio * brdf_specular(brdf, dot(n, l), clamp(dot(n, v), 1e-4, 1.0), clamp(dot(n, h), 0.0, 1.0),
                                         clamp(dot(v, h), 0.0, 1.0));
}

// Part of light from everywhere that the mirror part reflects: Karis 2014, "Physically Based Shading on Mobile", a
// fit to the split sum's second half (Karis 2013, eq. 8).
vec3 specular_albedo(Brdf brdf, float roughness, float n_dot_v) {
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * n_dot_v)) * r.x + r.y;
    vec2 scale_bias = vec2(-1.04, 1.04) * a + r.zw;
    return clamp(brdf.f0 * scale_bias.x + scale_bias.y, 0.0, 1.0);
}

#endif
