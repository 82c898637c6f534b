#include "tests/support/realtime_guard.hpp"

#include <dlfcn.h>
#include <pthread.h>
#include <sys/resource.h>

#include <cerrno>
#include <cstddef>
#include <cstdlib>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define RAKS_UNDER_SANITIZER 1
#endif
#if defined(__SANITIZE_THREAD__)
#define RAKS_UNDER_THREAD_SANITIZER 1
#endif
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || \
    __has_feature(realtime_sanitizer)
#define RAKS_UNDER_SANITIZER 1
#endif
#if __has_feature(thread_sanitizer)
#define RAKS_UNDER_THREAD_SANITIZER 1
#endif
#endif

namespace {

// initial-exec: reading a thread-local must not itself call malloc.
__attribute__((tls_model("initial-exec"))) thread_local raks::test::RealtimeCounts t_counts;
__attribute__((tls_model("initial-exec"))) thread_local bool t_is_counting = false;

[[maybe_unused]] void count(std::uint64_t& counter) noexcept {
    if (t_is_counting) {
        ++counter;
    }
}

struct Usage {
    long waits = 0;
    long page_faults = 0;
};

Usage usage_of_thread() noexcept {
#ifdef RAKS_UNDER_THREAD_SANITIZER
    return {};  // its runtime has locks of its own, and waits for them
#else
    rusage usage{};
    getrusage(RUSAGE_THREAD, &usage);
#ifdef RAKS_UNDER_SANITIZER
    usage.ru_nvcsw = 0;  // the pages of its shadow come as they are touched, and that may wait
#endif
    return {usage.ru_nvcsw, usage.ru_minflt + usage.ru_majflt};
#endif
}

}  // namespace

#ifdef RAKS_UNDER_SANITIZER

extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*malloc_hook)(const volatile void*,
                                                                             std::size_t),
                                                         void (*free_hook)(const volatile void*))
    __attribute__((weak));

namespace {
void on_malloc(const volatile void*, std::size_t) { count(t_counts.allocations); }
void on_free(const volatile void*) { count(t_counts.frees); }
[[maybe_unused]] const int g_hooks_installed =
    __sanitizer_install_malloc_and_free_hooks != nullptr
        ? __sanitizer_install_malloc_and_free_hooks(on_malloc, on_free)
        : 0;
}  // namespace

#else

// glibc's own entry points, so that replacing malloc needs no dlsym at start-up.
// NOLINTBEGIN(bugprone-reserved-identifier): the names are the C library's.
extern "C" {
void* __libc_malloc(std::size_t);
void __libc_free(void*);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) {
    count(t_counts.allocations);
    return __libc_malloc(size);
}
void free(void* pointer) {
    if (pointer != nullptr) {
        count(t_counts.frees);
    }
    __libc_free(pointer);
}
void* calloc(std::size_t n, std::size_t size) {
    count(t_counts.allocations);
    return __libc_calloc(n, size);
}
void* realloc(void* pointer, std::size_t size) {
    count(t_counts.allocations);
    return __libc_realloc(pointer, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
    count(t_counts.allocations);
    return __libc_memalign(alignment, size);
}
int posix_memalign(void** result, std::size_t alignment, std::size_t size) {
    count(t_counts.allocations);
    *result = __libc_memalign(alignment, size);
    return *result == nullptr ? ENOMEM : 0;
}

int pthread_mutex_lock(pthread_mutex_t* mutex) {
    using Function = int (*)(pthread_mutex_t*);
    static const Function original =
        reinterpret_cast<Function>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
    count(t_counts.locks);
    return original(mutex);
}
void* __cxa_allocate_exception(std::size_t size) noexcept {
    using Function = void* (*)(std::size_t);
    static const Function original =
        reinterpret_cast<Function>(dlsym(RTLD_NEXT, "__cxa_allocate_exception"));
    count(t_counts.throws);
    return original(size);
}
}  // extern "C"

// NOLINTEND(bugprone-reserved-identifier)

#endif

namespace raks::test {

std::string RealtimeCounts::describe() const {
    return std::to_string(allocations) + " allocations, " + std::to_string(frees) + " frees, " +
           std::to_string(locks) + " locks, " + std::to_string(throws) + " throws, " +
           std::to_string(waits) + " waits, " + std::to_string(page_faults) + " page faults";
}

RealtimeScope::RealtimeScope() noexcept {
    t_counts = {};
    const Usage before = usage_of_thread();
    t_counts.waits = -before.waits;
    t_counts.page_faults = -before.page_faults;
    t_is_counting = true;
}

RealtimeScope::~RealtimeScope() { stop(); }

const RealtimeCounts& RealtimeScope::stop() noexcept {
    if (is_running_) {
        t_is_counting = false;
        is_running_ = false;
        counts_ = t_counts;
        const Usage after = usage_of_thread();
        counts_.waits += after.waits;
        counts_.page_faults += after.page_faults;
    }
    return counts_;
}

}  // namespace raks::test
