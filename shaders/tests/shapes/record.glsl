// A closest-hit shader that writes out the record which it was given, whatever its type is.
#include "shaders/tests/shapes/rays.h"

layout(location = 0) rayPayloadInEXT RecordSeen seen;
layout(shaderRecordEXT, scalar) buffer RecordBlock { uint words[DEBUG_RECORD_WORDS]; } record;

void main() {
    seen.geometry_type = GEOMETRY_TYPE;
    seen.instance = gl_InstanceCustomIndexEXT;
    seen.geometry = gl_GeometryIndexEXT;
    for (uint i = 0; i < DEBUG_RECORD_WORDS; ++i) seen.words[i] = record.words[i];
}
