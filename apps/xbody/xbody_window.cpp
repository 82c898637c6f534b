#include "apps/xbody/xbody_window.hpp"

#include <utility>

#include "apps/xbody/xbody_content.hpp"
#include "apps/xbody/xbody_texts.hpp"
#include "render/panes/pane_window.hpp"

namespace raks::apps {

Expected<void> xbody_in_window(ShownModel model,
                               const XbodyStart& start,
                               const std::function<bool()>& is_stop_requested) {
    auto window = render::PaneWindow::create({.title = xbody_title(model),
                                              .width = start.width,
                                              .height = start.height,
                                              .max_fps = 60.0,
                                              .otherwise = "draw a picture: -o X.png"});
    if (!window) {
        return fail(std::move(window.error()));
    }
    auto stage = XbodyStage::create(std::move(model));
    if (!stage) {
        return fail(std::move(stage.error()));
    }
    auto host = render::PaneHost::create();
    if (!host) {
        return fail(std::move(host.error()));
    }
    XbodyContent content(std::move(*stage), std::move(*host), start);
    window->run(content, is_stop_requested);
    return {};
}

}  // namespace raks::apps
