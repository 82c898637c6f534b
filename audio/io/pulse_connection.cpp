#include "audio/io/pulse_connection.hpp"

namespace raks::audio {

PulseConnection::PulseConnection(const char* name)
    : loop_(pa_mainloop_new()), context_(pa_context_new(pa_mainloop_get_api(loop_.get()), name)) {}

// Before the loop is freed.
PulseConnection::~PulseConnection() { pa_context_disconnect(context_.get()); }

PulseConnection::Result PulseConnection::connect(Deadline deadline) {
    if (pa_context_connect(context_.get(), nullptr, PA_CONTEXT_NOAUTOSPAWN, nullptr) < 0) {
        return Result::absent;
    }
    while (pa_context_get_state(context_.get()) != PA_CONTEXT_READY) {
        if (!is_good()) {
            return Result::absent;
        }
        if (!step(deadline)) {
            return Result::no_reply;
        }
    }
    return Result::connected;
}

bool PulseConnection::finish(pa_operation* operation, Deadline deadline) {
    if (operation == nullptr) {
        return false;
    }
    while (pa_operation_get_state(operation) == PA_OPERATION_RUNNING) {
        if (!is_good() || !step(deadline)) {
            pa_operation_cancel(operation);
            break;
        }
    }
    const bool is_done = pa_operation_get_state(operation) == PA_OPERATION_DONE;
    pa_operation_unref(operation);
    return is_done;
}

bool PulseConnection::step(Deadline deadline) {
    constexpr int kStepMicroseconds = 50'000;
    return std::chrono::steady_clock::now() < deadline &&
           pa_mainloop_prepare(loop_.get(), kStepMicroseconds) >= 0 &&
           pa_mainloop_poll(loop_.get()) >= 0 && pa_mainloop_dispatch(loop_.get()) >= 0;
}

bool PulseConnection::wait() { return pa_mainloop_iterate(loop_.get(), 1, nullptr) >= 0; }

bool PulseConnection::is_good() const noexcept {
    return PA_CONTEXT_IS_GOOD(pa_context_get_state(context_.get())) != 0;
}

std::string PulseConnection::reason() const {
    return pa_strerror(pa_context_errno(context_.get()));
}

}  // namespace raks::audio
