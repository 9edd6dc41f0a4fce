// Linked into every test when FOVERAY_SANITIZE is set: what the sanitizers must know of libraries that are
// not ours.

#include <dlfcn.h>

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/lsan_interface.h>
#endif

extern "C" {

/// Libraries stay loaded, because a report can only name functions of those that are.
int dlclose(void*) { return 0; }

const char* __ubsan_default_options() { return "halt_on_error=1:print_stacktrace=1"; }

#if defined(__SANITIZE_ADDRESS__)
const char* __lsan_default_options() { return "print_suppressions=0"; }

/// The validation layer leaks a little for every device.
const char* __lsan_default_suppressions() { return "leak:libVkLayer_khronos_validation.so\n"; }

/// Debian 12's OpenXR loader never frees the object that it makes for an instance. Its functions stand in
/// every stack of a runtime's, so naming the library as suppressed would hide the simulated headset's leaks
/// too.
int xrCreateInstance(const void* info, void* instance) {
    using Create = int (*)(const void*, void*);
    static const auto create = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "xrCreateInstance"));
    __lsan_disable();
    const int result = create(info, instance);
    __lsan_enable();
    return result;
}
#endif

#if defined(__SANITIZE_THREAD__)
/// Mesa, LLVM, the loaders and layers are not built for the thread sanitizer, which then misses how they wait
/// for each other.
const char* __tsan_default_options() { return "ignore_noninstrumented_modules=1"; }
#endif

}  // extern "C"
