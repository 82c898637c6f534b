#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "engine/control/action_table.hpp"
#include "engine/midi/midi_map.hpp"
#include "engine/midi/midi_port.hpp"

namespace raks::engine {

/// What a knob box, a keyboard or a pedal asks for, by what a person has taught it.
/// Threads: main.
class MidiInput {
 public:
    /// Listens to the first port whose name holds `name`. Errors: those of the port; the person's
    /// file cannot be read.
    [[nodiscard]] static Expected<std::unique_ptr<MidiInput>> open(const std::string& name);
    /// `port`: not null.
    MidiInput(std::unique_ptr<MidiInputPort> port, MidiMap map, std::string name)
        : port_(std::move(port)), map_(std::move(map)), name_(std::move(name)) {}

    /// What it has asked for since the last call. While something is learnt, the first control that
    /// can ask for it is taken, and kept.
    [[nodiscard]] std::vector<ActionRequest> take();
    /// Lines for the person since the last call.
    [[nodiscard]] std::vector<std::string> take_lines();

    /// The next control that is moved asks for this from then on; nothing: none is waited for.
    void learn(const std::optional<MidiWish>& wish) { learning_ = wish; }
    /// What is waited for.
    [[nodiscard]] const std::optional<MidiWish>& learning() const noexcept { return learning_; }
    /// No control asks for this any more.
    void forget(const MidiWish& wish);
    /// The controls that ask for this: "control 21"; empty: none does.
    [[nodiscard]] std::string controls_of(const MidiWish& wish) const;
    /// What is listened to; empty: nothing of that name is there.
    [[nodiscard]] const std::string& device() const noexcept { return device_; }
    /// As it was asked for.
    [[nodiscard]] const std::string& name() const noexcept { return name_; }

 private:
    [[nodiscard]] bool is_taught(const MidiMessage& message);
    void keep();

    std::unique_ptr<MidiInputPort> port_;
    MidiMap map_;
    std::string name_;
    std::string device_;
    MidiReader reader_;
    std::optional<MidiWish> learning_;
    std::vector<std::string> lines_;
};

}  // namespace raks::engine
