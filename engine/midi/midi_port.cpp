#include "engine/midi/midi_port.hpp"

#include <algorithm>
#include <cctype>

#include "base/printable.hpp"
#include "engine/midi/alsa_midi.hpp"
#include "engine/midi/jack_midi.hpp"

namespace raks::engine {
namespace {

constexpr std::size_t kLongestDevice = 100;  // bytes

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Of "[24]" or "20:0" at the beginning of a text; 0: neither stands there.
std::size_t length_of_number(std::string_view text) {
    const bool is_bracketed = text.starts_with('[');
    const char middle = is_bracketed ? ']' : ':';
    std::size_t end = is_bracketed ? 1 : 0;
    const std::size_t first = end;
    while (end < text.size() && is_digit(text[end])) {
        ++end;
    }
    if (end == first || end == text.size() || text[end] != middle) {
        return 0;
    }
    ++end;
    if (is_bracketed) {
        return end;
    }
    const std::size_t second = end;
    while (end < text.size() && is_digit(text[end])) {
        ++end;
    }
    return end > second ? end : 0;
}

std::string lower(std::string_view text) {
    std::string low(text);
    std::transform(low.begin(), low.end(), low.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
    });
    return low;
}

}  // namespace

bool is_midi_port_meant(std::string_view port, std::string_view name) {
    return lower(port).find(lower(name)) != std::string::npos;
}

std::string midi_device_name(std::string_view port) {
    std::string name;
    for (std::size_t at = 0; at < port.size();) {
        const bool is_word_begun = at == 0 || port[at - 1] == ' ';
        if (const std::size_t number = is_word_begun ? length_of_number(port.substr(at)) : 0;
            number > 0) {
            at += number;
            continue;
        }
        if (port[at] != ' ' || (!name.empty() && name.back() != ' ')) {
            name += port[at];
        }
        ++at;
    }
    while (name.ends_with(' ')) {
        name.pop_back();
    }
    return printable(name, kLongestDevice);
}

// JACK's events have a place within the period; ALSA is for who has no JACK.
Expected<std::unique_ptr<MidiClockPort>> open_midi_clock_port(const std::string& name,
                                                              int clocks_per_beat) {
    auto port = open_jack_midi_clock(name, clocks_per_beat);
    if (!port || *port) {
        return port;
    }
    return open_alsa_midi_clock(name, clocks_per_beat);
}

Expected<std::unique_ptr<MidiInputPort>> open_midi_input_port(const std::string& name) {
    auto port = open_jack_midi_input(name);
    if (!port || *port) {
        return port;
    }
    return open_alsa_midi_input(name);
}

}  // namespace raks::engine
