// foveray-simulator-window: shows what a simulated headset shows, and moves its wearer's head. The headset's
// library starts it (xr/simulator/display/window_feed.h).
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

#include "base/error.h"
#include "xr/simulator/window/head_control.h"
#include "xr/simulator/window/picture_window.h"
#include "xr/simulator/window/shared_pictures.h"

namespace foveray::simulator {
namespace {

const SharedPictures* map_pictures() {
    struct stat about {};
    if (fstat(shared_pictures_descriptor, &about) != 0) return nullptr;
    void* const mapped = mmap(nullptr, static_cast<std::size_t>(about.st_size), PROT_READ, MAP_SHARED,
                              shared_pictures_descriptor, 0);
    return mapped == MAP_FAILED ? nullptr : static_cast<const SharedPictures*>(mapped);
}

bool is_client_there() {
    char byte;
    return recv(connection_descriptor, &byte, 1, MSG_DONTWAIT) != 0;
}

/// The newest pictures, copied so that the headset can go on.
struct Pictures {
    std::uint64_t number = 0;
    SharedPictures::Description description;
    std::vector<std::uint8_t> bytes;

    /// True when there are new ones.
    bool take(const SharedPictures& shared) {
        const std::uint64_t newest = shared.newest;
        const SharedPictures::Place& place = shared.places[newest % SharedPictures::place_count];
        if (newest == number || place.number != newest) return false;
        const SharedPictures::Description copy = place.description;
        const std::size_t size = 4 * (pixels(copy, 0) + pixels(copy, 1));
        if (size > shared.place_bytes) return false;  // torn
        bytes.assign(shared.pixels(newest), shared.pixels(newest) + size);
        std::atomic_thread_fence(std::memory_order_acquire);
        if (place.number != newest) return false;  // overwritten meanwhile
        number = newest;
        description = copy;
        return true;
    }
    static std::size_t pixels(const SharedPictures::Description& d, std::size_t eye) {
        return std::size_t{d.width[eye]} * d.height[eye];
    }
};

void show(PictureWindow& window, const Pictures& pictures) {
    const std::uint8_t* bytes = pictures.bytes.data();
    for (std::size_t eye = 0; eye < 2; ++eye) {
        const auto& d = pictures.description;
        window.set_picture(static_cast<int>(eye), {d.width[eye], d.height[eye]}, bytes);
        bytes += 4 * Pictures::pixels(d, eye);
    }
}

void run(const std::string& client) {
    const SharedPictures* const shared = map_pictures();
    if (!shared)
        throw_missing("the simulated headset's window", "was not started by a headset",
                      "set FOVERAY_SIMULATOR_WINDOW=1");
    PictureWindow window("foveray simulated headset of process " + client);
    Pictures pictures;
    HeadControl control(static_cast<pid_t>(std::strtol(client.c_str(), nullptr, 10)));
    auto last = std::chrono::steady_clock::now();
    while (!window.is_closing() && is_client_there()) {
        if (pictures.take(*shared)) show(window, pictures);
        window.update();
        const auto now = std::chrono::steady_clock::now();
        const float seconds = std::chrono::duration<float>(now - last).count();
        last = now;
        if (pictures.number > 0) control.apply(window.input(), pictures.description, seconds);
    }
}

}  // namespace
}  // namespace foveray::simulator

int main(int count, char** arguments) {
    // The headset waits for the first process; the second is nobody's child.
    if (const pid_t child = fork(); child != 0) _exit(child < 0);
    try {
        foveray::simulator::run(count > 1 ? arguments[1] : "?");
    } catch (const foveray::Fault& fault) {
        std::fprintf(stderr, "foveray-simulator-window: %s\n", fault.what());
        return static_cast<int>(fault.code());
    }
    return EXIT_SUCCESS;
}
