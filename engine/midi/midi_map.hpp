#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "engine/control/action_table.hpp"
#include "engine/midi/midi_parser.hpp"

namespace raks::engine {

/// What a control can ask for.
struct MidiWish {
    Action action{};     ///< what is asked for; not the end of the program
    double value = 0.0;  ///< of the request, where a press makes it
    /// Turning a knob takes so many steps more or less, for actions whose value is a step.
    bool is_turned = false;

    friend bool operator==(const MidiWish&, const MidiWish&) = default;
};

/// All that can be asked for by a control, in the order of the action table: a press for each key
/// of an action, and a turn where its value is a step. `is_there`: which actions. Pure.
[[nodiscard]] std::vector<MidiWish> midi_wishes(const std::function<bool(Action)>& is_there);
/// "beats earlier, later: by a knob", "beats earlier, later: -10 ms". Pure.
[[nodiscard]] std::string in_words(const MidiWish& wish);

/// A key, pad, pedal, button or knob of a device.
struct MidiControl {
    MidiMessage::Kind kind = MidiMessage::Kind::control;  ///< what its messages are
    std::uint8_t channel{1};                              ///< 1 to 16
    std::uint8_t number{};                                ///< 0 to 127

    /// The one that has sent a message.
    [[nodiscard]] static MidiControl of(const MidiMessage& message) noexcept {
        return {message.kind, message.channel, message.number};
    }
    /// "control 21", "note 36 on channel 10".
    [[nodiscard]] std::string text() const;
    friend bool operator==(const MidiControl&, const MidiControl&) = default;
};

/// Which control of which device asks for what, as a person has taught it. File format:
/// docs/reference/files.md. Threads: one. Real-time: no.
class MidiMap {
 public:
    static constexpr std::size_t kMost = 1'000;  ///< controls

    /// One control that asks for something.
    struct Entry {
        std::string device;   ///< midi_device_name()
        MidiControl control;  ///< of it
        MidiWish wish;        ///< what it asks for
    };

    /// The control asks for this from now on, and for nothing else. False: kMost are known.
    bool set(Entry entry);
    /// Nothing of this device asks for this any more.
    void forget(std::string_view device, const MidiWish& wish);
    /// The controls of a device that ask for this.
    [[nodiscard]] std::vector<MidiControl> controls_of(std::string_view device,
                                                       const MidiWish& wish) const;
    /// All, in the order of the file.
    [[nodiscard]] const std::vector<Entry>& entries() const noexcept { return entries_; }
    /// What a control asks for; null: nothing.
    [[nodiscard]] const MidiWish* find(std::string_view device,
                                       const MidiControl& control) const noexcept;

    /// Errors: no TOML; another format or version; unknown keys or actions; a value that its action
    /// does not take. `name` stands for the file in errors.
    [[nodiscard]] static Expected<MidiMap> parse(std::string_view toml, const std::string& name);
    /// The person's file; empty where there is none. Errors: as parse(), and those of reading.
    [[nodiscard]] static Expected<MidiMap> load();
    /// The document; parse() of it gives the same.
    [[nodiscard]] std::string to_toml() const;
    /// Writes the person's file, all of it or nothing; makes its folder. Errors: there is no place
    /// for it; the system's.
    [[nodiscard]] Expected<void> save() const;
    /// $XDG_STATE_HOME/raks/midi.toml, or below ~/.local/state. Empty: neither is known.
    [[nodiscard]] static std::filesystem::path path();

 private:
    std::vector<Entry> entries_;
};

/// Makes requests of the messages of one device. A knob's first message says where it stands and
/// asks for nothing, so that nothing jumps; its turns within one call are one request.
/// Threads: one. Real-time: no.
class MidiReader {
 public:
    /// Presses in one call, at most; what is more is passed over.
    static constexpr std::size_t kMostRequests = 64;

    /// What these messages ask for, in order, with the moments at which they came.
    [[nodiscard]] std::vector<ActionRequest> requests(const MidiMap& map,
                                                      std::string_view device,
                                                      std::span<const MidiMessage> messages);
    /// Where a control stands is known from this message on.
    void note(const MidiMessage& message);

 private:
    static constexpr std::size_t kControls = std::size_t{16} * 128;  // controllers of all channels
    static constexpr int kUnknown = -1;

    [[nodiscard]] static std::size_t place_of(const MidiMessage& message) noexcept;

    std::array<int, kControls> stands_at_ = [] {
        std::array<int, kControls> all{};
        all.fill(kUnknown);
        return all;
    }();
};

}  // namespace raks::engine
