#pragma once

#include <atomic>

#include "audio/io/bell.hpp"
#include "audio/io/device_stream.hpp"

namespace raks::audio::test {

/// A block that is on its way until it may end.
class LongBlock final : public StreamCallback {
 public:
    // Turns round and round: a callback that waited would break the rules.
    void on_input(std::span<const float>,
                  int,
                  const BlockTime&) noexcept RAKS_NONBLOCKING override {
        has_begun_.store(true);
        begun_.ring();
        while (!may_end_.load()) {
        }
        has_ended_.store(true);
    }

    void wait_for_begin() {
        while (!has_begun_.load()) {
            begun_.wait();
        }
    }
    void let_end() { may_end_.store(true); }
    [[nodiscard]] bool has_ended() const { return has_ended_.load(); }

 private:
    Bell begun_;
    std::atomic<bool> has_begun_{false};
    std::atomic<bool> may_end_{false};
    std::atomic<bool> has_ended_{false};
};

}  // namespace raks::audio::test
