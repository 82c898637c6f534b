#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/expected.hpp"
#include "base/time.hpp"
#include "engine/outputs/beat_schedule.hpp"

/// Where an output goes, as a person writes it: `HOST:PORT,lead=30,factor=0.5`.
namespace raks::engine {

/// When a target gets the beats, and how many.
struct OutputTiming {
    Nanos lead{};  ///< so long before a moment is heard it is told; less than 0: behind it
    BeatSchedule::Pace pace = BeatSchedule::Pace::same;  ///< beats for each of the music's
};

/// A host and a port of it; the host is not looked up yet.
struct HostPort {
    std::string host;        ///< name or address, without brackets
    std::uint16_t port = 0;  ///< 1 to 65535

    /// "localhost:9000", "[::1]:9000".
    [[nodiscard]] std::string text() const;
};

/// Reads one target. Each method takes what it is about; the first fault is kept, and later methods
/// give what they would without the target. Threads: one. Real-time: no.
///
///     TargetReader reader("studio:9000,lead=30");
///     const HostPort place = reader.host_port({});
///     const OutputTiming timing = reader.timing();
///     if (auto read = reader.finish(); !read) ...
class TargetReader {
 public:
    /// `text`: the place, and behind each comma `key=value`.
    explicit TargetReader(std::string_view text);
    /// A file: its name may have commas, so that only `lead=` and `factor=` at its end are options.
    [[nodiscard]] static TargetReader of_file(std::string_view text);

    /// What stands before the options.
    [[nodiscard]] const std::string& place() const noexcept { return place_; }
    /// The place as `HOST:PORT`, `[IPV6]:PORT` or, where there is a usual port, `HOST`.
    [[nodiscard]] HostPort host_port(std::optional<std::uint16_t> usual_port);
    /// `lead=` (-500 to 90 ms) and `factor=` (0.5, 1 or 2).
    [[nodiscard]] OutputTiming timing();
    /// `lead=` alone, of a target that is told no beats.
    [[nodiscard]] Nanos lead();
    /// A number within bounds, or `without`.
    [[nodiscard]] double number(std::string_view key, double without, double low, double high);
    /// One of `words`, by its place among them; 0 where it is not given.
    [[nodiscard]] std::size_t word(std::string_view key, std::span<const std::string_view> words);
    /// Any text; nothing: it is not given.
    [[nodiscard]] std::optional<std::string> text(std::string_view key);
    /// Keeps a fault that the caller has found, where there was none before.
    void complain(const std::string& fault);
    /// Errors: the first fault; an option that no method asked for.
    [[nodiscard]] Expected<void> finish();

 private:
    TargetReader() = default;

    std::string place_;
    std::vector<std::pair<std::string, std::string>> options_;  // that nobody has taken yet
    std::vector<std::string_view> known_;                       // keys that were asked for
    std::string fault_;
};

}  // namespace raks::engine
