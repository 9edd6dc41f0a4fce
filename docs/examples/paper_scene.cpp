// The scene of Proceduray's section 4, by foveray's engine alone: a plane, two Pac-Men, a Julia set, a
// Mandelbulb.
//     paper_scene PICTURE.png
#include "shaders/examples/paper_scene.h"

#include <cmath>
#include <iostream>
#include <set>

#include "base/image.h"
#include "base/math.h"
#include "render/engine/ray_tracer.h"
#include "shaders/shared/ray_types.h"
#include "shaders/shared/scene.h"
#include "shaders/shared/shapes.h"

using namespace foveray;
using engine::HitGroup;
using engine::RayType;
using glm::mat4x3;
using shared::CsgRecord, shared::JuliaRecord, shared::MandelbulbRecord, shared::PlaneRecord,
    shared::ShapeHeader;

// How many ray types there are, and which structs shaders find in their records.
using Program =
    engine::Program<shared::RAY_TYPE_COUNT, PlaneRecord, CsgRecord, JuliaRecord, MandelbulbRecord>;
using RayTracer =
    engine::RayTracer<shared::RAY_TYPE_COUNT, PlaneRecord, CsgRecord, JuliaRecord, MandelbulbRecord>;

/// Hit groups of a shape: ⟨closest hit, any hit, intersection⟩ for surface rays, then for shadow rays.
template <class Record>
engine::GeometryType<Record> add_shape(Program& program, const std::string& name) {
    const std::string shaders = "render/shapes/" + name;
    return program.add_geometry_type<Record>(name, HitGroup{shaders + ".rchit", "", shaders + ".rint"},
                                             HitGroup{"", "", shaders + ".rint"});
}

/// A ball less a wedge between two boxes. Leaves are of unit size; a ray goes into their space.
std::vector<shared::CsgLeaf> pac_man_leaves(std::uint32_t skin, std::uint32_t mouth) {
    const auto leaf = [](std::uint32_t kind, std::uint32_t material, const mat4& object_from_leaf) {
        return shared::CsgLeaf{mat4x3(glm::inverse(object_from_leaf)), kind, material, 0, 0};
    };
    const auto jaw = [](float side) {  // a box whose face goes through the middle, turned by 30 degrees
        return glm::rotate(mat4(1.0f), side * radians(30.0f), vec3(0, 0, 1)) *
               glm::translate(mat4(1.0f), vec3(0, -side, 0));
    };
    return {leaf(shared::CSG_SPHERE, skin, glm::scale(mat4(1.0f), vec3(0.5f))),
            leaf(shared::CSG_BOX, mouth, jaw(1.0f)), leaf(shared::CSG_BOX, mouth, jaw(-1.0f))};
}

int main(int argc, char** argv) try {
    if (argc != 2) throw_bad_input("paper_scene", "names no picture", "paper_scene PICTURE.png");
    const gpu::Device device;
    const gpu::TextureTable textures(device);

    // 1. What can run: ray types with their miss shaders, geometry types with their hit groups, ray
    // generation.
    Program program("paper", RayType{"surface", "render/surface.rmiss"},
                    RayType{"shadow", "render/shadow.rmiss"});
    const auto plane = add_shape<PlaneRecord>(program, "plane");
    const auto pac_man = add_shape<CsgRecord>(program, "csg");
    const auto julia = add_shape<JuliaRecord>(program, "julia");
    const auto mandelbulb = add_shape<MandelbulbRecord>(program, "mandelbulb");
    const auto camera = program.add_ray_generation("examples/paper_scene.rgen");
    RayTracer tracer(device, textures, 1, std::move(program));

    // 2. What records refer to lies in buffers, reached by address.
    std::vector<shared::Material> material_list;
    for (const vec3 color : {vec3(0.8f), vec3(0.95f, 0.75f, 0.1f), vec3(0.6f, 0.1f, 0.1f),
                             vec3(0.3f, 0.5f, 0.8f), vec3(0.5f, 0.7f, 0.4f)}) {
        shared::Material material{};
        material.base_color = vec4(color, 1.0f);
        material_list.push_back(material);
    }
    const std::vector<std::uint32_t> steps = {0, 1, 2, shared::CSG_INTERSECTION, shared::CSG_DIFFERENCE};
    const std::vector<shared::InstanceData> previous(5);
    const std::vector<vk::AabbPositionsKHR> boxes = {{-8, -0.01f, -8, 8, 0.01f, 8},
                                                     {-0.5f, -0.5f, -0.5f, 0.5f, 0.5f, 0.5f},
                                                     {-1.5f, -1.5f, -1.5f, 1.5f, 1.5f, 1.5f},
                                                     {-1.2f, -1.2f, -1.2f, 1.2f, 1.2f, 1.2f}};
    gpu::Uploader uploader(device);
    const gpu::Buffer materials = uploader.buffer("materials", gpu::range_bytes(material_list));
    const gpu::Buffer leaves = uploader.buffer("leaves", gpu::range_bytes(pac_man_leaves(1, 2)));
    const gpu::Buffer program_of_solid = uploader.buffer("steps", gpu::range_bytes(steps));
    const gpu::Buffer instance_data = uploader.buffer("instances", gpu::range_bytes(previous));
    const gpu::Buffer box_buffer = uploader.buffer("boxes", gpu::range_bytes(boxes), gpu::build_input);
    uploader.flush();

    // 3. A bottom-level structure for each geometry, and its record. A record of another struct does not
    // compile.
    std::vector<gpu::BottomLevelInfo> infos;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        infos.push_back({"geometry " + std::to_string(i),
                         {gpu::BoxGeometry{box_buffer.address() + i * sizeof boxes[0], 1}}});
    }
    const auto levels = gpu::build_bottom_levels(device, infos);
    const auto header = [&](std::uint32_t material) {
        return ShapeHeader{materials.address(), instance_data.address(), material, 0, 0, 0};
    };
    const std::vector<std::uint32_t> offsets = tracer.set_table(
        {{Program::geometry(plane, {header(0), vec2(8.0f), 0.5f, vec3(0.25f)})},
         {Program::geometry(pac_man, {header(1), leaves.address(), program_of_solid.address(), 3, 5})},
         {Program::geometry(julia, {header(3), vec4(-0.2f, 0.6f, 0.2f, 0.2f), vec4(0.0f),
                                    vec3(1.0f, 0.6f, 0.3f), 1.5f, 12, 0})},
         {Program::geometry(mandelbulb, {header(4), vec3(1.0f, 0.5f, 0.5f), 8.0f, 1.2f, 10.0f, 6, 0})}});

    // 4. Instances: a geometry, where it stands, and where its records start.
    const auto at = [](vec3 place, float scale, float turn) {
        return mat4x3(
            glm::scale(glm::rotate(glm::translate(mat4(1.0f), place), turn, vec3(0, 1, 0)), vec3(scale)));
    };
    std::vector<gpu::TopLevelInstance> instances;
    const auto add = [&](std::size_t geometry, const mat4x3& world_from_object) {
        instances.push_back({.world_from_object = world_from_object,
                             .custom_index = static_cast<std::uint32_t>(instances.size()),
                             .record_offset = offsets[geometry],
                             .bottom_level = levels[geometry].address()});
    };
    add(0, at({0, 0, -3}, 1.0f, 0.0f));
    add(1, at({-0.9f, 0.5f, -3.0f}, 1.0f, -0.7f));
    add(1, at({0.9f, 0.5f, -3.0f}, 1.0f, -2.4f));
    add(2, at({-1.3f, 1.0f, -5.0f}, 0.8f, 0.5f));
    add(3, at({1.3f, 1.0f, -5.0f}, 0.8f, 0.0f));

    // Queries: what does a shadow ray find at the second Pac-Man?
    const auto& entry = tracer.entry(instances[2].record_offset, 0, shared::RAY_SHADOW);
    std::cout << "shadow rays at the second Pac-Man run "
              << tracer.program().hit_groups()[entry.hit_group].intersection << '\n';

    // 5. One dispatch.
    const std::uint32_t width = 480, height = 270;
    const gpu::Buffer pixels(device, "pixels", width * height * sizeof(vec3), gpu::Residence::Device);
    const gpu::Buffer result(device, "result", pixels.size(), gpu::Residence::Readback);
    gpu::TopLevel scene(device, "paper scene", 1);
    gpu::submit_and_wait(device, [&](const gpu::Commands& cmd) {
        scene.build(cmd, 0, instances);
        tracer.prepare(cmd, 0, scene);
        const shared::PaperPush push{pixels.address(), {0.0f, 1.9f, 1.0f}, {2.0f, 6.0f, 1.0f}};
        tracer.trace(cmd, camera, push, {width, height, 1});
        cmd.barrier(gpu::Access::RayTracingWrite, gpu::Access::TransferRead);
        cmd->copyBuffer(pixels.vk(), result.vk(), vk::BufferCopy(0, 0, pixels.size()));
        cmd.barrier(gpu::Access::TransferWrite, gpu::Access::HostRead);
    });
    result.invalidate();

    Image picture(width, height, 3);
    std::set<std::uint8_t> shades;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const float srgb = srgb_from_linear(std::clamp(result.mapped_as<float>()[i], 0.0f, 1.0f));
        picture.pixels[i] = static_cast<std::uint8_t>(std::lround(255.0f * srgb));
        shades.insert(picture.pixels[i]);
    }
    write_png(argv[1], picture);
    if (shades.size() < 100) throw Fault(ExitCode::Internal, argv[1], "the picture is empty", "look at it");
    return 0;
} catch (const Fault& fault) {
    std::cerr << fault.what() << '\n';
    return static_cast<int>(fault.code());
}
