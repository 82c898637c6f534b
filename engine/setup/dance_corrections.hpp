#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/expected.hpp"

namespace raks::engine {

/// One song's dance, as a person said it.
struct DanceCorrection {
    std::string dance{};             ///< a name of the program's list
    std::string artist{};            ///< as the file's tags name it; empty: they do not
    std::filesystem::path folder{};  ///< of the album: the one that the song lies in; absolute
    std::filesystem::path song{};    ///< absolute

    friend bool operator==(const DanceCorrection&, const DanceCorrection&) = default;
};

/// Where a song lies, whatever it was called by: absolute, links followed. Threads: any.
[[nodiscard]] std::filesystem::path place_of_song(const std::filesystem::path& file);

/// The dances that a person said are right, by song. File format: docs/reference/files.md. Threads:
/// one, or any number of readers. Real-time: no.
class DanceCorrections {
 public:
    /// Of the document. Where a new row does not fit, the oldest go.
    static constexpr std::size_t kMostBytes = std::size_t{4} << 20U;

    /// Puts a song's in the place of what is known of it, as the newest. Errors: a name that no
    /// dance can have; a path that is not absolute; a control character, which would break the
    /// table: it is refused and not escaped, so that a row is what it shows.
    [[nodiscard]] Expected<void> set(DanceCorrection correction);
    /// Every song, the oldest first.
    [[nodiscard]] const std::vector<DanceCorrection>& all() const noexcept { return rows_; }

    /// The dance of this very song; empty: none is known.
    [[nodiscard]] std::string_view of_song(const std::filesystem::path& file) const;
    /// The dances of songs by this artist in the folder that `file` lies in, and how many songs
    /// each has. Without an artist none.
    [[nodiscard]] std::vector<std::pair<std::string, int>> of_album(
        std::string_view artist, const std::filesystem::path& file) const;

    /// Reads the table. `name` stands for the file in errors, which say the line: another head
    /// line, another number of columns, or what set() refuses. Empty lines are passed over; of two
    /// rows of a song the later counts.
    [[nodiscard]] static Expected<DanceCorrections> parse(std::string_view text,
                                                          const std::string& name);
    /// The person's file; empty where there is none. Errors: as parse(), and those of reading.
    [[nodiscard]] static Expected<DanceCorrections> load();
    /// The document; parse() of it gives the same.
    [[nodiscard]] std::string to_tsv() const;
    /// Writes the person's file, all of it or nothing; makes its folder. Errors: there is no place
    /// for it; the system's.
    [[nodiscard]] Expected<void> save() const;

    /// Where the person's file lies: $XDG_STATE_HOME/raks/dances.tsv, or below ~/.local/state.
    /// Empty: neither variable names an absolute path.
    [[nodiscard]] static std::filesystem::path path();

 private:
    std::vector<DanceCorrection> rows_;
};

/// The person's corrections in a program that runs: threads that prepare songs read them, main adds
/// to them. Real-time: no.
class KeptCorrections {
 public:
    /// Begins with those that were read.
    explicit KeptCorrections(DanceCorrections corrections);

    /// As they are now; never null. Another address: others. Threads: any.
    [[nodiscard]] std::shared_ptr<const DanceCorrections> now() const;
    /// Adds one to what the file holds by now and writes it. Errors: as DanceCorrections::load,
    /// set and save; then nothing has changed: a bad file is never written over. Threads: main.
    [[nodiscard]] Expected<void> keep(DanceCorrection correction);

 private:
    mutable std::mutex mutex_;
    std::shared_ptr<const DanceCorrections> now_;
};

/// What a person wants to keep.
struct DanceToKeep {
    std::string dance;                   ///< that was chosen by hand; empty: none was
    std::string artist;                  ///< as the file's tags name it
    std::filesystem::path song;          ///< as it was opened
    std::span<const std::string> known;  ///< the dances that can be told from music
};
/// Keeps a dance for its song, and says that, or why not, in a line for people. Threads: main.
[[nodiscard]] std::string keep_dance(KeptCorrections& kept, const DanceToKeep& wish);

}  // namespace raks::engine
