#include "engine/control/request_inbox.hpp"

#include <utility>

namespace raks::engine {

bool RequestInbox::leave(Waiting waiting) {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() >= kRoom) {
        ++refused_;
        return false;
    }
    waiting_.push_back(std::move(waiting));
    return true;
}

bool RequestInbox::post(ActionRequest request) { return leave({std::move(request), nullptr}); }

std::optional<Expected<void>> RequestInbox::ask(ActionRequest request, Nanos patience) {
    const auto answer = std::make_shared<std::promise<Expected<void>>>();
    auto end = answer->get_future();
    if (!leave({std::move(request), answer})) {
        return fail("too much is asked for at once: this is left out");
    }
    if (end.wait_for(patience) != std::future_status::ready) {
        return std::nullopt;
    }
    return end.get();
}

std::optional<std::string> RequestInbox::carry_out(const ActionDispatcher& actions) {
    std::deque<Waiting> taken;
    {
        const std::lock_guard lock(mutex_);
        taken.swap(waiting_);
    }
    std::optional<std::string> fault;
    for (const Waiting& one : taken) {
        Expected<void> done = actions.dispatch(one.request);
        if (one.answer) {
            one.answer->set_value(std::move(done));
        } else if (!done && !fault) {
            fault = done.error().message;
        }
    }
    // A flood of the same fault is one line.
    if (!fault || *fault == last_fault_) {
        return std::nullopt;
    }
    last_fault_ = *fault;
    return fault;
}

std::size_t RequestInbox::refused() const {
    const std::lock_guard lock(mutex_);
    return refused_;
}

}  // namespace raks::engine
