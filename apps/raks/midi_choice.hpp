#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "engine/control/action_dispatcher.hpp"
#include "engine/midi/midi_input.hpp"
#include "engine/show/list_panel.hpp"

namespace raks::apps {

inline constexpr std::string_view kMidiList = "midi";  ///< the list's name

/// The list of all that a MIDI controller can be taught: a row that is taken waits for a knob or a
/// button, and its box forgets it again. `is_there`: which actions; `input` must outlive the list.
/// Threads: main.
[[nodiscard]] std::unique_ptr<engine::ListOffer> offer_midi(
    engine::MidiInput& input, const std::function<bool(engine::Action)>& is_there);

}  // namespace raks::apps
