#include "render/gpu/barriers.h"

#include <map>

#include <gtest/gtest.h>

namespace foveray::gpu {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Flag = vk::AccessFlagBits2;

// Chapters 7.1 and 38 of the Vulkan specification, "Supported access types" and "Acceleration structure
// builds": builds read their geometry, indices and instances with SHADER_READ, write the structure and the
// scratch memory with ACCELERATION_STRUCTURE_WRITE and read scratch memory and other structures with
// ACCELERATION_STRUCTURE_READ. A trace reads structures with ACCELERATION_STRUCTURE_READ and its shader table
// with SHADER_READ, at its own stage.
TEST(Barriers, EveryAccessHasItsStagesAndAccess) {
    const std::map<Access, AccessScope> expected = {
        {Access::None, {Stage::eNone, Flag::eNone}},
        {Access::HostWrite, {Stage::eHost, Flag::eHostWrite}},
        {Access::HostRead, {Stage::eHost, Flag::eHostRead}},
        {Access::TransferRead, {Stage::eTransfer, Flag::eTransferRead}},
        {Access::TransferWrite, {Stage::eTransfer, Flag::eTransferWrite}},
        {Access::ComputeRead, {Stage::eComputeShader, Flag::eShaderRead}},
        {Access::ComputeWrite, {Stage::eComputeShader, Flag::eShaderRead | Flag::eShaderWrite}},
        {Access::RayTracingRead,
         {Stage::eRayTracingShaderKHR, Flag::eShaderRead | Flag::eAccelerationStructureReadKHR}},
        {Access::RayTracingWrite, {Stage::eRayTracingShaderKHR, Flag::eShaderRead | Flag::eShaderWrite}},
        {Access::AccelerationBuildInput, {Stage::eAccelerationStructureBuildKHR, Flag::eShaderRead}},
        {Access::AccelerationBuildWrite,
         {Stage::eAccelerationStructureBuildKHR,
          Flag::eAccelerationStructureReadKHR | Flag::eAccelerationStructureWriteKHR}},
        {Access::AccelerationBuildRead,
         {Stage::eAccelerationStructureBuildKHR, Flag::eAccelerationStructureReadKHR}},
        {Access::IndirectRead, {Stage::eDrawIndirect, Flag::eIndirectCommandRead}},
        {Access::FragmentSampledRead, {Stage::eFragmentShader, Flag::eShaderRead}},
        {Access::ColorAttachment,
         {Stage::eColorAttachmentOutput, Flag::eColorAttachmentRead | Flag::eColorAttachmentWrite}},
    };
    EXPECT_EQ(expected.size(), static_cast<std::size_t>(Access::ColorAttachment) + 1);
    for (const auto& [access, scope] : expected) {
        EXPECT_EQ(scope_of(access).stages, scope.stages) << static_cast<int>(access);
        EXPECT_EQ(scope_of(access).access, scope.access) << static_cast<int>(access);
    }
}

}  // namespace
}  // namespace foveray::gpu
