#include "render/gpu/timers.h"

#include "tests/fakes/gpu_fixture.h"

namespace foveray::gpu {
namespace {

class TimersTest : public fakes::GpuTest {};

TEST(ElapsedTicks, OnlyValidBitsCountAndMayWrap) {
    EXPECT_EQ(elapsed_ticks(100, 130, 64), 30u);
    EXPECT_EQ(elapsed_ticks(~std::uint64_t{0} - 9, 20, 64), 30u);
    EXPECT_EQ(elapsed_ticks((std::uint64_t{1} << 36) - 10, 20, 36), 30u);
    // What stands above the valid bits is arbitrary.
    EXPECT_EQ(elapsed_ticks(0xABC0000000000064u, 0x1230000000000082u, 36), 30u);
}

TEST_F(TimersTest, StagesAreNamedNestedAndSummed) {
    FrameRing ring(device(), 2);
    Buffer buffer(device(), "something to fill", 8 << 20, Residence::Device);
    const auto fill = [&](const Commands& cmd, std::uint32_t value) {
        cmd->fillBuffer(buffer.vk(), 0, VK_WHOLE_SIZE, value);
        cmd.barrier(Access::TransferWrite, Access::TransferWrite);
    };
    {
        const Commands cmd = ring.begin();
        const auto outer = cmd.stage("outer");
        {
            const auto inner = cmd.stage("inner");
            fill(cmd, 1);
        }
        {
            const auto inner = cmd.stage("inner");
            fill(cmd, 2);
        }
    }
    ring.submit();
    ring.wait();
    const auto& times = ring.stage_times();
    ASSERT_EQ(times.size(), 2u);
    EXPECT_EQ(times[0].name, "outer");
    EXPECT_EQ(times[1].name, "inner");
    EXPECT_GT(times[1].milliseconds, 0.0);
    EXPECT_GE(times[0].milliseconds, times[1].milliseconds);
    EXPECT_LT(times[0].milliseconds, 60e3);
}

TEST_F(TimersTest, TheRingReusesItsSlots) {
    FrameRing ring(device(), 2);
    for (std::uint32_t frame = 0; frame < 5; ++frame) {
        const std::string name = "frame " + std::to_string(frame);
        {
            const Commands cmd = ring.begin();
            EXPECT_EQ(ring.slot(), frame % 2);
            if (frame >= 2) {
                ASSERT_EQ(ring.stage_times().size(), 1u);
                EXPECT_EQ(ring.stage_times()[0].name, "frame " + std::to_string(frame - 2));
            }
            const auto scope = cmd.stage(name.c_str());
        }
        ring.submit();
    }
    ring.wait();
    EXPECT_EQ(ring.stage_times()[0].name, "frame 4");
}

}  // namespace
}  // namespace foveray::gpu
