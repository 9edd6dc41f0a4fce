#include "render/probes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/gpu_lights.h"
#include "render/grow.h"
#include "render/scene/scene.h"
#include "render/scene_textures.h"

namespace foveray::render {
namespace {

// A frame that takes no session time, as when one moment is drawn again and again, counts as this much.
constexpr float shortest_frame = 1.0f / 90.0f;
constexpr float longest_frame = 1.0f;
// Probes settle in this long after geometry has changed.
constexpr float settling = 1.0f;
// Light is taken to have changed at once for this long after it did.
constexpr float surprise = 0.5f;

/// Interleaves the bits of two coordinates of 16 bits: neighbours in the order are neighbours in the plane.
std::uint32_t morton(std::uint32_t x, std::uint32_t y) {
    std::uint32_t code = 0;
    for (std::uint32_t bit = 0; bit < 16; ++bit)
        code |= (x >> bit & 1u) << (2 * bit) | (y >> bit & 1u) << (2 * bit + 1);
    return code;
}

std::uint32_t place_of(vec3 direction) {
    const vec2 at = 32767.0f * (shared::octahedral_from_direction(direction) + 1.0f);
    return morton(static_cast<std::uint32_t>(at.x), static_cast<std::uint32_t>(at.y));
}

bool geometry_changed(const scene::SceneChanges& changes) {
    const auto changed = [](const auto& state) { return state.changed; };
    return changes.transforms_changed || std::ranges::any_of(changes.shapes, changed) ||
           std::ranges::any_of(changes.deformations, changed);
}

std::vector<std::byte> lighting_of(const ProbeInput& input) {
    std::vector<std::byte> bytes;
    const auto add = [&](std::span<const std::byte> more) {
        bytes.insert(bytes.end(), more.begin(), more.end());
    };
    const std::vector<shared::Light> lights = pack_lights(input.changes);
    add(gpu::range_bytes(lights));
    for (const scene::MaterialState& material : input.changes.materials) {
        shared::Material packed{};
        pack_values(material.values, packed);
        add(gpu::bytes_of(packed));
    }
    add(gpu::bytes_of(input.settings.environment_intensity));
    add(gpu::bytes_of(input.settings.shadows));
    return bytes;
}

/// Another buffer with other contents, while earlier frames go on with the one before.
void replace(const gpu::Commands& cmd, gpu::Buffer& buffer, const char* name,
             std::span<const std::byte> data) {
    gpu::Buffer other(cmd.device(), name, data.size(), gpu::Residence::Device);
    cmd->updateBuffer<std::byte>(
        other.vk(), 0, vk::ArrayProxy<const std::byte>(static_cast<std::uint32_t>(data.size()), data.data()));
    if (buffer) cmd.release(std::move(buffer));
    buffer = std::move(other);
}

}  // namespace

std::vector<vec3> probe_directions(std::uint32_t count) {
    std::vector<vec3> directions;
    for (std::uint32_t i = 0; i < count; ++i) {
        const float turns = static_cast<float>(i) * 0.6180339887f;
        const float azimuth = 2.0f * pi * (turns - std::floor(turns));
        const float y = 1.0f - (2.0f * static_cast<float>(i) + 1.0f) / static_cast<float>(count);
        const float radius = std::sqrt(1.0f - y * y);
        directions.emplace_back(radius * std::cos(azimuth), y, radius * std::sin(azimuth));
    }
    std::ranges::sort(directions, {}, place_of);
    return directions;
}

// Shoemake 1992, "Uniform Random Rotations", at the points of Roberts' R3 sequence.
quat probe_rotation(std::uint32_t frame) {
    const auto i = static_cast<double>(frame % shared::PROBE_ROTATIONS);
    const auto part = [&](double step) { return static_cast<float>(std::fmod(0.5 + i * step, 1.0)); };
    const float u = part(0.8191725134), v = 2.0f * pi * part(0.6710436067),
                w = 2.0f * pi * part(0.5497004779);
    const float a = std::sqrt(1.0f - u), b = std::sqrt(u);
    return {b * std::cos(w), a * std::sin(v), a * std::cos(v), b * std::sin(w)};
}

ProbeStage::ProbeStage(const gpu::Device& device, const gpu::TextureTable& textures,
                       const scene::Scene& scene, const engine::SceneRayTracer& tracer,
                       engine::RayGeneration probes)
    : tracer_(tracer),
      probes_(probes),
      update_(device, "render/probe_update.comp", textures, sizeof(shared::ProbePush)),
      wanted_grid_(scene.probes) {}

void ProbeStage::set_scene(const scene::Scene& scene) {
    wanted_grid_ = scene.probes;
    scene_changed_ = true;
}

void ProbeStage::place(const gpu::Commands& cmd) {
    for (gpu::Buffer* old :
         {&field_buffer_, &states_, &light_, &depth_, &light_sums_, &depth_sums_, &rays_, &directions_}) {
        if (*old) cmd.release(std::move(*old));
    }
    grid_ = wanted_grid_;
    field_ = {};
    ray_count_ = 0;
    frame_ = 0;
    last_time_.reset();
    if (!grid_) return;
    const scene::ProbeGrid& grid = *grid_;
    probe_count_ = grid.counts.x * grid.counts.y * grid.counts.z;
    const auto buffer = [&](const char* name, std::size_t bytes_a_probe) {
        return gpu::Buffer(cmd.device(), name, vk::DeviceSize{probe_count_} * bytes_a_probe,
                           gpu::Residence::Device);
    };
    states_ = buffer("probe states", sizeof(shared::ProbeState));
    light_ = buffer("probe light", shared::PROBE_LIGHT_TEXELS * sizeof(std::uint32_t));
    depth_ = buffer("probe depth", shared::PROBE_DEPTH_TEXELS * sizeof(std::uint32_t));
    light_sums_ = buffer("probe light sums", shared::PROBE_LIGHT_TEXELS * sizeof(vec3));
    depth_sums_ = buffer("probe depth sums", shared::PROBE_DEPTH_TEXELS * sizeof(vec2));

    field_.spacing = (grid.max - grid.min) / (vec3(grid.counts) - 0.5f);
    field_.first = grid.min + 0.25f * field_.spacing;
    field_.count_x = grid.counts.x;
    field_.count_y = grid.counts.y;
    field_.count_z = grid.counts.z;
    field_.states = states_.address();
    field_.light = light_.address();
    field_.depth = depth_.address();
    field_.light_sums = light_sums_.address();
    field_.depth_sums = depth_sums_.address();
    cmd->fillBuffer(states_.vk(), 0, states_.size(), 0);
    cmd.barrier(gpu::Access::TransferWrite, gpu::Access::RayTracingRead);
    cmd.barrier(gpu::Access::TransferWrite, gpu::Access::ComputeWrite);
}

void ProbeStage::set_directions(const gpu::Commands& cmd, std::uint32_t ray_count) {
    if (ray_count == ray_count_) return;
    ray_count_ = ray_count;
    grow(cmd, rays_, "probe rays", vk::DeviceSize{probe_count_} * ray_count * 2 * sizeof(std::uint32_t));
    replace(cmd, directions_, "probe directions", gpu::range_bytes(probe_directions(ray_count)));
    field_.rays = rays_.address();
    field_.directions = directions_.address();
    replace(cmd, field_buffer_, "probe field", gpu::bytes_of(field_));
    cmd.barrier(gpu::Access::TransferWrite, gpu::Access::RayTracingRead);
    cmd.barrier(gpu::Access::TransferWrite, gpu::Access::ComputeRead);
}

float ProbeStage::advance(const ProbeInput& input) {
    const scene::SceneChanges& changes = input.changes;
    const float passed = last_time_ ? static_cast<float>(to_seconds(changes.time - *last_time_)) : 0.0f;
    const float seconds = passed > 0.0f ? std::min(passed, longest_frame) : shortest_frame;
    std::vector<std::byte> lighting = lighting_of(input);
    const bool light = lighting != lighting_, other_time = last_time_ && changes.time != *last_time_;
    const bool geometry = std::exchange(scene_changed_, false) || geometry_changed(changes) ||
                          (input.shapes_follow_time && other_time);
    lighting_ = std::move(lighting);
    since_start_ = last_time_ ? since_start_ + seconds : 0.0f;
    since_geometry_change_ = geometry ? 0.0f : since_geometry_change_ + seconds;
    since_change_ = light || geometry ? 0.0f : since_change_ + seconds;
    last_time_ = changes.time;
    return seconds;
}

shared::ProbePush ProbeStage::push_of(const ProbeInput& input, float seconds) const {
    const Settings& settings = input.settings;
    const quat rotation = probe_rotation(frame_);
    // A mean over the last part of the time since the change, so that light's later bounces, which start from
    // the earlier ones' errors, catch up.
    const float still = std::clamp(since_change_ / 8.0f, usual, slowest);
    const float memory = std::min(still, seconds + since_start_ / 3.0f);
    shared::ProbePush push{};
    push.probes = field_buffer_.address();
    push.scene = input.scene;
    push.counters = input.counters;
    push.rotation = {rotation.x, rotation.y, rotation.z, rotation.w};
    push.flags = (settings.shadows ? shared::PROBES_SHADOWS : 0u) |
                 (settings.probe_sleeping ? shared::PROBES_SLEEP : 0u) |
                 (!settings.probe_sleeping || since_start_ < 0.25f * settling ? shared::PROBES_ALL_DUE : 0u) |
                 (since_geometry_change_ < settling ? shared::PROBES_RELOCATE : 0u);
    push.ray_count = ray_count_;
    push.frame_index = frame_;
    push.environment_intensity = settings.environment_intensity;
    push.decay = seconds / memory;
    push.fast_decay = since_change_ < surprise ? std::max(seconds / fastest, push.decay) : 0.0f;
    return push;
}

ProbeField ProbeStage::record(const gpu::Commands& cmd, const ProbeInput& input) {
    using gpu::Access;
    const bool wanted = wanted_grid_ && input.settings.probes;
    if (wanted_grid_ != grid_ && (wanted || grid_)) place(cmd);
    if (!wanted) return {};
    const auto stage = cmd.stage("probes");
    set_directions(cmd, static_cast<std::uint32_t>(input.settings.probe_rays));
    const shared::ProbePush push = push_of(input, advance(input));
    ++frame_;

    cmd.barrier(Access::ComputeRead, Access::RayTracingWrite);  // the last update read its rays
    tracer_.trace(cmd, probes_, push, {ray_count_, probe_count_, 1});
    cmd.barrier(Access::RayTracingWrite, Access::ComputeRead);
    // Earlier frames' light and this trace have read the maps.
    cmd.barrier(Access::RayTracingRead, Access::ComputeWrite);
    update_.dispatch(cmd, push, {256 * probe_count_, 1, 1}, {256, 1, 1});
    cmd.barrier(Access::ComputeWrite, Access::RayTracingRead);
    cmd.barrier(Access::ComputeWrite, Access::ComputeRead);
    cmd.barrier(Access::ComputeWrite, Access::ComputeWrite);  // of the next update
    return {field_buffer_.address()};
}

}  // namespace foveray::render
