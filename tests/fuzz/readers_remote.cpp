// What other programs, pages and controllers may send: packets of OSC, messages of a WebSocket,
// bytes of MIDI, and what is kept of it.
#include <chrono>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/control/remote_request.hpp"
#include "engine/midi/midi_map.hpp"
#include "engine/midi/midi_parser.hpp"
#include "engine/remote/osc_requests.hpp"
#include "engine/remote/remote_message.hpp"
#include "tests/fuzz/promise.hpp"
#include "tests/fuzz/readers.hpp"

namespace raks::fuzz {
namespace {

const HostTime kMoment = HostTime(std::chrono::hours(1));

// Whatever is asked for, the table allows it, and it names no path where it names a file.
void check_request(const engine::ActionRequest& request) {
    const engine::ActionRow& row = engine::row_of(request.action);
    must(engine::is_remote(row));
    must(engine::take_value(row, request.value).has_value());
    must(request.text.empty() || engine::check_text(row, request.text).has_value());
    const bool is_a_name =
        row.text == engine::TextKind::avatar || row.text == engine::TextKind::theme;
    must(!is_a_name || request.text.find('/') == std::string::npos);
    must(request.came && *request.came <= kMoment &&
         *request.came >= kMoment - std::chrono::seconds(2));
}

}  // namespace

bool read_midi_map(std::string_view text) {
    const auto map = engine::MidiMap::parse(text, "x.toml");
    if (!map) {
        must_be_one_line(map.error().message);
        return false;
    }
    const auto again = engine::MidiMap::parse(map->to_toml(), "y.toml");
    must(again && again->to_toml() == map->to_toml());
    return true;
}

// Every controller, and the first keys, ask for something.
bool read_midi_bytes(std::string_view bytes) {
    static const engine::MidiMap map = [] {
        engine::MidiMap all;
        const auto wishes = engine::midi_wishes([](engine::Action) { return true; });
        for (std::size_t i = 0; i < 2 * wishes.size(); ++i) {
            const engine::MidiWish& wish = wishes[i % wishes.size()];
            const bool is_control = wish.is_turned || i < wishes.size();
            must(all.set(
                {"box",
                 {is_control ? engine::MidiMessage::Kind::control : engine::MidiMessage::Kind::note,
                  1,
                  static_cast<std::uint8_t>(i % 128)},
                 wish}));
        }
        return all;
    }();
    engine::MidiParser parser;
    std::vector<engine::MidiMessage> messages;
    for (const char byte : bytes) {
        if (const auto message = parser.take(static_cast<std::uint8_t>(byte))) {
            must(message->channel >= 1 && message->channel <= 16);
            must(message->number < 128 && message->value < 128);
            messages.push_back(*message);
        }
    }
    engine::MidiReader reader;
    const auto requests = reader.requests(map, "box", messages);
    must(requests.size() <= engine::MidiReader::kMostRequests);
    for (const engine::ActionRequest& request : requests) {
        const engine::ActionRow& row = engine::row_of(request.action);
        must(engine::is_remote(row) && request.text.empty());
        const auto taken = engine::take_value(row, request.value);
        must(taken && taken->remark.empty());
    }
    return !messages.empty();
}

bool read_osc_packet(std::string_view bytes) {
    const engine::OscRequests read = engine::read_osc_requests(bytes, kMoment);
    for (const engine::ActionRequest& request : read.requests) {
        check_request(request);
    }
    must((read.faults > 0) != read.fault.empty());
    return !read.requests.empty();
}

bool read_remote_text(std::string_view text) {
    const auto message = engine::read_remote_message(text, kMoment);
    if (!message) {
        must(!message.error().message.empty());
        must(!engine::remote_answer("", message.error().message).empty());
        return false;
    }
    if (const auto* const request = std::get_if<engine::ActionRequest>(&*message)) {
        check_request(*request);
    } else {
        must(
            !engine::remote_clock_answer(std::get<engine::RemoteClock>(*message), kMoment).empty());
    }
    return true;
}

}  // namespace raks::fuzz
