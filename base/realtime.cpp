#include "base/realtime.hpp"

#include <xmmintrin.h>

namespace raks {
namespace {
constexpr std::uint32_t kFlushToZero = 0x8000;       // MXCSR.FTZ
constexpr std::uint32_t kDenormalsAreZero = 0x0040;  // MXCSR.DAZ
}  // namespace

// MXCSR controls SSE arithmetic and belongs to the thread. Bits that are set already stay set.
FlushToZeroScope::FlushToZeroScope() noexcept RAKS_NONBLOCKING : saved_(_mm_getcsr()) {
    _mm_setcsr(saved_ | kFlushToZero | kDenormalsAreZero);
}

FlushToZeroScope::~FlushToZeroScope() RAKS_NONBLOCKING { _mm_setcsr(saved_); }

}  // namespace raks
