#include "xr/client/headset.h"

#include <algorithm>
#include <cassert>
#include <thread>

#include "base/error.h"
#include "base/log.h"

namespace foveray::xr {
namespace {

constexpr std::chrono::milliseconds exit_patience{1000};

[[noreturn]] void throw_away(const Instance& instance) {
    throw_missing("OpenXR runtime " + instance.runtime_name(),
                  "its headset is away (XR_ERROR_FORM_FACTOR_UNAVAILABLE)",
                  "connect the headset and switch it on, or use --runtime simulator");
}

}  // namespace

Headset::Headset(RuntimeChoice choice, const SimulatorOptions& simulator, const Patience& patience)
    : patience_(patience) {
    if (choice == RuntimeChoice::System) {
        instance_ = std::make_unique<Instance>();
        wait_for_headset();
        return;
    }
    if (choice == RuntimeChoice::Auto) {
        try {
            if (system_runtime_manifest().empty()) throw_missing("OpenXR", "no active runtime", "");
            instance_ = std::make_unique<Instance>();
            if (!instance_->find_headset()) throw_away(*instance_);
            return;
        } catch (const Fault& fault) {
            log::info("{}; using the simulated headset '{}'", fault.what(), simulator.profile);
        }
    }
    instance_.reset();  // first: the loader has one at a time
    use_simulator(simulator);
    simulator_gpu_ = simulator.gpu;
    instance_ = std::make_unique<Instance>();
    is_simulator_ = true;
    wait_for_headset();
}

Headset::~Headset() { stop(); }

void Headset::wait_for_headset() {
    const auto give_up = Clock::now() + patience_.in_all;
    for (bool told = false; !instance_->find_headset(); told = true) {
        if (Clock::now() >= give_up) throw_away(*instance_);
        if (!told) log::info("{}: its headset is away; waiting for it", instance_->runtime_name());
        std::this_thread::sleep_for(patience_.between_attempts);
    }
}

gpu::DeviceSource Headset::device_source() const {
    gpu::DeviceSource source = instance_->device_source();
    if (!simulator_gpu_) return source;
    source.choose_physical_device = [choose = source.choose_physical_device,
                                     gpu = *simulator_gpu_](VkInstance vulkan) {
        try {
            return choose(vulkan);
        } catch (const Fault&) {
            throw_bad_input("--gpu " + std::to_string(gpu), "there is no such Vulkan device",
                            "`foveray doctor` lists them, counted from 0");
        }
    };
    return source;
}

template <typename Call>
void Headset::unless_lost(Call&& call) {
    if (loss_) return;
    try {
        call();
    } catch (const Lost& loss) {
        loss_ = loss;
    }
}

void Headset::start(const gpu::Device& device, BlendMode blend, float near_z, float far_z) {
    device_ = &device;
    presentation_ = {blend, near_z, far_z};
    system_name_ = instance_->system_name();
    view_configuration_ = instance_->view_configuration();
    unless_lost([&] { take_session(std::make_unique<RuntimeSession>(*instance_, device, presentation_)); });
}

void Headset::take_session(std::unique_ptr<RuntimeSession> session) {
    const std::lock_guard lock(session_mutex_);
    session_ = std::move(session);
}

void Headset::stop() { take_session(nullptr); }

Headset::State Headset::poll() {
    if (leave_by_ && Clock::now() >= *leave_by_) return State::Ended;
    unless_lost([&] {
        if (!session_) connect();
        if (session_) session_->poll();
    });
    if (loss_) return leave_by_ ? State::Ended : State::Lost;
    if (!session_) return State::Waiting;
    if (session_->has_ended()) return State::Ended;
    return session_->is_running() ? State::Running : State::Waiting;
}

void Headset::reconnect() {
    assert(loss_);
    if (!away_since_) away_since_ = Clock::now();
    if (Clock::now() - *away_since_ > patience_.in_all) throw Lost(*loss_);
    log::warn("the OpenXR runtime {} {}; connecting again", instance_->runtime_name(), loss_->event());
    take_session(nullptr);
    instance_is_lost_ = loss_->with_instance();
    loss_.reset();
}

/// One attempt now and then.
void Headset::connect() {
    if (Clock::now() < next_attempt_) return;
    next_attempt_ = Clock::now() + patience_.between_attempts;
    try {
        if (instance_is_lost_) {
            clock_start_.reset();
            instance_->reconnect();
            instance_is_lost_ = false;
        }
        if (!instance_->find_headset()) throw_away(*instance_);
        require_same_headset();
        take_session(std::make_unique<RuntimeSession>(*instance_, *device_, presentation_));
        log::info("connected to {} again", system_name_);
    } catch (const Fault& fault) {
        if (Clock::now() - *away_since_ > patience_.in_all) throw;
        const auto* lost = dynamic_cast<const Lost*>(&fault);
        instance_is_lost_ = instance_is_lost_ || (lost && lost->with_instance());
        if (fault.what() != last_refusal_) log::info("{}; trying again", fault.what());
        last_refusal_ = fault.what();
    }
}

void Headset::require_same_headset() const {
    const std::string runtime = "OpenXR runtime " + instance_->runtime_name();
    if (instance_->system_name() != system_name_ || instance_->view_configuration() != view_configuration_) {
        throw_missing(runtime, "it came back with another headset, " + instance_->system_name(),
                      "start foveray again");
    }
    const vk::PhysicalDevice wanted = instance_->device_source().choose_physical_device(*device_->instance());
    if (wanted != *device_->physical()) {
        throw_missing(runtime, "it came back wanting another GPU than " + device_->name(),
                      "start foveray again");
    }
}

void Headset::request_exit() {
    leave_by_ = Clock::now();
    unless_lost([&] {
        if (!session_ || !session_->is_running()) return;
        session_->request_exit();
        *leave_by_ += exit_patience;
    });
}

void Headset::wake() {
    const std::lock_guard lock(session_mutex_);
    if (session_) session_->wake();
}

std::optional<Frame> Headset::begin_frame() {
    std::optional<Frame> begun;
    unless_lost([&] { begun = session_->begin_frame(); });
    if (!begun) return begun;
    Frame& frame = *begun;
    frame.index = frame_index_++;
    if (!clock_start_) clock_start_ = frame.display_time - next_time_;
    frame.time = frame.display_time - *clock_start_;
    next_time_ = frame.time + frame.period;
    // Without a pose there is nothing to show the scene from: hold the last one, or skip the frame.
    if (frame.head_valid) {
        last_views_ = frame.views;
        last_head_ = frame.stage_from_head;
    } else if (last_views_.size() == frame.views.size()) {
        frame.views = last_views_;
    } else {
        frame.should_render = false;
    }
    frame.stage_from_head = last_head_;
    return begun;
}

void Headset::record_submission(const gpu::Commands& cmd, const Frame& frame,
                                const std::vector<ViewPicture>& pictures) {
    unless_lost([&] {
        const bool recorded = session_->record_submission(cmd, frame, pictures);
        if (!recorded && !image_is_late_)
            log::warn("{} has no image free: frames are left out", instance_->runtime_name());
        image_is_late_ = !recorded;
    });
}

void Headset::end_frame(const Frame& frame) {
    unless_lost([&] {
        session_->end_frame(frame);
        away_since_.reset();
        last_refusal_.clear();
    });
}

}  // namespace foveray::xr
