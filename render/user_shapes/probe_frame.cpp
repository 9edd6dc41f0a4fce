#include "render/user_shapes/probe_frame.h"

#include <cmath>

#include <glm/gtc/quaternion.hpp>

#include "render/user_shapes/compile.h"

namespace foveray::user_shapes {
namespace {

constexpr std::uint32_t side = 32;  // pixels
constexpr std::uint32_t pixels = shared::MAX_VIEWS * side * side;

const vec3 directions[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

scene::Scene scene_of(const scene::UserShape& user, scene::Shape shape) {
    scene::SceneBuilder builder;
    shape.user = builder.add(user);
    shape.animated = true;  // its values and box are those of the moment
    scene::Node node;
    node.shape = builder.add(std::move(shape));
    builder.add(std::move(node));
    scene::Scene scene = std::move(builder).build();
    scene.materials[0].double_sided = true;
    return scene;
}

View view_along(vec3 direction, vec3 from, float half_angle_degrees) {
    const float a = radians(half_angle_degrees);
    View view;
    view.size = uvec2(side);
    view.fov = {-a, a, a, -a};
    const vec3 up = std::abs(direction.y) > 0.9f ? vec3(0, 0, 1) : vec3(0, 1, 0);
    view.stage_from_eye = {glm::quatLookAt(direction, up), from};
    return view;
}

bool is_number(vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

ProbeFrame::ProbeFrame(const gpu::Device& device, gpu::TextureTable& textures, const scene::UserShape& user,
                       const scene::Shape& shape)
    : scene_(scene_of(user, shape)),
      animator_(scene_),
      ring_(device, 1),
      pipeline_(device, textures, 1, scene_, {compile(user)}),
      gpu_scene_(device, textures, scene_, 1),
      accel_(device, gpu_scene_, pipeline_, 1),
      primary_(pipeline_.tracer(), pipeline_.primary()),
      counters_(device, 1),
      grid_(device, "probe grid", sizeof(shared::SampleGrid), gpu::Residence::Upload),
      readback_(device, "probe surfaces", pixels * sizeof(shared::StoredSurface), gpu::Residence::Readback) {
    accel_.fill_table(pipeline_);
}

std::vector<shared::Surface> ProbeFrame::look(std::span<const View> views, const ProbeMoment& moment) {
    scene_.shapes[0].user_bounds = moment.shape.user_bounds;
    scene_.shapes[0].user_time = moment.shape.user_time;
    scene::SceneChanges changes = animator_.advance(0);
    changes.time = static_cast<Nanoseconds>(static_cast<double>(moment.seconds) * 1e9);
    changes.shapes[0] = {moment.shape.values, moment.shape.user_bounds, true};

    auto [params, grid] = render::pixel_grid(views, {});
    grid_.write(gpu::bytes_of(params));
    grid.grids = grid_.address();

    const vk::DeviceSize size = grid.sample_count * sizeof(shared::StoredSurface);
    const gpu::Commands cmd = ring_.begin();
    counters_.clear(cmd);
    const render::GpuSceneFrame frame = gpu_scene_.record(cmd, 0, changes, {});
    accel_.record(cmd, 0, frame, pipeline_);
    const render::Surfaces hits = primary_.record(cmd, grid, 0, counters_.address());
    cmd.barrier(gpu::Access::RayTracingWrite, gpu::Access::TransferRead);
    cmd->copyBuffer(hits.buffer->vk(), readback_.vk(), vk::BufferCopy(0, 0, size));
    cmd.barrier(gpu::Access::TransferWrite, gpu::Access::HostRead);
    ring_.submit();
    ring_.wait();
    readback_.invalidate();
    std::vector<shared::Surface> result;
    for (const auto& stored : readback_.mapped_as<shared::StoredSurface>().first(grid.sample_count))
        result.push_back(shared::surface_of(stored));
    return result;
}

void ProbeFrame::warm_up() {
    const scene::Aabb bounds = scene_.shapes[0].user_bounds;
    look(std::array{view_along({1, 0, 0}, bounds.max + bounds.extent(), 40.0f)}, {scene_.shapes[0], 0.0f});
}

std::optional<ProbeFrame::Finding> ProbeFrame::run(const ProbeMoment& moment) {
    const scene::Aabb bounds = moment.shape.user_bounds;
    const float away = 1.5f * glm::length(bounds.extent());
    std::vector<View> views;
    for (const vec3 direction : directions) {
        views.push_back(view_along(direction, bounds.center() - away * direction, 20.0f));
        views.push_back(view_along(direction, bounds.center(), 45.0f));
    }
    for (std::size_t i = 0; i < views.size(); i += shared::MAX_VIEWS) {
        for (const shared::Surface& s : look(std::span(views).subspan(i, shared::MAX_VIEWS), moment)) {
            if (s.kind == shared::SURFACE_NONE) continue;
            if (!std::isfinite(s.distance) || !is_number(s.position))
                return Finding{"is hit at a distance of NaN or infinity"};
            if (!is_number(s.normal)) return Finding{"has a normal of NaN or infinity"};
            if (!is_number(s.base_color)) return Finding{"returns a colour of NaN or infinity", true};
        }
    }
    return std::nullopt;
}

}  // namespace foveray::user_shapes
