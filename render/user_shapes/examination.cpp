#include "render/user_shapes/examination.h"

#include <spdlog/fmt/fmt.h>

#include "render/shape_types.h"
#include "render/user_shapes/compile.h"
#include "shaders/shared/examination.h"

namespace foveray::user_shapes {
namespace {

std::string place(vec3 p) { return fmt::format("({:.3g}, {:.3g}, {:.3g})", p.x, p.y, p.z); }

}  // namespace

Examination::Examination(const gpu::Device& device, const gpu::TextureTable& textures,
                         const scene::UserShape& shape)
    : device_(device),
      pipeline_(device, "examination", compile_examination(shape), textures, sizeof(shared::ExaminationPush)),
      record_(device, "examined record", sizeof(shared::UserRecord), gpu::Residence::Upload),
      findings_(device, "findings", sizeof(shared::Finding) * shared::FINDING_COUNT,
                gpu::Residence::Readback) {}

void Examination::warm_up(const scene::Shape& shape) { dispatch(shape, shape.values, 0.0f, 0); }

void Examination::dispatch(const scene::Shape& shape, std::span<const float> values, float seconds,
                           std::uint32_t count) {
    record_.write(gpu::bytes_of(render::user_record(shape, values, {}, seconds)));
    const shared::ExaminationPush push{record_.address(), findings_.address(), count, 0};
    gpu::submit_and_wait(device_, [&](const gpu::Commands& cmd) {
        cmd->fillBuffer(findings_.vk(), 0, VK_WHOLE_SIZE, 0);
        cmd.barrier(gpu::Access::TransferWrite, gpu::Access::ComputeWrite);
        pipeline_.dispatch(cmd, push, {std::max(count, 1u), 1, 1}, {64, 1, 1});
        cmd.barrier(gpu::Access::ComputeWrite, gpu::Access::HostRead);
    });
    findings_.invalidate();
}

std::optional<std::string> Examination::run(const scene::Shape& shape, std::span<const float> values,
                                            float seconds) {
    constexpr std::uint32_t side = shared::EXAMINED_SIDE;
    dispatch(shape, values, seconds, side * side * side);
    const auto findings = findings_.mapped_as<shared::Finding>();
    const auto at = [&](std::uint32_t which) { return place(findings[which].at); };
    if (findings[shared::FINDING_NOT_A_NUMBER].count > 0) {
        return "returns NaN or infinity, as at " + at(shared::FINDING_NOT_A_NUMBER);
    }
    if (findings[shared::FINDING_OUTSIDE].count > 0) {
        return "reaches out of its bounds, as at " + at(shared::FINDING_OUTSIDE);
    }
    if (findings[shared::FINDING_WRONG_T].count > 0) {
        return "returns a t that is not within t_min and t_max, as at " + at(shared::FINDING_WRONG_T);
    }
    if (findings[shared::FINDING_NO_NORMAL].count > 0) {
        return "returns a normal without length, as at " + at(shared::FINDING_NO_NORMAL);
    }
    return std::nullopt;
}

}  // namespace foveray::user_shapes
