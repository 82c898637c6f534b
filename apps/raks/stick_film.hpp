// `raks stick`: what a recording's bodies are shown on - a window, a sheet, a film.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "apps/raks/commands.hpp"
#include "base/expected.hpp"
#include "engine/show/clip_content.hpp"
#include "render/scene/clip_body.hpp"

namespace raks::apps {

/// What is shown of a recording.
struct ShownClip {
    std::string name;  ///< of its file, or of both
    std::size_t frame_count = 1;
    double frames_per_second = 30.0;
    std::optional<engine::ClipHighlight> highlight{};
    std::vector<engine::MarkKey> keys{};  ///< of two motions, which is which
};

/// Whether `arguments.output` is something that can be written, before anything is read. Errors: an
/// unknown ending; of a film those of VideoWriter.
[[nodiscard]] Expected<void> check_stick_output(const StickArguments& arguments);

/// Plays the bodies in a window; with `arguments.output`, or where there is no display, draws them
/// on a sheet or films them. Errors: those of all of these.
[[nodiscard]] Expected<void> show_recorded(const StickArguments& arguments,
                                           const ShownClip& shown,
                                           const render::RecordedBodies& recorded);

}  // namespace raks::apps
