// Genre track: what each part thinks of a file's dance over time, and what would be shown by it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "audio/evaluate/reliability.hpp"
#include "audio/genre/genre_fusion.hpp"

/// Threads: any. Real-time: no.
namespace raks::apps {

/// Who is asked which dance a song is for.
enum class GenreVoice : std::uint8_t {
    tags,       ///< what the file says of itself, alone
    own_parts,  ///< the genre model's parts
    tagger,     ///< the music tagger
    heard,      ///< own parts and tagger: the decision on a file without tags
    all         ///< what is heard, with the tags as prior: the decision of the program
};
/// In the order of GenreVoice.
inline constexpr std::array<std::string_view, 5> kGenreVoiceNames = {
    "tags", "own parts", "tagger", "heard", "all"};
/// One value a voice.
template <class Value>
using ByVoice = std::array<Value, kGenreVoiceNames.size()>;

/// What all say at one moment.
struct GenreStep {
    double seconds = 0.0;                        ///< since the file's start
    ByVoice<bool> is_heard{};                    ///< whether it has said anything yet
    ByVoice<audio::GenreScores::Values> logs{};  ///< ln probabilities by class
    ByVoice<std::size_t> shown{};                ///< class that is shown by it
};

/// A file over time.
struct GenreTrack {
    std::vector<std::string> genres;  ///< the classes' names, without that of "none of them"
    /// Who has something of its own to say in this file: all of them only beside tags.
    ByVoice<bool> is_asked{};
    std::vector<GenreStep> steps;  ///< ascending
    double seconds = 0.0;          ///< length of the file
};

/// What the program would show of one file by one voice.
struct ShownDance {
    double seconds = 0.0;
    int switches = 0;          ///< after the first genre
    double right_share = 0.0;  ///< of the hops from 10 s on
    std::size_t at_end = 0;    ///< class that is shown at last
    double wrong_share = 0.0;  ///< of the hops from 5 s on: another dance than that of the file
};

/// Of each decision from 5 s on by which a dance was shown: its probability, which the program
/// tells as its confidence, and whether it is the file's. `truth`: class of the file.
[[nodiscard]] std::vector<audio::Claim> shown_claims(const GenreTrack& track,
                                                     GenreVoice voice,
                                                     std::size_t truth);

/// Tallies what is shown hop by hop. Threads: one.
class ShownDanceTally {
 public:
    /// `truth`: class of the file; `none`: the class of "unknown".
    ShownDanceTally(std::size_t truth, std::size_t none)
        : truth_(truth), none_(none), last_(none) {}
    /// The class that is shown at a time, at each hop in turn.
    void add(double seconds, std::size_t shown) noexcept;
    /// So far.
    [[nodiscard]] ShownDance result() const noexcept;

 private:
    std::size_t truth_;
    std::size_t none_;
    std::size_t last_;
    double seconds_ = 0.0;
    int switches_ = 0;
    int counted_ = 0;
    int right_ = 0;
    int danced_ = 0;
    int wrong_ = 0;
};

}  // namespace raks::apps
