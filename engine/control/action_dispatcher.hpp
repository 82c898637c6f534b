#pragma once

#include <array>
#include <functional>
#include <string>

#include "base/expected.hpp"
#include "engine/control/action_table.hpp"

namespace raks::engine {

/// Takes one line of text that a person is to read.
using SayLine = std::function<void(const std::string& line)>;

/// Maps each action to the function that carries it out. The parts of a show register once:
///
///     ActionDispatcher actions(say);
///     actions.on(Action::quit, [&](double) { wants_to_quit = true; });
///     actions.dispatch({Action::seek, -5.0});
///
/// Handlers run inside dispatch(). Threads: main; an input on another thread must first hand its
/// requests over to it. Real-time: no.
class ActionDispatcher {
 public:
    /// Gets the value as the table allows it; 0 for an action without one.
    using Handler = std::function<void(double value)>;

    /// Gets also when the request came.
    using DatedHandler = std::function<void(double value, HostTime came)>;

    /// Gets the text as the table allows it. Errors: what dispatch() gives back.
    using TextHandler = std::function<Expected<void>(const std::string& text)>;

    /// `say` gets a remark when a value was clamped.
    explicit ActionDispatcher(SayLine say) : say_(std::move(say)) {}

    /// Registers the handler of an action; it replaces the one that was registered before.
    void on(Action action, Handler handler);
    /// The same, for what has to know the moment.
    void on_dated(Action action, DatedHandler handler);
    /// The same of requests with a text; the other handler gets those without.
    void on_text(Action action, TextHandler handler);
    /// True when a handler is registered.
    [[nodiscard]] bool handles(Action action) const noexcept;

    /// Checks value or text and calls the handler. Errors: take_value or check_text refuses it; no
    /// handler is registered; those of the handler of a text. When the value was clamped, `say`
    /// gets the remark.
    [[nodiscard]] Expected<void> dispatch(const ActionRequest& request) const;
    /// The same, with the action named as in the table. Errors: also an unknown name; the nearest
    /// is suggested.
    [[nodiscard]] Expected<void> dispatch(std::string_view name,
                                          double value,
                                          const std::string& text = {}) const;

 private:
    SayLine say_;
    [[nodiscard]] Expected<void> dispatch_text(const ActionRow& row, const std::string& text) const;

    std::array<DatedHandler, kActionCount> handlers_;
    std::array<TextHandler, kActionCount> text_handlers_;
};

}  // namespace raks::engine
