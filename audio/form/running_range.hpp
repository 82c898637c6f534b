#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/realtime.hpp"

namespace raks::audio {

/// The last kMost values of something, and their order: what is low, usual and high of late.
/// Threads: one. Real-time: yes; adding moves at most kMost numbers.
template <std::size_t kMost>
class RunningRange {
 public:
    /// Takes a value, which must be finite; the oldest one is forgotten when there are too many.
    void add(float value) noexcept RAKS_NONBLOCKING {
        const std::size_t place = added_ % kMost;
        if (added_ >= kMost) {
            const auto end = sorted_.begin() + kMost;
            std::copy(std::lower_bound(sorted_.begin(), end, values_[place]) + 1,
                      end,
                      std::lower_bound(sorted_.begin(), end, values_[place]));
        }
        const auto end = sorted_.begin() + static_cast<std::ptrdiff_t>(std::min(added_, kMost - 1));
        const auto at = std::upper_bound(sorted_.begin(), end, value);
        std::copy_backward(at, end, end + 1);
        *at = value;
        values_[place] = value;
        ++added_;
    }
    /// The value under which this share of them lies, 0 to 1, on the line between neighbours. There
    /// must be one.
    [[nodiscard]] float at(double share) const noexcept RAKS_NONBLOCKING {
        const double place = share * static_cast<double>(size() - 1);
        const auto below = static_cast<std::size_t>(place);
        const float part = static_cast<float>(place - static_cast<double>(below));
        const float next = sorted_[std::min(below + 1, size() - 1)];
        return sorted_[below] + part * (next - sorted_[below]);
    }
    /// How many values there are.
    [[nodiscard]] std::size_t size() const noexcept { return std::min(added_, kMost); }
    /// Forgets all.
    void reset() noexcept { added_ = 0; }

 private:
    std::array<float, kMost> values_{};  // ring, in the order of their coming
    std::array<float, kMost> sorted_{};  // ascending
    std::size_t added_ = 0;
};

}  // namespace raks::audio
