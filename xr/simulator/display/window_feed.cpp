#include "xr/simulator/display/window_feed.h"

#include <cerrno>
#include <cstring>
#include <dlfcn.h>
#include <filesystem>
#include <new>
#include <spawn.h>
#include <string>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

#include "xr/simulator/api/verify.h"

namespace foveray::simulator {
namespace {

/// Beside this library.
std::filesystem::path window_program() {
    static const char here = 0;
    Dl_info info{};
    dladdr(&here, &info);
    return std::filesystem::path(info.dli_fname ? info.dli_fname : "").parent_path() /
           "foveray-simulator-window";
}

}  // namespace

OwnedDescriptor::~OwnedDescriptor() {
    if (descriptor_ >= 0) close(descriptor_);
}

WindowFeed::WindowFeed(Compositor& compositor, std::size_t pixels) : compositor_(compositor) {
    share_memory(pixels);
    if (shared_) start_window();
    thread_ = std::thread([this] { hand_over_pictures(); });
}

WindowFeed::~WindowFeed() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
        changed_.notify_all();
    }
    thread_.join();
    if (shared_) munmap(shared_, mapped_size_);
}

void WindowFeed::share_memory(std::size_t pixels) {
    const std::size_t size = SharedPictures::size(4 * pixels);
    OwnedDescriptor memory(memfd_create("foveray simulator pictures", MFD_CLOEXEC));
    if (*memory < 0 || ftruncate(*memory, static_cast<off_t>(size)) != 0)
        return report("no memory for the window");
    void* const mapped = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, *memory, 0);
    if (mapped == MAP_FAILED) return report("no memory for the window");
    shared_ = new (mapped) SharedPictures;
    shared_->place_bytes = 4 * pixels;
    mapped_size_ = size;
    memory_ = std::move(memory);
}

void WindowFeed::start_window() {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return;
    OwnedDescriptor ours(ends[0]), theirs(ends[1]);
    const std::string program = window_program().string(), client = std::to_string(getpid());
    const char* const words[] = {program.c_str(), client.c_str(), nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    // Through numbers that neither of the two has.
    posix_spawn_file_actions_adddup2(&actions, *memory_, 100);
    posix_spawn_file_actions_adddup2(&actions, *theirs, 101);
    posix_spawn_file_actions_adddup2(&actions, 100, shared_pictures_descriptor);
    posix_spawn_file_actions_adddup2(&actions, 101, connection_descriptor);
    posix_spawn_file_actions_addclosefrom_np(&actions, connection_descriptor + 1);
    pid_t child = 0;
    const int error =
        posix_spawn(&child, program.c_str(), &actions, nullptr, const_cast<char* const*>(words), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) return report(program + " cannot be started: " + std::strerror(error));
    // It goes on as a process that is nobody's child, so that the client never meets it.
    while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
    }
    connection_ = std::move(ours);
}

bool WindowFeed::is_open() const {
    char byte;
    return *connection_ >= 0 && recv(*connection_, &byte, 1, MSG_PEEK | MSG_DONTWAIT) < 0 && errno == EAGAIN;
}

void WindowFeed::show(const SubmittedFrame& frame, const std::array<EyeDisplay, 2>& eyes) {
    const std::lock_guard lock(mutex_);
    if (busy_) return;
    compositor_.start(frame, eyes);
    eyes_ = eyes;
    stage_from_head_ = frame.stage_from_head;
    busy_ = true;
    changed_.notify_all();
}

void WindowFeed::hand_over_pictures() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return busy_ || ending_; });
        if (!busy_) return;
        const auto eyes = eyes_;
        const Pose stage_from_head = stage_from_head_;
        lock.unlock();
        try {
            write(eyes, stage_from_head, compositor_.finish());
        } catch (const Refusal&) {  // the client's device is lost; it was reported
        }
        lock.lock();
        busy_ = false;
        changed_.notify_all();
    }
}

void WindowFeed::write(const std::array<EyeDisplay, 2>& eyes, const Pose& stage_from_head,
                       const EyePictures& pictures) {
    const std::uint64_t number = shared_->newest + 1;
    SharedPictures::Place& place = shared_->places[number % SharedPictures::place_count];
    place.number = 0;
    place.description.stage_from_head = stage_from_head;
    std::uint8_t* target = shared_->pixels(number);
    for (std::size_t eye = 0; eye < 2; ++eye) {
        place.description.width[eye] = pictures[eye].size.x;
        place.description.height[eye] = pictures[eye].size.y;
        place.description.fov[eye] = eyes[eye].fov;
        std::memcpy(target, pictures[eye].bytes.data(), pictures[eye].bytes.size());
        target += pictures[eye].bytes.size();
    }
    place.number = number;
    shared_->newest = number;
}

void WindowFeed::publish(const SubmittedFrame& frame, const std::array<EyeDisplay, 2>& eyes,
                         const EyePictures& pictures) {
    write(eyes, frame.stage_from_head, pictures);
}

void WindowFeed::settle() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !busy_; });
    compositor_.forget();
}

void WindowFeed::release(const Swapchain& swapchain) {
    std::unique_lock lock(mutex_);
    if (compositor_.shows(swapchain)) changed_.wait(lock, [&] { return !busy_; });
}

}  // namespace foveray::simulator
