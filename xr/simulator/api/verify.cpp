#include "xr/simulator/api/verify.h"

#include <cstdio>
#include <exception>
#include <new>
#include <string>

namespace foveray::simulator {

void report(std::string_view message) {
    std::fprintf(stderr, "foveray simulator: %.*s\n", static_cast<int>(message.size()), message.data());
}

XrResult result_of_current_exception() {
    try {
        throw;
    } catch (const Refusal& refusal) {
        return refusal.result;
    } catch (const std::bad_alloc&) {
        return XR_ERROR_OUT_OF_MEMORY;
    } catch (const std::exception& e) {
        report(e.what());
        return XR_ERROR_RUNTIME_FAILURE;
    } catch (...) {
        return XR_ERROR_RUNTIME_FAILURE;
    }
}

void enumerate_text(std::string_view text, std::uint32_t capacity, std::uint32_t* count_output,
                    char* target) {
    const auto size = static_cast<std::uint32_t>(text.size());
    enumerate(size + 1, capacity, count_output, target,
              [&](char& c, std::uint32_t i) { c = i < size ? text[i] : '\0'; });
}

}  // namespace foveray::simulator
