#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "base/time.hpp"

namespace raks::engine {

/// How much later each device is heard than it reports, by the device's name, as `raks calibrate`
/// has measured it. File format: docs/reference/files.md. Threads: one. Real-time: no.
class DeviceOffsets {
 public:
    /// No correction is larger, to either side.
    static constexpr Nanos kMost = std::chrono::seconds(2);

    /// One device.
    struct Entry {
        std::string device;    ///< its name
        Nanos offset{};        ///< positive: heard later than reported; [-kMost, kMost]
        std::string measured;  ///< how: "loop" or "tap"
    };

    /// The offset of this device; of a monitor without one that of its loudspeaker, `monitor_of`
    /// (empty: it is no monitor). Nothing where none was measured.
    [[nodiscard]] std::optional<Nanos> of(std::string_view device,
                                          std::string_view monitor_of = {}) const;
    /// Puts a device's in the place of what is known of it.
    void set(Entry entry);
    /// Forgets a device; false where nothing was known of it.
    bool forget(std::string_view device);
    /// Every device, in the order of the file.
    [[nodiscard]] const std::vector<Entry>& entries() const noexcept { return entries_; }

    /// Errors: no TOML; another format or version; unknown keys, as those of a newer version would
    /// be lost on writing; a value out of its range. `name` stands for the file in errors.
    [[nodiscard]] static Expected<DeviceOffsets> parse(std::string_view toml,
                                                       const std::string& name);
    /// The person's file; empty where there is none. Errors: as parse(), and those of reading.
    [[nodiscard]] static Expected<DeviceOffsets> load();
    /// The document; parse() of it gives the same.
    [[nodiscard]] std::string to_toml() const;
    /// Writes the person's file, all of it or nothing; makes its folder. Errors: there is no place
    /// for it; the system's.
    [[nodiscard]] Expected<void> save() const;

    /// Where the person's file lies: $XDG_STATE_HOME/raks/devices.toml, or below ~/.local/state.
    /// Empty: neither variable names an absolute path.
    [[nodiscard]] static std::filesystem::path path();

 private:
    std::vector<Entry> entries_;
};

/// An offset as people say it: "143.2 ms later", "0.5 ms earlier".
[[nodiscard]] std::string in_words(Nanos offset);

}  // namespace raks::engine
