#pragma once

#include "base/expected.hpp"
#include "engine/show/clip_transport.hpp"
#include "engine/show/picture.hpp"
#include "render/gl/window.hpp"
#include "render/scene/clip_figure.hpp"

namespace raks::apps {

/// Plays a clip's figures in the window until it is closed, Q or Esc is pressed, or a signal comes.
/// The camera follows the body and obeys the mouse. Errors: no OpenGL 3.3.
[[nodiscard]] Expected<void> play_clip(render::Window& window,
                                       const engine::Look& look,
                                       const render::ClipFigures& figures,
                                       engine::ClipTransport& transport);

}  // namespace raks::apps
