#include <csignal>
#include <iostream>
#include <set>
#include <string_view>
#include <sys/prctl.h>
#include <unistd.h>

#include "base/error.h"
#include "base/log.h"
#include "render/user_shapes/examination.h"
#include "render/user_shapes/probe.h"
#include "render/user_shapes/probe_frame.h"
#include "render/user_shapes/probe_request.h"

namespace foveray::user_shapes {
namespace {

/// The line to the parent: drivers may print where standard output was.
class Parent {
  public:
    Parent() : output_(::dup(STDOUT_FILENO)) { ::dup2(STDERR_FILENO, STDOUT_FILENO); }
    void say(const std::string& line) const {
        const std::string text = line + '\n';
        for (std::size_t done = 0; done < text.size();) {
            const ssize_t size = ::write(output_, text.data() + done, text.size() - done);
            if (size <= 0) return;
            done += static_cast<std::size_t>(size);
        }
    }

  private:
    int output_;
};

/// Why the shape is refused.
std::optional<ProbeFrame::Finding> examine(const Json& json, const Parent& parent) {
    const ProbeRequest request = from_json(json);
    gpu::DeviceOptions options;
    options.validation = json["validation"];
    if (!json["gpu"].is_null()) options.index = json["gpu"].get<std::uint32_t>();
    const gpu::Device device(options);
    gpu::TextureTable textures(device);
    const scene::Shape& first = request.moments.front().shape;
    Examination examination(device, textures, request.user);
    examination.warm_up(first);
    parent.say(probe_runs);
    for (const ProbeMoment& moment : request.moments) {
        if (auto reason = examination.run(moment.shape, moment.shape.values, moment.seconds))
            return ProbeFrame::Finding{*reason};
    }
    parent.say(probe_prepares);
    ProbeFrame frame(device, textures, request.user, first);
    frame.warm_up();
    parent.say(probe_runs);
    const std::size_t last = request.moments.size() - 1;
    for (const std::size_t i : std::set{std::size_t{0}, last / 3, 2 * last / 3, last}) {
        if (auto finding = frame.run(request.moments[i])) return finding;
    }
    if (!device.validation_messages().empty()) {
        return ProbeFrame::Finding{"makes the validation layer complain"};
    }
    return std::nullopt;
}

}  // namespace

std::optional<int> serve_probe(int argc, const char* const* argv) {
    if (argc != 2 || std::string_view(argv[1]) != probe_command) return std::nullopt;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // a shape that hangs must not outlive whom it was probed for
    log::init("warn");
    const Parent parent;
    Json answer = Json::object();
    try {
        if (const auto finding = examine(Json::parse(std::cin), parent)) {
            answer["refused"] = finding->reason;
            answer["of_color"] = finding->of_color;
        }
    } catch (const Fault& fault) {
        const std::string sentence = std::string(fault.what()).substr(fault.where().size() + 2);
        answer["fault"] = fault.code();
        answer["where"] = fault.where();
        answer["what"] = sentence;
    } catch (const std::exception& e) {
        answer["refused"] = std::string("makes the GPU fail: ") + e.what();
    }
    parent.say(answer.dump());
    ::_exit(0);  // a driver that the shape has upset may not come down in order
}

}  // namespace foveray::user_shapes
