// What every closest-hit shader of the probe writes.
#include "shaders/tests/gpu/probe.h"

layout(location = 0) rayPayloadInEXT ProbeHit hit;

void write_hit(uint shader) {
    hit.shader = shader;
    hit.distance = gl_HitTEXT;
    hit.instance = gl_InstanceID;
    hit.custom_index = gl_InstanceCustomIndexEXT;
    hit.geometry = gl_GeometryIndexEXT;
    hit.primitive = gl_PrimitiveID;
}
