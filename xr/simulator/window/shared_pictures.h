#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "base/view.h"

namespace foveray::simulator {

/// Memory that the simulated headset and its window share: the newest composed pictures, in one of three
/// places. Rows from the top, four bytes a pixel, sRGB, the right eye's picture after the left one's.
struct SharedPictures {
    struct Description {
        std::array<std::uint32_t, 2> width{}, height{};  // by eye
        std::array<Fov, 2> fov{};
        Pose stage_from_head;
    };
    struct Place {
        std::atomic<std::uint64_t> number{0};  // of the pictures, from 1; 0 while they are written
        Description description;
    };
    static constexpr std::size_t place_count = 3;

    std::atomic<std::uint64_t> newest{0};  // is in places[newest % 3]; 0: none yet
    std::uint64_t place_bytes = 0;
    std::array<Place, place_count> places;

    static std::size_t size(std::uint64_t place_bytes) {
        return sizeof(SharedPictures) + place_count * place_bytes;
    }
    std::uint8_t* pixels(std::uint64_t number) {
        return reinterpret_cast<std::uint8_t*>(this + 1) + number % place_count * place_bytes;
    }
    const std::uint8_t* pixels(std::uint64_t number) const {
        return const_cast<SharedPictures*>(this)->pixels(number);
    }
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);  // between processes

/// File descriptors that the window is started with.
constexpr int shared_pictures_descriptor = 3;
constexpr int connection_descriptor = 4;  // a socket that closes when the other side is gone

}  // namespace foveray::simulator
