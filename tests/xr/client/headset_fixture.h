#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/session.h"
#include "tests/fakes/temporary_folder.h"
#include "xr/client/headset.h"

namespace foveray::xr {

constexpr Nanoseconds period = 100'000'000;

/// Our client against the simulated headset, through the real loader: six frames of a moving head, on `ci`.
class HeadsetTest : public testing::Test {
  protected:
    void SetUp() override;
    void TearDown() override;

    SimulatorOptions options();

    struct Played {
        std::vector<Frame> frames;
        bool ended = false;
        std::vector<std::string> messages;
    };
    using Each = std::function<void(Headset&, const gpu::Device&, gpu::FrameRing&, const Frame&,
                                    std::vector<gpu::Buffer>&)>;
    /// Plays to the end. `each` may record a submission, whose buffers it leaves in its last argument.
    Played play(const SimulatorOptions& simulator, BlendMode blend, const Each& each);
    Played play(const SimulatorOptions& simulator) {
        return play(simulator, BlendMode::Opaque, [](auto&&...) {});
    }

    fakes::TemporaryFolder folder_;
    Session session_;
    Headset::Patience patience_{std::chrono::seconds(2), std::chrono::milliseconds(5)};
};

}  // namespace foveray::xr
