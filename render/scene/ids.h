#pragma once

#include <cstdint>

/// The CPU scene. Ids are indices into the vectors of `Scene`, given in the order of loading; every later
/// stage keeps that order, so that the same files make the same picture.
namespace foveray::scene {

using ImageId = std::uint32_t;
using TextureId = std::uint32_t;
using MaterialId = std::uint32_t;
using MeshId = std::uint32_t;
using NodeId = std::uint32_t;
using SkinId = std::uint32_t;
using LightId = std::uint32_t;
using AreaLightId = std::uint32_t;
using CameraId = std::uint32_t;
using DeformationId = std::uint32_t;
using InstanceId = std::uint32_t;
using ShapeId = std::uint32_t;
using ShapeInstanceId = std::uint32_t;
using UserShapeId = std::uint32_t;

}  // namespace foveray::scene
