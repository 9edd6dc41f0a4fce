// Light through materials: KHR_materials_transmission, _ior, _volume. The including shader has `push.scene`.
#ifndef FOVERAY_RENDER_OPTICS_GLSL
#define FOVERAY_RENDER_OPTICS_GLSL

#include "shaders/render/brdf.glsl"
#include "shaders/shared/scene.h"
#include "shaders/shared/surface.h"

struct Optics {
    float transmission;  // share of the light that is not reflected
    float ior;
    bool solid;  // has an inside; otherwise a thin sheet that does not bend light
};

Material material_of(uint id) { return MaterialArray(SceneDataArray(push.scene).at[0].materials).at[id]; }

Optics optics_of(Surface surface) {
    if ((surface.flags & SURFACE_FLAG_TRANSMISSIVE) == 0) return Optics(0.0, 1.5, false);
    Material material = material_of(surface.material);
    return Optics(float(surface.flags >> 24) / 255.0, material.ior, (material.flags & MATERIAL_SOLID) != 0);
}

float dielectric_f0(float ior) {
    float r = (ior - 1.0) / (ior + 1.0);
    return r * r;
}

Brdf brdf_of(Surface surface, Optics optics) {
    Brdf brdf = make_brdf(surface.base_color, surface.metallic, surface.roughness);
    if (optics.transmission == 0.0) return brdf;
    brdf.diffuse *= 1.0 - optics.transmission;
    brdf.f0 = mix(vec3(dielectric_f0(optics.ior)), surface.base_color, surface.metallic);
    return brdf;
}

// Share of the light that goes into the material, before its colour.
float transmitted(Surface surface, Optics optics, vec3 view) {
    float reflected = fresnel(vec3(dielectric_f0(optics.ior)), max(dot(surface.normal, view), 0.0)).x;
    return optics.transmission * (1.0 - surface.metallic) * (1.0 - reflected);
}

// What a way through a solid leaves of the light.
vec3 absorption(uint material, float metres) { return exp(-material_of(material).attenuation * metres); }

#endif
