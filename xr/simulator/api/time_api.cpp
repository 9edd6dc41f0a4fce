#include "xr/simulator/api/functions.h"
#include "xr/simulator/instance.h"

namespace foveray::simulator {

// XrTime is CLOCK_MONOTONIC in nanoseconds. In virtual time, which no clock shows, the extension is not
// offered.

XRAPI_ATTR XrResult XRAPI_CALL xrConvertTimespecTimeToTimeKHR(XrInstance instance, const timespec* clock,
                                                              XrTime* time) {
    return guarded([&] {
        get<Instance>(instance);
        verify(clock != nullptr && time != nullptr);
        constexpr std::int64_t last_second = INT64_MAX / nanoseconds_per_second - 1;
        verify(clock->tv_nsec >= 0 && clock->tv_nsec < nanoseconds_per_second);
        verify(clock->tv_sec >= 0 && clock->tv_sec <= last_second, XR_ERROR_TIME_INVALID);
        const XrTime converted = clock->tv_sec * nanoseconds_per_second + clock->tv_nsec;
        verify(converted > 0, XR_ERROR_TIME_INVALID);
        *time = converted;
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrConvertTimeToTimespecTimeKHR(XrInstance instance, XrTime time,
                                                              timespec* clock) {
    return guarded([&] {
        get<Instance>(instance);
        verify(clock != nullptr);
        verify(time > 0, XR_ERROR_TIME_INVALID);
        clock->tv_sec = time / nanoseconds_per_second;
        clock->tv_nsec = time % nanoseconds_per_second;
    });
}

}  // namespace foveray::simulator
