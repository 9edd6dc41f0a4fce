// What the shaders of the shadow stage share; the including shader has `push` (ShadowPush).
#ifndef FOVERAY_RENDER_SHADOWS_GLSL
#define FOVERAY_RENDER_SHADOWS_GLSL

#include "shaders/shared/light_layers.h"
#include "shaders/shared/lighting.h"
#include "shaders/shared/portable.h"
#include "shaders/shared/shadows.h"
#include "shaders/shared/surface.h"

FOVERAY_ARRAY(VisibilityArray, uint);
FOVERAY_ARRAY(OpennessArray, float);

#endif
