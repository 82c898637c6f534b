#include "base/realtime.hpp"

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace raks {
namespace {

// The register that controls floating-point arithmetic. It belongs to the thread.
#if defined(__SSE__)
constexpr std::uint32_t kFlushing = 0x8000 | 0x0040;  // MXCSR: FTZ and DAZ
std::uint32_t control() noexcept { return _mm_getcsr(); }
void set_control(std::uint32_t value) noexcept { _mm_setcsr(value); }
#elif defined(__aarch64__)
constexpr std::uint32_t kFlushing = 1U << 24U;  // FPCR: FZ, of results and operands
std::uint32_t control() noexcept {
    std::uint64_t value = 0;
    asm volatile("mrs %0, fpcr" : "=r"(value));
    return static_cast<std::uint32_t>(value);
}
void set_control(std::uint32_t value) noexcept {
    asm volatile("msr fpcr, %0" : : "r"(std::uint64_t{value}));
}
#else
constexpr std::uint32_t kFlushing = 0;  // denormal numbers stay, and are slow
std::uint32_t control() noexcept { return 0; }
void set_control(std::uint32_t /*value*/) noexcept {}
#endif

}  // namespace

// Bits that are set already stay set.
FlushToZeroScope::FlushToZeroScope() noexcept RAKS_NONBLOCKING : saved_(control()) {
    set_control(saved_ | kFlushing);
}

FlushToZeroScope::~FlushToZeroScope() RAKS_NONBLOCKING { set_control(saved_); }

}  // namespace raks
