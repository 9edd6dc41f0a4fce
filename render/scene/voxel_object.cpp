#include "render/scene/voxel_object.h"

#include <algorithm>

#include <spdlog/fmt/fmt.h>

#include "base/log.h"
#include "render/scene/gltf_loader.h"
#include "render/scene/vox_file.h"
#include "render/scene/voxelize.h"

namespace foveray::scene {
namespace {

constexpr float default_voxel_size = 0.01f;  // metres

Voxels voxels_of_model(const SceneBuilder& builder, const std::filesystem::path& file,
                       std::uint32_t resolution) {
    SceneBuilder model(builder.files());
    GltfModel(model, file).instantiate({});
    std::optional<Voxels> voxels = voxelize(std::move(model).build(), resolution);
    if (!voxels) {
        throw_bad_input(file.string(), "makes no voxels, or more than 16 million nodes",
                        "take a model with triangles, or a smaller \"voxelize\"");
    }
    return *std::move(voxels);
}

}  // namespace

Shape read_voxel_object(SceneBuilder& builder, const SceneValues& values, const Json& object,
                        const std::string& place) {
    if (!object.contains("file")) {
        values.fault(place, "has no \"file\"", "name a .vox, .glb or .gltf file");
    }
    const std::filesystem::path file = values.path(object["file"]).lexically_normal();
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const bool from_model = extension == ".glb" || extension == ".gltf";
    if (!from_model && extension != ".vox") {
        values.fault(place + "/file", "\"" + file.filename().string() + "\" is no file of voxels",
                     "name a .vox, .glb or .gltf file");
    }
    if (from_model != object.contains("voxelize")) {
        values.fault(place,
                     from_model ? "has no \"voxelize\"" : "has a \"voxelize\", but a .vox file is voxels",
                     from_model ? "say how many voxels its longest side shall have" : "leave it out");
    }
    if (from_model && object.contains("voxel_size")) {
        values.fault(place + "/voxel_size", "is only for .vox files", "scale the object by its transform");
    }

    Shape shape;
    shape.kind = ShapeKind::Voxels;
    const std::uint32_t resolution = object.value("voxelize", 0u);
    const float size = values.number(object, "voxel_size", place, default_voxel_size);
    if (!(size >= smallest_shape && size <= 1.0f)) {
        values.fault(place + "/voxel_size", fmt::format("{} is out of range", size),
                     fmt::format("give {} to 1", smallest_shape));
    }
    shape.voxels_source = fmt::format("{} {} {}", file.string(), resolution, size);
    for (const Shape& other : builder.so_far().shapes) {
        if (other.voxels_source == shape.voxels_source) shape.voxels = other.voxels;
    }
    if (shape.voxels) return shape;
    builder.note_file(file);
    shape.voxels = std::make_shared<Voxels>(from_model ? voxels_of_model(builder, file, resolution)
                                                       : read_vox(file, size));
    const Voxels& v = *shape.voxels;
    log::info("{}: {} voxels, {:.1f} MiB", file.filename().string(), v.voxel_count(),
              static_cast<double>(v.bytes()) / (1 << 20));
    return shape;
}

}  // namespace foveray::scene
