#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/beats.hpp"
#include "base/expected.hpp"

namespace raks {

/// A dance by its place in the DanceList that the program was started with.
enum class DanceId : std::uint8_t {
    none = 255,  ///< none of them, or not known
};
inline constexpr std::size_t kMostDances = 250;

[[nodiscard]] constexpr std::size_t index_of(DanceId id) noexcept {
    return static_cast<std::size_t>(id);
}

/// What is known of a dance besides its figures.
struct DanceInfo {
    std::string name;   ///< of files and options: is_dance_name
    std::string title;  ///< for people: "Salsa"
    int beats_per_bar = 4;
    Bpm lowest{60.0};  ///< of the music that it is danced to
    Bpm highest{180.0};
    Bpm likely{120.0};
    int roles = 1;                    ///< 1, or 2: it has figures for couples
    std::string style;                ///< of Raks' own music that fits it; empty: none
    std::vector<std::string> labels;  ///< other names of its music in tables of clips
    std::string extends;  ///< the dance that its figures join; empty: it is one of its own
    /// Jerk of the people that it was learnt from, m/s^3, lead's and follow's: root mean square,
    /// and what a thousandth exceeds. 0: written, or not known.
    std::array<double, 2> people_jerk_rms{};
    std::array<double, 2> people_jerk_p999{};
    enum class Trials : std::uint8_t { brief, full };
    Trials trials = Trials::brief;  ///< how much `raks eval dance` asks of it
};

/// Letters, digits, '-' and '_', at most 40, a letter or digit first; all other names could leave a
/// folder or break a file's name. "auto", "keep", "stand", "unknown", "other" and "none" mean
/// something else already.
[[nodiscard]] bool is_dance_name(std::string_view name) noexcept;
/// "NAME" with the reason why it is none; for errors.
[[nodiscard]] std::string why_no_dance_name(std::string_view name);

/// The dances that a program knows, in the order in which they are listed and chosen. At most
/// kMostDances. Immutable once it is shared. Threads: any may read. Real-time: find by id yes.
class DanceList {
 public:
    DanceList() = default;
    explicit DanceList(std::vector<DanceInfo> dances);

    [[nodiscard]] std::size_t size() const noexcept { return dances_.size(); }
    [[nodiscard]] const std::vector<DanceInfo>& all() const noexcept { return dances_; }
    /// Null: `id` is none.
    [[nodiscard]] const DanceInfo* find(DanceId id) const noexcept {
        return index_of(id) < dances_.size() ? &dances_[index_of(id)] : nullptr;
    }
    /// none: no such dance.
    [[nodiscard]] DanceId id_of(std::string_view name) const noexcept;
    /// "unknown" for none.
    [[nodiscard]] std::string_view name_of(DanceId id) const noexcept;
    /// "" for none.
    [[nodiscard]] std::string_view title_of(DanceId id) const noexcept;
    [[nodiscard]] std::vector<std::string_view> names() const;

 private:
    std::vector<DanceInfo> dances_;
};

/// What a `dances.toml` says.
struct DancesFile {
    std::vector<DanceInfo> dances;
    /// Two dances that reports of genres compare with one another, as the paper does; empty: none.
    std::vector<std::string> pair;
};

/// Reads TOML: format = "raks-dances", version = 1, pair = ["A", "B"] and for each dance a
/// [[dance]] with name, title, beats_per_bar (2 to 12), tempo = [lowest, highest] and likely_tempo
/// (20 to 400 BPM), roles (1 or 2), style, labels, trials ("brief" or
/// "full"), people_jerk_rms and people_jerk_p999 = [lead, follow]; or with extends = "DANCE".
/// `styles`: the names that `style` may have; empty: any.
/// Errors, one line with file and line: not TOML, another format, a newer version, unknown keys, a
/// bad or doubled name, a metre or tempo out of range, tempi crossed, an unknown style, none there.
[[nodiscard]] Expected<DancesFile> parse_dances(std::string_view toml,
                                                const std::string& file,
                                                const std::vector<std::string_view>& styles = {});
[[nodiscard]] Expected<DancesFile> load_dances(const std::filesystem::path& file,
                                               const std::vector<std::string_view>& styles = {});

/// The text of such a file, and of one dance in it.
[[nodiscard]] std::string dances_text(const DancesFile& file);
[[nodiscard]] std::string dance_text(const DanceInfo& dance);

}  // namespace raks
