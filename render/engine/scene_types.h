#pragma once

#include "render/engine/ray_tracer.h"
#include "shaders/shared/ray_types.h"
#include "shaders/shared/scene.h"
#include "shaders/shared/shapes.h"
#include "shaders/shared/voxels.h"

namespace foveray::engine {

/// foveray's own instance of the engine. A new primitive adds its record here.
///
///     SceneProgram program("scene", RayType{"surface", "render/surface.rmiss"}, RayType{"shadow",
///     "render/shadow.rmiss"}); auto triangles = program.add_geometry_type<shared::TriangleRecord>(
///         "triangles", HitGroup{"render/triangle.rchit", "render/triangle_surface.rahit", ""},
///         HitGroup{"", "render/triangle_shadow.rahit", ""});
///     auto primary = program.add_ray_generation("render/primary.rgen");   // by the stage that traces it
///     SceneRayTracer tracer(device, textures, frames_in_flight, std::move(program));
///     offsets = tracer.set_table({{SceneProgram::geometry(triangles, record), …}, …});   // a range a bottom
///     level
///     // each frame:
///     top_level.build(cmd, slot, instances);   // instance.record_offset = offsets[range]
///     tracer.prepare(cmd, slot, top_level);
///     tracer.trace(cmd, primary, push, {width, height, 1});
template <template <std::uint32_t, class...> class Of>
using WithSceneRecords = Of<shared::RAY_TYPE_COUNT, shared::TriangleRecord, shared::CatcherRecord,
                            shared::SphereRecord, shared::BoxRecord, shared::OrientedBoxRecord,
                            shared::PlaneRecord, shared::CsgRecord, shared::UserRecord, shared::VoxelRecord,
                            shared::JuliaRecord, shared::MandelbulbRecord, shared::BlendRecord>;
using SceneProgram = WithSceneRecords<Program>;
using SceneRayTracer = WithSceneRecords<RayTracer>;

}  // namespace foveray::engine
