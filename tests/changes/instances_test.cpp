#include <string_view>

#include "app/bench/tables.h"
#include "tests/changes/still_life.h"
#include "tests/fakes/gpu_fixture.h"

namespace foveray::app {
namespace {

using ManyInstances = fakes::GpuTest;

const BenchRow& row_named(const std::vector<BenchRow>& rows, std::string_view name) {
    return *std::ranges::find_if(rows, [&](const BenchRow& row) { return row.name.starts_with(name); });
}

TEST_F(ManyInstances, AThousandMoveAndLookAsIfTheyHadAlwaysBeenThere) {
    const std::vector<BenchRow> rows = changes_rows();
    for (const char* name : {"1,000 moving", "1,000 that come and go"}) {
        const BenchRow& row = row_named(rows, name);
        const scene::Scene scene = row.scene();
        const std::size_t count = scene.instances.size();
        EXPECT_GE(count, 1000u);
        scene::SceneAnimator animator(scene);
        animator.advance(0);
        const scene::SceneChanges& next = animator.advance(from_seconds(0.1));
        const auto changes = std::ranges::count_if(
            next.instances, [](const scene::InstanceState& s) { return s.moved || !s.present; });
        EXPECT_GE(changes, 400) << name;

        Offscreen offscreen(device(), scene, 2);
        Shot shot = row.shot(scene);
        shot.views[0].size = uvec2(64, 36);
        vk::DeviceSize memory = 0;
        for (int i = 0; i < 20; ++i) {
            shot.time = i * nanoseconds_per_second / 60;
            offscreen.draw(shot);
            if (i == 4) memory = gpu::used_memory(device());
        }
        EXPECT_EQ(gpu::used_memory(device()), memory) << name;
        // The same moment without a past.
        const Image there = offscreen.picture(0);
        offscreen.show(offscreen.prepare(std::make_shared<const scene::Scene>(scene)));
        offscreen.draw(shot);
        EXPECT_EQ(largest_difference(there, offscreen.picture(0)), 0) << name;
    }
}

}  // namespace
}  // namespace foveray::app
