#pragma once

#include <array>
#include <functional>
#include <string>

#include "base/expected.hpp"
#include "engine/control/action_table.hpp"

namespace raks::engine {

/// Takes a line for people.
using SayLine = std::function<void(const std::string& line)>;

/// Brings each request to the one that does it. The parts of a show say once what they do:
///
///     ActionDispatcher actions(say);
///     actions.on(Action::quit, [&](double) { wants_to_quit = true; });
///     actions.dispatch({Action::seek, -5.0});
///
/// Handlers run inside dispatch(). Threads: main; an input on another thread hands its requests
/// over first. Real-time: no.
class ActionDispatcher {
 public:
    /// Gets the value as the table allows it; 0 for an action without one.
    using Handler = std::function<void(double value)>;

    explicit ActionDispatcher(SayLine say) : say_(std::move(say)) {}

    /// `handler` does this action from here on, instead of the one before.
    void on(Action action, Handler handler);
    [[nodiscard]] bool handles(Action action) const noexcept;

    /// Errors: the value is refused (take_value), nobody does this action here. A clamped value is
    /// said.
    [[nodiscard]] Expected<void> dispatch(const ActionRequest& request) const;
    /// The same by the machine's name. Errors: an unknown name too; the nearest is suggested.
    [[nodiscard]] Expected<void> dispatch(std::string_view name, double value) const;

 private:
    SayLine say_;
    std::array<Handler, kActionCount> handlers_;
};

}  // namespace raks::engine
