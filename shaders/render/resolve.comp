#version 460
#extension GL_GOOGLE_include_directive : require

// Samples to the pixels of one view.
#include "shaders/shared/scene.h"
#include "shaders/render/gaze_frame.glsl"
#include "shaders/render/view_space.glsl"
#include "shaders/shared/light_layers.h"
#include "shaders/shared/resolve.h"
#include "shaders/shared/view_image.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push { ResolvePush push; };

// Most samples read along the circle; where a pixel covers more, every nth is.
const float MOST_ANGULAR_TAPS = 32.0;

struct Filtered {
    vec3 radiance;
    float coverage;
    vec3 transmittance;  // weighted by what of the real surface is seen, like `added`
    vec3 added;
    float weight, seen;
};

void add_sample(inout Filtered sum, LightSample s, float weight) {
    if (s.valid == 0.0) return;
    sum.weight += weight;
    sum.radiance += weight * s.radiance;
    sum.coverage += weight * s.coverage;
    float seen = weight * (1.0 - s.coverage);
    sum.seen += seen;
    sum.transmittance += seen * s.transmittance;
    sum.added += seen * s.added;
}

// Reach of the kernel in samples.
float kernel_reach() { return push.filter_kind == RESOLVE_BILINEAR ? 1.0 : 2.0; }

float kernel(float x) {
    x = abs(x);
    if (push.filter_kind == RESOLVE_BILINEAR) return max(1.0 - x, 0.0);
    // Mitchell and Netravali 1988, "Reconstruction Filters in Computer Graphics", B = C = 1/3: between the jagged edges
    // of a sharper cubic and the blur of a smoother one.
    if (x < 1.0) return ((7.0 * x - 12.0) * x * x + 16.0 / 3.0) / 6.0;
    return x < 2.0 ? (((-7.0 / 3.0 * x + 12.0) * x - 20.0) * x + 32.0 / 3.0) / 6.0 : 0.0;
}

LightSample polar_sample(PolarMap map, uint eye, int radial, int angular) {
    uint index = (eye * map.height + uint(angular)) * map.width + uint(radial);
    return LightSampleArray(push.samples).at[index];
}

// `place`: radial position in samples, sample centres at whole numbers, and angular position from angle 0; `stretch`:
// samples a pixel, at least 1, in both directions.
Filtered filter_polar(PolarMap map, uint eye, vec2 place, vec2 stretch) {
    Filtered sum = Filtered(vec3(0.0), 0.0, vec3(0.0), vec3(0.0), 0.0, 0.0);
    vec3 least = vec3(65504.0), most = vec3(0.0);  // of the samples that the kernel's middle covers
    vec2 reach = kernel_reach() * stretch;
    int height = int(map.height);
    int stride = int(ceil(2.0 * reach.y / MOST_ANGULAR_TAPS));
    for (int i = int(ceil(place.x - reach.x)); i <= int(floor(place.x + reach.x)); ++i) {
        float radial_weight = kernel((float(i) - place.x) / stretch.x);
        // Beyond the gaze the same circle goes on at the opposite angle.
        bool beyond = i < 0;
        int radial = min(beyond ? -1 - i : i, int(map.width) - 1);
        float center = place.y - polar_ring_start(uint(radial)) + (beyond ? 0.5 * float(height) : 0.0);
        for (int j = int(ceil((center - reach.y) / float(stride))) * stride; float(j) <= center + reach.y; j += stride) {
            float angular_weight = kernel((float(j) - center) / stretch.y);
            float weight = radial_weight * angular_weight;
            if (weight == 0.0) continue;
            LightSample s = polar_sample(map, eye, radial, (j % height + height) % height);
            add_sample(sum, s, weight);
            if (s.valid > 0.0 && radial_weight > 0.0 && angular_weight > 0.0) {
                least = min(least, s.radiance);
                most = max(most, s.radiance);
            }
        }
    }
    // The kernel undershoots beside a highlight brighter than white, which would ring it with black.
    if (max(most.r, max(most.g, most.b)) > 1.0 && sum.weight > 0.0) {
        sum.radiance = clamp(sum.radiance, sum.weight * least, sum.weight * most);
    }
    return sum;
}

void write_pixel(uint index, Filtered sum, float depth) {
    float scale = sum.weight > 1e-3 ? 1.0 / sum.weight : 0.0;
    float seen_scale = sum.seen > 1e-3 * sum.weight ? 1.0 / sum.seen : 0.0;
    vec3 radiance = max(sum.radiance * scale, vec3(0.0));
    float coverage = clamp(sum.coverage * scale, 0.0, 1.0);
    vec3 transmittance = seen_scale > 0.0 ? clamp(sum.transmittance * seen_scale, 0.0, 1.0) : vec3(1.0);
    vec3 added = max(sum.added * seen_scale, vec3(0.0));
    ResolvedPixel pixel;
    const float most = 65504.0;  // of a half
    pixel.radiance = uvec2(packHalf2x16(min(radiance.rg, most)), packHalf2x16(vec2(min(radiance.b, most), coverage)));
    pixel.transmittance = uvec2(packHalf2x16(transmittance.rg), packHalf2x16(vec2(transmittance.b, 1.0)));
    pixel.added = uvec2(packHalf2x16(min(added.rg, most)), packHalf2x16(vec2(min(added.b, most), 0.0)));
    pixel.depth = depth;
    ResolvedPixelArray(push.resolved).at[index] = pixel;
}

void tint(inout Filtered sum, vec3 color, float part) {
    sum.radiance = mix(sum.radiance, sum.weight * color, part);
    sum.coverage = mix(sum.coverage, sum.weight, part);
}

void main() {
    SampleGridArray grid = SampleGridArray(push.grid);
    ViewParams view = grid.at[0].views[push.view];
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, view.size))) return;
    uint index = pixel.y * view.size.x + pixel.x;
    vec2 uv = (vec2(pixel) + 0.5) / vec2(view.size);
    const float infinity = uintBitsToFloat(0x7F800000u);
    if (hidden_at(view, uv)) {
        uvec2 nothing = uvec2(0);
        ResolvedPixelArray(push.resolved).at[index] = ResolvedPixel(nothing, nothing, nothing, infinity);
        return;
    }
    vec3 direction = view_direction(view, uv);

    Filtered sum;
    LightSample nearest;
    if (grid.at[0].kind == GRID_PIXELS) {
        sum = Filtered(vec3(0.0), 0.0, vec3(0.0), vec3(0.0), 0.0, 0.0);
        nearest = LightSampleArray(push.samples).at[view.first_sample + index];
        add_sample(sum, nearest, 1.0);
    } else {
        PolarMap map = grid.at[0].polar;
        GazeFrame gaze = GazeFrameArray(grid.at[0].gaze_frames).at[view.eye];
        vec2 polar = polar_coordinates(gaze, direction);
        float e = min(polar.x, map.outer);
        vec2 place = vec2(polar_radius(map, e) * float(map.width) / map.radius_outer - 0.5,
                          polar.y / TWO_PI * float(map.height));
        float pixel_degrees = degrees(pixel_angle(view, uv));
        vec2 spacing = vec2(polar_radial_spacing(map, e), polar_angular_spacing(map, e));
        // No further round than the circle.
        vec2 stretch = max(pixel_degrees / max(spacing, 1e-9), 1.0);
        stretch.y = min(stretch.y, 0.5 * float(map.height) / kernel_reach());
        sum = filter_polar(map, view.eye, place, stretch);
        ivec2 cell;
        cell.x = clamp(int(round(place.x)), 0, int(map.width) - 1);
        cell.y = (int(round(place.y - polar_ring_start(uint(cell.x)))) + int(map.height)) % int(map.height);
        nearest = polar_sample(map, view.eye, cell.x, cell.y);
        if (push.debug_view == RESOLVE_DEBUG_TILES) {
            ivec2 tile = ivec2(vec2(polar.x, degrees(polar.y)) / 15.0);
            tint(sum, (tile.x + tile.y & 1) == 0 ? vec3(0.1, 0.4, 0.8) : vec3(0.8, 0.5, 0.1), 0.4);
        }
        if (push.debug_view == RESOLVE_DEBUG_SAMPLES && (cell.x + cell.y & 1) == 0) tint(sum, vec3(0.0), 0.4);
    }
    float depth = nearest.valid > 0.0 && nearest.distance >= 0.0 ? nearest.distance * dot(direction, view.forward)
                                                                 : infinity;
    write_pixel(index, sum, depth);
}
