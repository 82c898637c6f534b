#include "engine/midi/midi_input.hpp"

#include <utility>

#include <fmt/format.h>

namespace raks::engine {

Expected<std::unique_ptr<MidiInput>> MidiInput::open(const std::string& name) {
    auto map = MidiMap::load();
    if (!map) {
        return fail("--midi-in: " + map.error().message);
    }
    auto port = open_midi_input_port(name);
    if (!port) {
        return fail(fmt::format("--midi-in {}: {}", name, port.error().message));
    }
    return std::make_unique<MidiInput>(std::move(*port), std::move(*map), name);
}

std::vector<ActionRequest> MidiInput::take() {
    std::string device = port_->device();
    if (device != device_) {
        lines_.push_back(device.empty() ? fmt::format("--midi-in: {} has gone", device_)
                                        : fmt::format("MIDI is heard from {}", device));
        device_ = std::move(device);
        reader_ = {};
    }
    if (auto trouble = port_->take_trouble()) {
        lines_.push_back(fmt::format("--midi-in {}: {}", name_, *trouble));
    }
    std::vector<MidiMessage> messages;
    for (MidiMessage message; port_->take(message);) {
        if (learning_ && is_taught(message)) {
            reader_.note(message);
        } else {
            messages.push_back(message);
        }
    }
    return reader_.requests(map_, device_, messages);
}

std::vector<std::string> MidiInput::take_lines() { return std::exchange(lines_, {}); }

// Letting go of a key teaches nothing.
bool MidiInput::is_taught(const MidiMessage& message) {
    const bool is_control = message.kind == MidiMessage::Kind::control;
    if (learning_->is_turned ? !is_control : message.value == 0) {
        return false;
    }
    const MidiControl control = MidiControl::of(message);
    if (!map_.set({device_, control, *learning_})) {
        lines_.push_back(fmt::format("no more than {} controls are kept", MidiMap::kMost));
    } else {
        lines_.push_back(fmt::format("{}: {}", control.text(), in_words(*learning_)));
        keep();
    }
    learning_.reset();
    return true;
}

void MidiInput::forget(const MidiWish& wish) {
    map_.forget(device_, wish);
    keep();
}

void MidiInput::keep() {
    if (const auto saved = map_.save(); !saved) {
        lines_.push_back("what was learnt is not kept: " + saved.error().message);
    }
}

std::string MidiInput::controls_of(const MidiWish& wish) const {
    std::string text;
    for (const MidiControl& control : map_.controls_of(device_, wish)) {
        text += (text.empty() ? "" : ", ") + control.text();
    }
    return text;
}

}  // namespace raks::engine
