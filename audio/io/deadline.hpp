#pragma once

#include <chrono>
#include <future>
#include <optional>
#include <thread>
#include <type_traits>
#include <utility>

namespace raks::audio {

/// How long a sound server may take to answer before it counts as hung.
constexpr std::chrono::milliseconds kServerPatience(2000);
/// How long closing a stream may take before it is left behind.
constexpr std::chrono::milliseconds kCloseWithin(1000);
/// No device is later than this; what reports more has not set the value.
constexpr std::chrono::seconds kMostLatency(2);

/// The result of `work` when it is there within `limit`; nothing when it takes longer. `work` runs
/// on a thread of its own, which is left behind then: whatever `work` uses must live until its end,
/// so it takes copies. For calls of libraries that may wait for a server for ever.
/// Threads: any. Real-time: no.
template <typename Work>
auto within(std::chrono::milliseconds limit, Work work)
    -> std::optional<std::invoke_result_t<Work&>> {
    using Result = std::invoke_result_t<Work&>;
    std::promise<Result> promise;
    std::future<Result> result = promise.get_future();
    std::thread([work = std::move(work), promise = std::move(promise)]() mutable {
        promise.set_value(work());
    }).detach();
    if (result.wait_for(limit) != std::future_status::ready) {
        return std::nullopt;
    }
    return result.get();
}

}  // namespace raks::audio
