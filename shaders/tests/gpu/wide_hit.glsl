#include "shaders/tests/gpu/probe_hit.glsl"

layout(shaderRecordEXT, scalar) buffer Record { WideRecord record; };

void write_wide_hit(uint shader) {
    write_hit(shader);
    hit.record = uint[8](unpackUint2x32(record.address).x, unpackUint2x32(record.address).y, record.id,
                         floatBitsToUint(record.value), floatBitsToUint(record.vector.x),
                         floatBitsToUint(record.vector.y), floatBitsToUint(record.vector.z), record.last);
}
