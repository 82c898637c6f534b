#pragma once

#include <atomic>

#include "audio/io/device_stream.hpp"

namespace raks::audio::test {

/// A block that is on its way until it may end.
class LongBlock final : public StreamCallback {
 public:
    void on_input(std::span<const float>, int, const BlockTime&) noexcept override {
        has_begun_.store(true);
        has_begun_.notify_one();
        may_end_.wait(false);
        has_ended_.store(true);
    }

    void wait_for_begin() const { has_begun_.wait(false); }
    void let_end() {
        may_end_.store(true);
        may_end_.notify_all();
    }
    [[nodiscard]] bool has_ended() const { return has_ended_.load(); }

 private:
    std::atomic<bool> has_begun_{false};
    std::atomic<bool> may_end_{false};
    std::atomic<bool> has_ended_{false};
};

}  // namespace raks::audio::test
