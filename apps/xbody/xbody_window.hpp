// Xbody window: a model looked at and labelled.
#pragma once

#include <cstddef>
#include <functional>

#include "apps/xbody/shown_model.hpp"
#include "base/expected.hpp"

namespace raks::apps {

/// How the window begins.
struct XbodyStart {
    int width = 1280;  ///< pixels
    int height = 720;
    std::string view = "front";
    std::size_t frame = 0;  ///< of the clip; stands there where it is above 0
    bool has_names = false;
};

/// Shows a model until the window is closed, or `is_stop_requested` says so; labels are written to
/// model.labels_file as often as the person says so. Errors: no display, no OpenGL. Threads: main.
[[nodiscard]] Expected<void> xbody_in_window(ShownModel model,
                                             const XbodyStart& start,
                                             const std::function<bool()>& is_stop_requested);

}  // namespace raks::apps
