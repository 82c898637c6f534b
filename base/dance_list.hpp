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

/// The dances that the program knows, and the file that defines them.
namespace raks {

/// A dance by its index in the DanceList that the program was started with.
enum class DanceId : std::uint8_t {
    none = 255,  ///< none of them, or not known
};
inline constexpr std::size_t kMostDances = 250;  ///< so that ids fit a byte, with room for none

/// Index into DanceList::all(); of none it is beyond every list.
[[nodiscard]] constexpr std::size_t index_of(DanceId id) noexcept {
    return static_cast<std::size_t>(id);
}

/// What is known of a dance besides its figures.
struct DanceInfo {
    std::string name;                 ///< in file names and options; passes is_dance_name
    std::string title;                ///< for people: "Salsa"
    int beats_per_bar = 4;            ///< of its music, 2 to 12
    Bpm lowest{60.0};                 ///< slowest music that is danced to
    Bpm highest{180.0};               ///< fastest music that is danced to
    Bpm likely{120.0};                ///< typical tempo of its music
    int roles = 1;                    ///< 1, or 2: it has figures for couples
    std::string style;                ///< of the built-in music generator that fits it; empty: none
    std::string dress;                ///< what the mannequin wears in it; empty: a unitard
    std::vector<std::string> labels;  ///< other names of its music in tables of clips
    std::string extends;  ///< the dance that its figures are added to; empty: a dance of its own
    /// Jerk of the people that it was learnt from, m/s^3, lead's and follow's; 0: a written dance,
    /// or not known. Here the root mean square, below the 99.9th percentile.
    std::array<double, 2> people_jerk_rms{};
    std::array<double, 2> people_jerk_p999{};  ///< 99.9th percentile
    bool is_fallback = false;  ///< danced to music of none of the dances, if nobody says otherwise
    /// Extent of the trials in `raks eval dance`.
    enum class Trials : std::uint8_t { brief, full };
    Trials trials = Trials::brief;  ///< how thoroughly `raks eval dance` tests it
};

/// Is this a valid dance name: letters, digits, '-' and '_', at most 40, a letter or digit first?
/// Other names could leave a folder or break a file name. Words that options use for something else
/// ("auto", "none") are refused, and "dances", as the list of a folder's dances has that name.
[[nodiscard]] bool is_dance_name(std::string_view name) noexcept;
/// One line that quotes the name and says why it is not valid; for error messages.
[[nodiscard]] std::string why_no_dance_name(std::string_view name);
/// A valid dance name that is most like a text, such as the name of a file: what a name may not
/// have becomes one '_', and what begins or ends with it or with '-' loses that. "my dance (2)" is
/// my_dance_2. A text of which nothing is left, and a word that options use, is dance_TEXT.
[[nodiscard]] std::string made_dance_name(std::string_view text);

/// The dances that a program knows, in the order in which they are listed and chosen. At most
/// kMostDances. Immutable once it is shared. Threads: any may read. Real-time: find by id yes.
class DanceList {
 public:
    DanceList() = default;  ///< no dances
    /// At most kMostDances.
    explicit DanceList(std::vector<DanceInfo> dances);

    /// Number of dances.
    [[nodiscard]] std::size_t size() const noexcept { return dances_.size(); }
    /// In order.
    [[nodiscard]] const std::vector<DanceInfo>& all() const noexcept { return dances_; }
    /// The dance's entry; null where `id` is none or beyond the list. Real-time: yes.
    [[nodiscard]] const DanceInfo* find(DanceId id) const noexcept {
        return index_of(id) < dances_.size() ? &dances_[index_of(id)] : nullptr;
    }
    /// Id of the dance with this name; none: there is no such dance.
    [[nodiscard]] DanceId id_of(std::string_view name) const noexcept;
    /// Its name; "unknown" for none.
    [[nodiscard]] std::string_view name_of(DanceId id) const noexcept;
    /// Its title; "" for none.
    [[nodiscard]] std::string_view title_of(DanceId id) const noexcept;
    [[nodiscard]] std::vector<std::string_view> names() const;  ///< of all, in order

 private:
    std::vector<DanceInfo> dances_;
};

/// Contents of a `dances.toml`.
struct DancesFile {
    std::vector<DanceInfo> dances;  ///< in the order of the file
    /// Two dances that genre reports compare with each other, as the paper does; empty: none.
    std::vector<std::string> pair;
};

/// Reads TOML: format = "raks-dances", version = 1, pair = ["A", "B"] and for each dance a
/// [[dance]] with name, title, beats_per_bar (2 to 12), tempo = [lowest, highest] and likely_tempo
/// (20 to 400 BPM), roles (1 or 2), style, dress, labels, fallback (true or false), trials ("brief"
/// or "full"), people_jerk_rms and people_jerk_p999 = [lead, follow]; or with extends = "DANCE".
/// `styles`: the names that `style` may have; empty: any.
/// Errors, one line with file and line: not TOML, another format, a newer version, unknown keys, a
/// bad or repeated name, a metre or tempo out of range, a lowest tempo above the highest, an
/// unknown style, no dance.
[[nodiscard]] Expected<DancesFile> parse_dances(std::string_view toml,
                                                const std::string& file,
                                                const std::vector<std::string_view>& styles = {});
/// Reads and parses a file. Errors: as parse_dances and read_text_file.
[[nodiscard]] Expected<DancesFile> load_dances(const std::filesystem::path& file,
                                               const std::vector<std::string_view>& styles = {});

/// The text of such a file, to be read by parse_dances, which then gives the same.
[[nodiscard]] std::string dances_text(const DancesFile& file);
/// The text of one [[dance]] table, with an empty line before it.
[[nodiscard]] std::string dance_text(const DanceInfo& dance);

}  // namespace raks
