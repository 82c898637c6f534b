#include "engine/midi/midi_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "base/printable.hpp"
#include "base/toml_reader.hpp"
#include "engine/control/remote_request.hpp"
#include "engine/setup/user_folders.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMidiFormat = "raks-midi";
constexpr int kMidiVersion = 1;
constexpr std::size_t kMostMidiBytes = std::size_t{1} << 20U;
constexpr std::array<std::string_view, 3> kMidiFileKeys = {"format", "version", "control"};
constexpr std::array<std::string_view, 7> kControlKeys = {
    "device", "message", "channel", "number", "action", "by", "value"};
constexpr std::array<std::string_view, 3> kMessageWords = {"note", "control", "program"};
constexpr std::array<std::string_view, 2> kWays = {"press", "turn"};
// A knob has 127 places: five of them are one press of a key.
constexpr double kPlacesAStep = 5.0;
constexpr int kPressed = 64;  // of 127, for a button that sends a controller

bool has_steps(const ActionRow& row) { return row.value && row.value->kind == ValueKind::step; }

// What one place of a knob adds.
double step_of(const ActionRow& row) {
    double step = 0.0;
    for (const ActionKey& key : row.keys()) {
        if (key.value > 0.0 && (step == 0.0 || key.value < step)) {
            step = key.value;
        }
    }
    return step / kPlacesAStep;
}

// A press for each value that a key gives.
void add_presses(const ActionRow& row, std::vector<MidiWish>& wishes) {
    const std::size_t first = wishes.size();
    for (const ActionKey& key : row.keys()) {
        const MidiWish wish{row.action, key.value, false};
        if (std::find(wishes.begin() + static_cast<std::ptrdiff_t>(first), wishes.end(), wish) ==
            wishes.end()) {
            wishes.push_back(wish);
        }
    }
}

MidiWish read_wish(const toml::table& table, TomlComplaints& complaints) {
    MidiWish wish;
    const auto row = find_action(complaints.text(table, "action"));
    if (!row || !is_remote(**row)) {
        complaints.complain(table, row ? "no control asks for this action" : row.error().message);
        return wish;
    }
    wish.action = (*row)->action;
    if (const auto* by = complaints.needed(table, "by", "by = \"press\"")) {
        wish.is_turned = complaints.word(*by, "by", kWays) == 1;
    }
    complaints.read(table, "value", {-1e9, 1e9}, wish.value);
    wish.value += 0.0;  // -0 would be written as it is read: as a whole number, which has none
    if (wish.is_turned && !has_steps(**row)) {
        complaints.complain(table, fmt::format("{} takes no turns", (*row)->name));
    } else if (!wish.is_turned) {
        const auto taken = take_value(**row, wish.value);
        if (!taken || !taken->remark.empty()) {
            complaints.complain(table, taken ? taken->remark : taken.error().message);
        }
    }
    return wish;
}

MidiMap::Entry read_control(const toml::node& node, TomlComplaints& complaints) {
    MidiMap::Entry entry;
    const toml::table* const table = node.as_table();
    if (table == nullptr) {
        complaints.complain(node, "control must be a table, [[control]]");
        return entry;
    }
    complaints.check_keys(*table, kControlKeys);
    entry.device = complaints.text(*table, "device");
    if (entry.device.empty()) {
        complaints.complain(*table, "needs device = \"...\"");
    }
    if (const auto* message = complaints.needed(*table, "message", "message = \"note\"")) {
        const auto kind = complaints.word(*message, "message", kMessageWords);
        entry.control.kind = static_cast<MidiMessage::Kind>(kind);
    }
    if (const auto* channel = complaints.needed(*table, "channel", "channel = 1")) {
        entry.control.channel =
            static_cast<std::uint8_t>(complaints.whole(*channel, "channel", {1, 16}));
    }
    if (const auto* number = complaints.needed(*table, "number", "number = 0")) {
        entry.control.number =
            static_cast<std::uint8_t>(complaints.whole(*number, "number", {0, 127}));
    }
    entry.wish = read_wish(*table, complaints);
    if (entry.wish.is_turned && entry.control.kind != MidiMessage::Kind::control) {
        complaints.complain(*table, "only a control is turned");
    }
    return entry;
}

}  // namespace

std::vector<MidiWish> midi_wishes(const std::function<bool(Action)>& is_there) {
    std::vector<MidiWish> wishes;
    for (const ActionRow& row : action_table()) {
        const bool is_learnt = is_remote(row) && row.action != Action::learn_midi;
        if (!is_learnt || !is_there(row.action)) {
            continue;
        }
        if (!row.value) {
            wishes.push_back({row.action});
            continue;
        }
        add_presses(row, wishes);
        if (has_steps(row)) {
            wishes.push_back({row.action, 0.0, true});
        }
    }
    return wishes;
}

std::string in_words(const MidiWish& wish) {
    const ActionRow& row = row_of(wish.action);
    if (wish.is_turned) {
        return fmt::format("{}: by a knob", row.help);
    }
    if (!row.value) {
        return std::string(row.help);
    }
    const std::string_view symbol = symbol_of(row.value->unit);
    return has_steps(row)
               ? fmt::format(
                     "{}: {:+g}{}{}", row.help, wish.value, symbol.empty() ? "" : " ", symbol)
               : fmt::format("{}: {:g}", row.help, wish.value);
}

std::string MidiControl::text() const {
    const std::string name =
        fmt::format("{} {}", kMessageWords[static_cast<std::size_t>(kind)], number);
    return channel == 1 ? name : fmt::format("{} on channel {}", name, channel);
}

bool MidiMap::set(Entry entry) {
    entry.device = printable(entry.device);
    const auto known = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& other) {
        return other.device == entry.device && other.control == entry.control;
    });
    if (known != entries_.end()) {
        known->wish = entry.wish;
        return true;
    }
    if (entries_.size() >= kMost) {
        return false;
    }
    entries_.push_back(std::move(entry));
    return true;
}

void MidiMap::forget(std::string_view device, const MidiWish& wish) {
    std::erase_if(entries_,
                  [&](const Entry& entry) { return entry.device == device && entry.wish == wish; });
}

std::vector<MidiControl> MidiMap::controls_of(std::string_view device, const MidiWish& wish) const {
    std::vector<MidiControl> controls;
    for (const Entry& entry : entries_) {
        if (entry.device == device && entry.wish == wish) {
            controls.push_back(entry.control);
        }
    }
    return controls;
}

const MidiWish* MidiMap::find(std::string_view device, const MidiControl& control) const noexcept {
    const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
        return entry.control == control && entry.device == device;
    });
    return found != entries_.end() ? &found->wish : nullptr;
}

Expected<MidiMap> MidiMap::parse(std::string_view text, const std::string& name) {
    const auto file = parse_toml(text, name);
    if (!file) {
        return fail(file.error());
    }
    TomlComplaints complaints(name);
    MidiMap map;
    complaints.check_head(*file, kMidiFormat, kMidiVersion);
    complaints.check_keys(*file, kMidiFileKeys);
    const toml::node* const controls = file->get("control");
    if (controls != nullptr && controls->as_array() == nullptr) {
        complaints.complain(*controls, "control must be a list of tables, [[control]]");
    } else if (controls != nullptr) {
        for (const toml::node& control : *controls->as_array()) {
            if (!map.set(read_control(control, complaints))) {
                complaints.complain(control, fmt::format("more than {} controls", kMost));
            }
            if (!complaints.is_sound()) {
                break;
            }
        }
    }
    if (!complaints.is_sound()) {
        return fail(complaints.fault());
    }
    return map;
}

Expected<MidiMap> MidiMap::load() {
    const fs::path file = path();
    if (file.empty() || !is_there(file)) {
        return MidiMap();
    }
    const auto text = read_text_file(file, kMostMidiBytes);
    return text ? parse(*text, file.string()) : fail(text.error());
}

std::string MidiMap::to_toml() const {
    std::string text = fmt::format(
        "# Which keys and knobs ask for what: written by Raks (key I in its window).\n"
        "format = \"{}\"\nversion = {}\n",
        kMidiFormat,
        kMidiVersion);
    for (const Entry& entry : entries_) {
        text += fmt::format(
            "\n[[control]]\ndevice = {}\nmessage = \"{}\"\nchannel = {}\nnumber = {}\n"
            "action = \"{}\"\nby = \"{}\"\n",
            toml_quoted(entry.device),
            kMessageWords[static_cast<std::size_t>(entry.control.kind)],
            entry.control.channel,
            entry.control.number,
            row_of(entry.wish.action).name,
            kWays[entry.wish.is_turned ? 1 : 0]);
        if (row_of(entry.wish.action).value && !entry.wish.is_turned) {
            text += fmt::format("value = {}\n", entry.wish.value);
        }
    }
    return text;
}

Expected<void> MidiMap::save() const {
    const fs::path file = path();
    if (file.empty()) {
        return fail("there is no folder to keep it in: set HOME or XDG_STATE_HOME");
    }
    auto made = make_folders(file.parent_path());
    return made ? write_file(file, to_toml()) : made;
}

fs::path MidiMap::path() {
    const fs::path folder = xdg_folder("XDG_STATE_HOME", ".local/state");
    return folder.empty() ? folder : folder / "midi.toml";
}

std::size_t MidiReader::place_of(const MidiMessage& message) noexcept {
    return static_cast<std::size_t>(message.channel - 1) * 128 + message.number;
}

void MidiReader::note(const MidiMessage& message) {
    if (message.kind == MidiMessage::Kind::control) {
        stands_at_[place_of(message)] = message.value;
    }
}

std::vector<ActionRequest> MidiReader::requests(const MidiMap& map,
                                                std::string_view device,
                                                std::span<const MidiMessage> messages) {
    std::vector<ActionRequest> requests;
    std::vector<std::size_t> turns;  // of `requests`, those of knobs
    for (const MidiMessage& message : messages) {
        const bool is_control = message.kind == MidiMessage::Kind::control;
        const int before = is_control ? stands_at_[place_of(message)] : kUnknown;
        note(message);
        const MidiWish* const wish = map.find(device, MidiControl::of(message));
        if (wish == nullptr) {
            continue;
        }
        if (!wish->is_turned) {
            const bool is_pressed =
                is_control ? message.value >= kPressed && before < kPressed : message.value > 0;
            if (is_pressed && requests.size() < kMostRequests) {
                requests.push_back({wish->action, wish->value, {}, message.came});
            }
            continue;
        }
        if (before == kUnknown || before == message.value) {
            continue;
        }
        const double by = (message.value - before) * step_of(row_of(wish->action));
        const auto same = std::find_if(turns.begin(), turns.end(), [&](std::size_t turn) {
            return requests[turn].action == wish->action;
        });
        if (same != turns.end()) {
            requests[*same].value += by;
            requests[*same].came = message.came;
        } else if (requests.size() < kMostRequests) {
            turns.push_back(requests.size());
            requests.push_back({wish->action, by, {}, message.came});
        }
    }
    for (const std::size_t turn : turns) {
        const ActionValue& range = *row_of(requests[turn].action).value;
        requests[turn].value = std::clamp(requests[turn].value, range.lowest, range.highest);
    }
    return requests;
}

}  // namespace raks::engine
