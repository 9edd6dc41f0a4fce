// What the simulated headset draws: one layer, or the background, as one eye sees it.
#ifndef FOVERAY_SHARED_COMPOSITION_H
#define FOVERAY_SHARED_COMPOSITION_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

FOVERAY_CONST uint COMPOSITION_GROUP = 8u;  // pixels a side

// Bindings of set 0.
FOVERAY_CONST uint COMPOSITION_DRAWS = 0u;
FOVERAY_CONST uint COMPOSITION_LIGHT = 1u;  // a pixel of the eye: premultiplied, four halves
FOVERAY_CONST uint COMPOSITION_BYTES = 2u;  // a pixel of both eyes: sRGB, the left eye's picture first
FOVERAY_CONST uint COMPOSITION_SOURCE = 3u;
FOVERAY_CONST uint COMPOSITION_FOCUS = 4u;

FOVERAY_CONST uint COMPOSITION_PROJECTION = 0u;
FOVERAY_CONST uint COMPOSITION_FOCUSED_PROJECTION = 1u;  // with a focus view in it
FOVERAY_CONST uint COMPOSITION_QUAD = 2u;
FOVERAY_CONST uint COMPOSITION_CYLINDER = 3u;
FOVERAY_CONST uint COMPOSITION_EQUIRECT = 4u;

FOVERAY_CONST uint COMPOSITION_SOURCE_ALPHA = 1u;  // else the layer is opaque
FOVERAY_CONST uint COMPOSITION_UNPREMULTIPLIED = 2u;
FOVERAY_CONST uint COMPOSITION_SCALE_BIAS = 4u;

// What is behind the layers, and how their alpha lets it through.
FOVERAY_CONST uint COMPOSITION_COLOR = 0u;        // `scale`
FOVERAY_CONST uint COMPOSITION_ENVIRONMENT = 1u;  // equirectangular, its middle ahead (-z)
FOVERAY_CONST uint COMPOSITION_PICTURE = 2u;      // fills the eye's picture, cut to its shape
FOVERAY_CONST uint COMPOSITION_BLEND_OPAQUE = 0u;
FOVERAY_CONST uint COMPOSITION_BLEND_ADDITIVE = 1u;
FOVERAY_CONST uint COMPOSITION_BLEND_ALPHA = 2u;

// A picture and where it is. Vectors of four only, so that std430 lays it out as C++ does.
struct CompositionSource {
    vec4 source_from_eye;  // quaternion x, y, z, w
    // Projection: tangents left, right, up, down. Quad: width, height. Cylinder: angle, height over radius.
    // Equirectangular: horizontal angle, upper and lower vertical angle.
    vec4 shape;
    vec4 rect;  // texels: offset, extent
};

struct CompositionDraw {
    vec4 tangents;  // of the eye's picture: left, right, up, down
    uvec4 picture;  // width, height, first pixel of the eye in the bytes, unused
    uvec4 what;     // layers: kind, flags; the background: kind, blend; unused
    vec4 origin;    // of the eye in the layer's frame; w: radius, 0 when infinite
    CompositionSource source;
    CompositionSource focus;
    vec4 scale;  // of colour and alpha
    vec4 bias;
};

FOVERAY_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(foveray::shared::CompositionDraw) == 192);
static_assert(offsetof(foveray::shared::CompositionDraw, focus) == 112);
#endif

#endif
