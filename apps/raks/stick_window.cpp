#include "apps/raks/stick_window.hpp"

#include <utility>

#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"

namespace raks::apps {

Expected<render::Window> open_stick_window(const std::string& name,
                                           const engine::Look& look,
                                           const engine::Settings& settings) {
    return render::Window::create({.title = "Raks: " + name,
                                   .width = look.size.width,
                                   .height = look.size.height,
                                   .max_fps = settings.fps});
}

Expected<void> show_in_window(render::Window window,
                              const engine::Look& look,
                              engine::WindowContent& content) {
    // No cards: there is no music to inform about.
    auto loop =
        engine::WindowLoop::create(std::move(window),
                                   look,
                                   {.cards = engine::Cards::none,
                                    .say = say,
                                    .say_detail = say_detail,
                                    .is_stop_requested = [] { return stop_signal().has_value(); }});
    if (!loop) {
        return fail(loop.error());
    }
    // The quality that the renderer chose by itself.
    if (const std::string notice(loop->notice()); !notice.empty()) {
        loop->say(notice);
    }
    engine::ActionDispatcher actions([&](const std::string& line) { loop->say(line); });
    static_cast<void>(loop->run(content, actions));
    return {};
}

}  // namespace raks::apps
