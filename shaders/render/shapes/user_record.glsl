// The record of a user's own shape.
#ifndef FOVERAY_RENDER_SHAPES_USER_RECORD_GLSL
#define FOVERAY_RENDER_SHAPES_USER_RECORD_GLSL

#include "shaders/shared/shapes.h"

layout(shaderRecordEXT, scalar) buffer RecordBlock { UserRecord record; };

#endif
