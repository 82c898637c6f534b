#pragma once

#include <optional>
#include <string>
#include <utility>

#include "audio/io/devices.hpp"
#include "base/expected.hpp"
#include "engine/setup/settings.hpp"
#include "engine/setup/window_memory.hpp"
#include "engine/show/window_loop.hpp"
#include "render/gl/window.hpp"

namespace raks::apps {

/// What the window of play and live was last time, and what is chosen in it now. Without a window
/// nothing is read and nothing is written; what cannot be written is forgotten.
///
///     auto kept = is_headless ? KeptWindow() : KeptWindow::recall(settings);
///     kept.place(window_options);           // then the window opens
///     kept.choose_output("Speakers");       // a person chooses in it
///     kept.close(window_loop);              // before it closes
///
/// Threads: main.
class KeptWindow {
 public:
    /// There is no window.
    KeptWindow() = default;
    /// Reads what was kept and puts it under the settings (apply_window_memory). What cannot be
    /// read, and avatars that are gone, are said in one line each.
    [[nodiscard]] static KeptWindow recall(engine::Settings& settings);

    /// Opens the window where it was; its size is that of before where nobody has set one.
    void place(render::WindowOptions& options) const;
    /// An input was chosen in the window, by its name: the next one begins with it.
    void choose_device(std::string name) { now_.device = std::move(name); }
    /// The same of a loudspeaker.
    void choose_output(std::string name) { now_.output = std::move(name); }
    /// Keeps place, size and the choices, before the window closes. What an option has set for this
    /// run alone is not kept; neither is anything over a file that cannot be read or that has keys
    /// that are unknown.
    void close(const engine::WindowLoop& window);

 private:
    bool is_open_ = false;
    bool may_write_ = false;
    engine::WindowMemory before_;                  // as it was read
    engine::WindowMemory now_;                     // as it will be written
    std::optional<engine::PictureSize> set_size_;  // by the person; none: nobody has set it
};

/// The input that the settings name. One that is remembered and is not there is left out: then it
/// is the one that is chosen without a name. Errors: those of audio::choose_input.
[[nodiscard]] Expected<audio::DeviceChoice> input_of(const audio::AudioSystem& system,
                                                     engine::Settings& settings);
/// The same of the loudspeaker. Errors: those of audio::choose_output.
[[nodiscard]] Expected<audio::DeviceChoice> output_of(const audio::AudioSystem& system,
                                                      engine::Settings& settings);

}  // namespace raks::apps
