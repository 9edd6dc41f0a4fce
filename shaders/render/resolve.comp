#version 460
#extension GL_GOOGLE_include_directive : require

// Samples to the pixels of one view.
#include "shaders/shared/scene.h"
#include "shaders/render/gaze_frame.glsl"
#include "shaders/render/vectors.glsl"
#include "shaders/render/view_space.glsl"
#include "shaders/shared/history.h"
#include "shaders/shared/light_layers.h"
#include "shaders/shared/resolve.h"
#include "shaders/shared/view_image.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push { ResolvePush push; };

// Most samples read along the circle; where a pixel covers more, every nth is.
const float MOST_ANGULAR_TAPS = 32.0;

// Of the real surface, what shows of it: both layers are premultiplied.
struct Filtered {
    vec4 radiance;  // and coverage
    vec3 transmitted;
    vec3 added;
    float weight;
};

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

// `angular` lies less than a turn below, or two above.
uint sample_at(PolarMap map, uint eye, int radial, int angular) {
    int height = int(map.height);
    angular += angular < 0 ? height : 0;
    angular -= angular >= height ? height : 0;
    angular -= angular >= height ? height : 0;
    return (eye * map.height + uint(angular)) * map.width + uint(radial);
}

// The kernel at the four samples round a place `f` of the way from the second to the third: kernel() as one polynomial.
vec4 kernel_taps(float f) {
    if (push.filter_kind == RESOLVE_BILINEAR) return vec4(0.0, 1.0 - f, f, 0.0);
    vec2 near = vec2(f, 1.0 - f), far = near + 1.0;
    near = ((7.0 * near - 12.0) * near * near + 16.0 / 3.0) / 6.0;
    far = (((-7.0 / 3.0 * far + 12.0) * far - 20.0) * far + 32.0 / 3.0) / 6.0;
    return vec4(far.x, near, far.y);
}

// Sum over samples, and what it must stay within.
struct Filter {
    Filtered sum;
    vec3 least, most;  // of the samples that the kernel's middle covers
    float brightest;   // of all
};

void add_polar(inout Filter f, uint index, uint count, float radial_weight, float angular_weight) {
    PackedLightArray light = PackedLightArray(push.packed);
    vec4 radiance = unpack_halves(light.at[index]);
    if (radiance.a == PACKED_CULLED) return;
    float weight = radial_weight * angular_weight;
    f.sum.weight += weight;
    f.sum.radiance += weight * radiance;
    if (push.layers > 1) {
        f.sum.transmitted += weight * unpack_halves(light.at[count + index]).rgb;
        f.sum.added += weight * unpack_halves(light.at[2 * count + index]).rgb;
    }
    f.brightest = max(f.brightest, greatest(radiance.rgb));
    if (radial_weight > 0.0 && angular_weight > 0.0) {
        f.least = min(f.least, radiance.rgb);
        f.most = max(f.most, radiance.rgb);
    }
}

// `place`: radial position in samples, sample centres at whole numbers, and angular position from angle 0; `stretch`:
// samples a pixel, at least 1, in both directions.
Filtered filter_polar(PolarMap map, uint eye, vec2 place, vec2 stretch) {
    Filter f = Filter(Filtered(vec4(0.0), vec3(0.0), vec3(0.0), 0.0), vec3(LARGEST_HALF), vec3(0.0), 0.0);
    int width = int(map.width), height = int(map.height);
    uint count = 2 * map.width * map.height;
    bool stretched = any(greaterThan(stretch, vec2(1.0)));
    vec2 reach = kernel_reach() * stretch, squeeze = 1.0 / stretch;
    int first = stretched ? int(ceil(place.x - reach.x)) : int(floor(place.x)) - 1;
    int last = stretched ? int(floor(place.x + reach.x)) : first + 3;
    int stride = int(ceil(2.0 * reach.y / MOST_ANGULAR_TAPS));
    vec4 radial_weights = kernel_taps(fract(place.x));
    for (int i = first; i <= last; ++i) {
        // Beyond the gaze the same circle goes on at the opposite angle.
        bool beyond = i < 0;
        int radial = min(beyond ? -1 - i : i, width - 1);
        float center = place.y - polar_ring_start(uint(radial)) + (beyond ? 0.5 * float(height) : 0.0);
        if (!stretched) {
            vec4 angular_weights = kernel_taps(fract(center));
            for (int j = 0; j < 4; ++j) {
                uint index = sample_at(map, eye, radial, int(floor(center)) - 1 + j);
                add_polar(f, index, count, radial_weights[i - first], angular_weights[j]);
            }
            continue;
        }
        float radial_weight = kernel((float(i) - place.x) * squeeze.x);
        int from = int(ceil((center - reach.y) / float(stride))) * stride;
        for (int j = from; float(j) <= center + reach.y; j += stride) {
            add_polar(f, sample_at(map, eye, radial, j), count, radial_weight, kernel((float(j) - center) * squeeze.y));
        }
    }
    // The kernel undershoots beside a highlight brighter than white, which would ring it with black.
    if (f.brightest > push.white && f.sum.weight > 0.0) {
        f.sum.radiance.rgb = clamp(f.sum.radiance.rgb, f.sum.weight * f.least, f.sum.weight * f.most);
    }
    if (push.layers == 1) f.sum.transmitted = vec3(f.sum.weight - f.sum.radiance.a);
    return f.sum;
}

void write_pixel(uint index, Filtered sum, float depth) {
    float scale = sum.weight > 1e-3 ? 1.0 / sum.weight : 0.0;
    float seen = sum.weight - sum.radiance.a;
    float seen_scale = seen > 1e-3 * sum.weight ? 1.0 / seen : 0.0;
    vec3 radiance = max(sum.radiance.rgb * scale, vec3(0.0));
    float coverage = clamp(sum.radiance.a * scale, 0.0, 1.0);
    vec3 transmittance = seen_scale > 0.0 ? clamp(sum.transmitted * seen_scale, 0.0, 1.0) : vec3(1.0);
    vec3 added = max(sum.added * seen_scale, vec3(0.0));
    ResolvedPixelArray(push.resolved).at[index] = ResolvedPixel(pack_light(vec4(radiance, coverage)));
    FloatArray(push.depth).at[index] = depth;
    if (push.real == 0) return;
    ResolvedRealPixelArray(push.real).at[index] =
        ResolvedRealPixel(pack_light(vec4(transmittance, 0.0)), pack_light(vec4(added, 0.0)));
}

void tint(inout Filtered sum, vec3 color, float part) {
    sum.radiance = mix(sum.radiance, sum.weight * vec4(color, 1.0), part);
    sum.transmitted *= 1.0 - part;
    sum.added *= 1.0 - part;
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
        ResolvedPixelArray(push.resolved).at[index] = ResolvedPixel(pack_light(vec4(vec3(0.0), -1.0)));
        FloatArray(push.depth).at[index] = infinity;
        if (push.real != 0) ResolvedRealPixelArray(push.real).at[index] = ResolvedRealPixel(uvec2(0), uvec2(0));
        return;
    }
    vec3 direction = view_direction(view, uv);

    Filtered sum;
    float distance = -1.0;  // of the nearest sample; < 0: none
    if (grid.at[0].kind == GRID_PIXELS) {
        LightSample s = LightSampleArray(push.samples).at[view.first_sample + index];
        float seen = 1.0 - s.coverage;
        sum = Filtered(vec4(s.radiance, s.coverage), seen * s.transmittance, seen * s.added, s.valid);
        if (s.valid > 0.0) distance = s.distance;
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
        cell.y = int(round(place.y - polar_ring_start(uint(cell.x))));
        SampleGuide nearest = SampleGuideArray(push.guides).at[sample_at(map, view.eye, cell.x, cell.y)];
        if (nearest.inverse_distance > 0.0) distance = 1.0 / nearest.inverse_distance;
        if (push.debug_view == RESOLVE_DEBUG_TILES) {
            ivec2 tile = ivec2(vec2(polar.x, degrees(polar.y)) / 15.0);
            tint(sum, (tile.x + tile.y & 1) == 0 ? vec3(0.1, 0.4, 0.8) : vec3(0.8, 0.5, 0.1), 0.4);
        }
        if (push.debug_view == RESOLVE_DEBUG_SAMPLES && (cell.x + cell.y & 1) == 0) tint(sum, vec3(0.0), 0.4);
    }
    float depth = distance >= 0.0 ? distance * dot(direction, view.forward) : infinity;
    write_pixel(index, sum, depth);
}
