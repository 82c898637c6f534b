#include "engine/setup/device_offsets.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "base/printable.hpp"
#include "base/toml_reader.hpp"
#include "engine/setup/user_folders.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

constexpr int kOffsetsVersion = 1;
// A file of this program is far smaller; another is refused before it fills the memory.
constexpr std::size_t kMostOffsetsBytes = std::size_t{1} << 20U;
constexpr std::size_t kMostDevices = 1000;
constexpr std::array<std::string_view, 2> kWays = {"loop", "tap"};
constexpr std::array<std::string_view, 3> kFileKeys = {"format", "version", "device"};
constexpr std::array<std::string_view, 3> kDeviceKeys = {"name", "offset_ms", "measured"};

DeviceOffsets::Entry read_device(const toml::node& node, TomlComplaints& complaints) {
    DeviceOffsets::Entry entry;
    const toml::table* const table = node.as_table();
    if (table == nullptr) {
        complaints.complain(node, "device must be a table, [[device]]");
        return entry;
    }
    complaints.check_keys(*table, kDeviceKeys);
    entry.device = complaints.text(*table, "name");
    if (entry.device.empty()) {
        complaints.complain(*table, "needs name = \"...\"");
    }
    constexpr double kMostMs = 1e3 * to_seconds(DeviceOffsets::kMost);
    if (const auto* offset = complaints.needed(*table, "offset_ms", "offset_ms = 0.0")) {
        entry.offset =
            nanos_from_seconds(1e-3 * complaints.number(*offset, "offset_ms", {-kMostMs, kMostMs}));
    }
    if (const auto* way = complaints.needed(*table, "measured", "measured = \"loop\"")) {
        entry.measured = kWays[complaints.word(*way, "measured", kWays)];
    }
    return entry;
}

}  // namespace

std::optional<Nanos> DeviceOffsets::of(std::string_view device, std::string_view monitor_of) const {
    for (const std::string& name : {printable(device), printable(monitor_of)}) {
        const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
            return entry.device == name;
        });
        if (found != entries_.end()) {
            return found->offset;
        }
    }
    return std::nullopt;
}

void DeviceOffsets::set(Entry entry) {
    // JACK's names may be any bytes; a document is text.
    entry.device = printable(entry.device);
    entry.offset = std::clamp<Nanos>(entry.offset, -kMost, kMost);
    const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& known) {
        return known.device == entry.device;
    });
    if (found != entries_.end()) {
        *found = std::move(entry);
    } else {
        entries_.push_back(std::move(entry));
    }
}

bool DeviceOffsets::forget(std::string_view device) {
    return std::erase_if(entries_,
                         [&](const Entry& entry) { return entry.device == printable(device); }) > 0;
}

Expected<DeviceOffsets> DeviceOffsets::parse(std::string_view text, const std::string& name) {
    const auto parsed = parse_toml(text, name);
    if (!parsed) {
        return fail(parsed.error());
    }
    const toml::table& file = *parsed;
    TomlComplaints complaints(name);
    DeviceOffsets offsets;
    if (file["format"].value_or(std::string()) != "raks-device-offsets") {
        return fail(name + ": format is not \"raks-device-offsets\"; this is another kind of file");
    }
    if (const auto version = file["version"].value_exact<std::int64_t>().value_or(0);
        version != kOffsetsVersion) {
        return fail(fmt::format("{}: version {} is not known to this Raks (it reads version {})",
                                name,
                                version,
                                kOffsetsVersion));
    }
    complaints.check_keys(file, kFileKeys);
    const toml::node* const devices = file.get("device");
    if (devices != nullptr && devices->as_array() == nullptr) {
        complaints.complain(*devices, "device must be a list of tables, [[device]]");
    } else if (devices != nullptr) {
        for (const toml::node& device : *devices->as_array()) {
            offsets.set(read_device(device, complaints));
        }
    }
    if (offsets.entries_.size() > kMostDevices) {
        complaints.complain(fmt::format("more than {} devices", kMostDevices));
    }
    if (!complaints.is_sound()) {
        return fail(complaints.fault());
    }
    return offsets;
}

Expected<DeviceOffsets> DeviceOffsets::load() {
    const fs::path file = path();
    if (file.empty() || !is_there(file)) {
        return DeviceOffsets();
    }
    const auto text = read_text_file(file, kMostOffsetsBytes);
    return text ? parse(*text, file.string()) : fail(text.error());
}

std::string DeviceOffsets::to_toml() const {
    std::string text = fmt::format(
        "# How much later each device is heard than it reports: written by raks calibrate.\n"
        "format = \"raks-device-offsets\"\nversion = {}\n",
        kOffsetsVersion);
    for (const Entry& entry : entries_) {
        text += fmt::format("\n[[device]]\nname = {}\noffset_ms = {:.3f}\nmeasured = \"{}\"\n",
                            toml_quoted(entry.device),
                            1e3 * to_seconds(entry.offset),
                            entry.measured);
    }
    return text;
}

Expected<void> DeviceOffsets::save() const {
    const fs::path file = path();
    if (file.empty()) {
        return fail("there is no folder to keep it in: set HOME or XDG_STATE_HOME");
    }
    auto made = make_folders(file.parent_path());
    return made ? write_file(file, to_toml()) : made;
}

fs::path DeviceOffsets::path() {
    const fs::path folder = xdg_folder("XDG_STATE_HOME", ".local/state");
    return folder.empty() ? folder : folder / "devices.toml";
}

std::string in_words(Nanos offset) {
    return fmt::format("{:.1f} ms {}",
                       1e3 * to_seconds(std::chrono::abs(offset)),
                       offset < Nanos(0) ? "earlier" : "later");
}

}  // namespace raks::engine
