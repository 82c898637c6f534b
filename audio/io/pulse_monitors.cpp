#include "audio/io/pulse_monitors.hpp"

#include <poll.h>
#include <pulse/pulseaudio.h>

#include <algorithm>
#include <chrono>
#include <memory>

namespace raks::audio {
namespace {

constexpr std::chrono::milliseconds kPatience(1000);  // for the whole exchange with the server

// One connection to the server. Its main loop is run step by step, so that it ends at the deadline
// even when the server does not answer.
class Conversation {
 public:
    Conversation()
        : loop_(pa_mainloop_new()),
          context_(pa_context_new(pa_mainloop_get_api(loop_.get()), "raks")),
          deadline_(std::chrono::steady_clock::now() + kPatience) {}

    ~Conversation() {
        pa_context_disconnect(context_.get());  // before the loop is freed
    }
    Conversation(const Conversation&) = delete;
    Conversation& operator=(const Conversation&) = delete;

    [[nodiscard]] pa_context* context() const noexcept { return context_.get(); }

    // NOAUTOSPAWN: asking for monitors must not start a server.
    [[nodiscard]] bool connect() {
        if (pa_context_connect(context_.get(), nullptr, PA_CONTEXT_NOAUTOSPAWN, nullptr) < 0) {
            return false;
        }
        while (pa_context_get_state(context_.get()) != PA_CONTEXT_READY) {
            if (PA_CONTEXT_IS_GOOD(pa_context_get_state(context_.get())) == 0 || !step()) {
                return false;
            }
        }
        return true;
    }

    // Runs the loop until `operation` is done or the deadline has passed.
    void finish(pa_operation* operation) {
        while (operation != nullptr && pa_operation_get_state(operation) == PA_OPERATION_RUNNING) {
            if (!step()) {
                pa_operation_cancel(operation);
                break;
            }
        }
        if (operation != nullptr) {
            pa_operation_unref(operation);
        }
    }

 private:
    // One turn of the loop of at most 50 ms; false at the deadline or on an error.
    [[nodiscard]] bool step() {
        constexpr int kStepMicroseconds = 50'000;
        return std::chrono::steady_clock::now() < deadline_ &&
               pa_mainloop_prepare(loop_.get(), kStepMicroseconds) >= 0 &&
               pa_mainloop_poll(loop_.get()) >= 0 && pa_mainloop_dispatch(loop_.get()) >= 0;
    }

    struct Free {
        void operator()(pa_mainloop* loop) const noexcept { pa_mainloop_free(loop); }
        void operator()(pa_context* context) const noexcept { pa_context_unref(context); }
    };
    std::unique_ptr<pa_mainloop, Free> loop_;
    std::unique_ptr<pa_context, Free> context_;
    std::chrono::steady_clock::time_point deadline_;
};

// Callback of the server's information: name of the default sink.
void take_server(pa_context*, const pa_server_info* info, void* default_sink) {
    if (info != nullptr && info->default_sink_name != nullptr) {
        *static_cast<std::string*>(default_sink) = info->default_sink_name;
    }
}

// A monitor and the sink it belongs to.
struct Found {
    PulseMonitor monitor;
    std::string sink;
};

// Callback of each source; sources that are no monitors (microphones) are left out.
void take_source(pa_context*, const pa_source_info* info, int, void* found) {
    if (info != nullptr && info->monitor_of_sink != PA_INVALID_INDEX && info->name != nullptr) {
        static_cast<std::vector<Found>*>(found)->push_back(
            {{info->name, info->description != nullptr ? info->description : info->name, false},
             info->monitor_of_sink_name != nullptr ? info->monitor_of_sink_name : ""});
    }
}

}  // namespace

std::vector<PulseMonitor> list_pulse_monitors() {
    Conversation server;
    if (!server.connect()) {
        return {};
    }
    std::string default_sink;
    std::vector<Found> found;
    server.finish(pa_context_get_server_info(server.context(), take_server, &default_sink));
    server.finish(pa_context_get_source_info_list(server.context(), take_source, &found));
    std::vector<PulseMonitor> monitors;
    // Lists are compared after both answers: which sink is the default is known only then.
    for (Found& each : found) {
        each.monitor.is_of_default_sink = each.sink == default_sink;
        monitors.push_back(std::move(each.monitor));
    }
    // Stable: the others keep the server's order.
    std::stable_partition(monitors.begin(), monitors.end(), [](const PulseMonitor& monitor) {
        return monitor.is_of_default_sink;
    });
    return monitors;
}

}  // namespace raks::audio
