#version 460
#extension GL_GOOGLE_include_directive : require

// First pass of the history stage: what each sample saw, compactly, for its neighbours and the next frame.
#include "shaders/render/history.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { HistoryPush push; };

uint id_of(Surface surface) {
    // Knuth's multiplicative hash.
    return ((surface.instance * 2654435761u) ^ (surface.material * 40503u)) << 2 | surface.kind;
}

PreviousPlace previous_place(uint eye, Surface surface, bool something, vec3 direction) {
    HistoryFrameArray before = HistoryFrameArray(push.previous_frame);
    GazeFrame gaze = before.at[0].gaze[eye];
    PolarMap map = before.at[0].polar;
    vec3 way = something ? surface.previous_position - gaze.origin : direction;
    vec2 polar = polar_coordinates(gaze, way);
    return PreviousPlace(polar_radius(map, polar.x) * float(map.width) / map.radius_outer - 0.5,
                         polar.y / TWO_PI * float(map.height), something ? inversesqrt(dot(way, way)) : 0.0);
}

void main() {
    SampleGridArray grid = SampleGridArray(push.grid);
    uint index = gl_GlobalInvocationID.x;
    if (index == 0) {
        HistoryFrame frame;
        for (uint eye = 0; eye < 2; ++eye) frame.gaze[eye] = GazeFrameArray(grid.at[0].gaze_frames).at[eye];
        frame.polar = grid.at[0].polar;
        HistoryFrameArray(push.frame).at[0] = frame;
    }
    if (index >= grid.at[0].sample_count) return;
    LightSampleArray samples = LightSampleArray(push.samples);
    SampleGuide guide = SampleGuide(0.0, 0, SURFACE_CULLED, 0xFFFFFFFFu);
    if (samples.at[index].valid != 0.0) {
        Surface surface = surface_of(SurfaceArray(push.surfaces).at[index]);
        float distance = samples.at[index].distance;
        bool something = distance >= 0.0;
        guide.inverse_distance = something ? 1.0 / max(distance, 1e-6) : 0.0;
        guide.id = something ? id_of(surface) : SURFACE_NONE;
        guide.normal = something ? pack_normal(surface.geometric_normal) : 0;
        if (push.places != 0) {
            PolarMap map = grid.at[0].polar;
            uint radial = index % map.width, angular = index / map.width % map.height;
            uint eye = index / (map.width * map.height);
            GazeFrame gaze = GazeFrameArray(grid.at[0].gaze_frames).at[eye];
            vec3 direction = polar_direction(gaze, sample_eccentricity(map, radial),
                                             TWO_PI * (float(angular) + polar_ring_start(radial)) / float(map.height));
            PreviousPlaceArray(push.places).at[index] = previous_place(eye, surface, something, direction);
        }
        if (push.shadowed != 0) guide.visibility = ShadowedLightArray(push.shadowed).at[index].visibility;
    }
    SampleGuideArray(push.guides).at[index] = guide;
}
