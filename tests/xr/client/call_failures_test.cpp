// Every OpenXR function that our client calls, failing with every error that says nothing of the call itself.
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "base/error.h"
#include "tests/fakes/environment.h"
#include "tests/xr/client/headset_fixture.h"

namespace foveray::xr {
namespace {

namespace fs = std::filesystem;

/// From the client's own source, so that none is forgotten.
std::vector<std::string> called_functions() {
    // The loader's own, which it calls itself; and one that no play calls.
    const std::set<std::string> left_out = {"xrEnumerateInstanceExtensionProperties", "xrGetInstanceProcAddr",
                                            "xrRequestExitSession"};
    const std::regex name("\\bxr[A-Z][A-Za-z0-9]*");
    std::set<std::string> found;
    for (const auto& entry : fs::directory_iterator(fs::path(FOVERAY_SOURCE_DIR) / "xr/client")) {
        std::ifstream in(entry.path());
        const std::string text(std::istreambuf_iterator<char>(in), {});
        for (std::sregex_iterator match(text.begin(), text.end(), name), end; match != end; ++match) {
            if (!left_out.contains(match->str())) found.insert(match->str());
        }
    }
    return {found.begin(), found.end()};
}

class CallFailuresTest : public HeadsetTest, public testing::WithParamInterface<std::string> {
  protected:
    struct Outcome {
        std::size_t frames = 0;
        std::string fault;  // empty: ended in order
        std::string said;
    };
    Outcome play_with(const std::string& faults) {
        // After a loss the headset goes on in the same file.
        const fs::path file = folder_.path() / ("faults" + std::to_string(plays_++) + ".csv");
        std::ofstream(file) << "at,fault,value\n" << faults;
        const fakes::Environment variable("FOVERAY_SIMULATOR_FAULTS", file);
        Outcome outcome;
        testing::internal::CaptureStderr();
        try {
            const Played played =
                play(options(), BlendMode::Opaque,
                     [&](Headset& headset, const gpu::Device& device, gpu::FrameRing& ring,
                         const Frame& frame, std::vector<gpu::Buffer>& kept) {
                         const vk::DeviceSize largest = 4 * 256 * 256;
                         if (kept.empty())
                             kept.emplace_back(device, "pictures", largest, gpu::Residence::Upload);
                         const std::vector<ViewPicture> pictures(frame.views.size(),
                                                                 {kept[0].vk(), 0, kept[0].vk(), 0});
                         const gpu::Commands cmd = ring.begin();
                         headset.record_submission(cmd, frame, pictures);
                         ring.submit();
                         outcome.frames = frame.index + 1;
                     });
            EXPECT_TRUE(played.ended) << faults;
            EXPECT_TRUE(played.messages.empty()) << played.messages.front();
        } catch (const Fault& fault) {
            EXPECT_EQ(fault.code(), ExitCode::Missing);
            outcome.fault = fault.what();
        }
        outcome.said = testing::internal::GetCapturedStderr();
        return outcome;
    }

  private:
    int plays_ = 0;
};

TEST_P(CallFailuresTest, EndsWithAWordOrGoesOn) {
    const std::string& function = GetParam();
    for (const std::string error : {"XR_ERROR_RUNTIME_FAILURE", "XR_ERROR_OUT_OF_MEMORY",
                                    "XR_ERROR_SESSION_LOST", "XR_ERROR_INSTANCE_LOST"}) {
        const std::string fail = ",fail," + function + "=" + error + "\n";
        const bool lost = error.ends_with("_LOST");
        SCOPED_TRACE(fail);
        const Outcome first = play_with("start" + fail);
        if (first.said.find("may not answer") != std::string::npos) continue;
        if (first.fault.empty()) {
            EXPECT_TRUE(lost) << "nobody noticed";
            EXPECT_GE(first.frames, 4u) << first.said;
        } else {
            EXPECT_NE(first.fault.find(function), std::string::npos) << first.fault;
            // Without an instance there was nothing to find again.
            EXPECT_TRUE(!lost || (error == "XR_ERROR_INSTANCE_LOST" && first.frames == 0)) << first.said;
        }
        if (error == "XR_ERROR_OUT_OF_MEMORY" || error == "XR_ERROR_SESSION_LOST") continue;
        // Once frames are shown, and while a lost headset is being found again.
        const Outcome later = play_with("1" + fail + "2,instance_loss,\n");
        if (later.fault.empty()) {
            EXPECT_GE(later.frames, 4u) << later.said;
        } else {
            EXPECT_NE(later.fault.find(function), std::string::npos) << later.fault;
            EXPECT_FALSE(lost) << later.said;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Calls, CallFailuresTest, testing::ValuesIn(called_functions()),
                         [](const auto& called) { return called.param; });

}  // namespace
}  // namespace foveray::xr
