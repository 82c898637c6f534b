#include "engine/control/action_dispatcher.hpp"

#include <utility>

#include <fmt/format.h>

namespace raks::engine {
namespace {

std::string not_here(const ActionRow& row) {
    return fmt::format("action {}: there is nothing here that does it", row.name);
}

}  // namespace

void ActionDispatcher::on(Action action, Handler handler) {
    on_dated(action, [handler = std::move(handler)](double value, HostTime) { handler(value); });
}

void ActionDispatcher::on_dated(Action action, DatedHandler handler) {
    handlers_[static_cast<std::size_t>(action)] = std::move(handler);
}

void ActionDispatcher::on_text(Action action, TextHandler handler) {
    text_handlers_[static_cast<std::size_t>(action)] = std::move(handler);
}

bool ActionDispatcher::handles(Action action) const noexcept {
    return static_cast<bool>(handlers_[static_cast<std::size_t>(action)]);
}

Expected<void> ActionDispatcher::dispatch(const ActionRequest& request) const {
    const ActionRow& row = row_of(request.action);
    if (!request.text.empty()) {
        return dispatch_text(row, request.text);
    }
    // Checked before the handler is looked up: a bad value is a fault even where nothing handles
    // the action.
    const auto taken = take_value(row, request.value);
    if (!taken) {
        return fail(taken.error());
    }
    if (!handles(request.action)) {
        return fail(not_here(row));
    }
    // The remark comes before the handler, whose own lines may refer to the clamped value.
    if (!taken->remark.empty()) {
        say_(taken->remark);
    }
    handlers_[static_cast<std::size_t>(request.action)](taken->value,
                                                        request.came.value_or(HostClock::now()));
    return {};
}

Expected<void> ActionDispatcher::dispatch_text(const ActionRow& row,
                                               const std::string& text) const {
    if (auto checked = check_text(row, text); !checked) {
        return checked;
    }
    const TextHandler& handler = text_handlers_[static_cast<std::size_t>(row.action)];
    if (!handler) {
        return fail(not_here(row));
    }
    return handler(text);
}

Expected<void> ActionDispatcher::dispatch(std::string_view name,
                                          double value,
                                          const std::string& text) const {
    // A remote control names actions as text; from here on it is the same request as a key's.
    const auto row = find_action(name);
    if (!row) {
        return fail(row.error());
    }
    return dispatch({(*row)->action, value, text});
}

}  // namespace raks::engine
