#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "audio/genre/genre_words.hpp"
#include "base/music_state.hpp"

namespace raks::audio {

struct GenreModel;  // audio/genre/genre_model.hpp

/// ln of the odds by which a genre in a file's tags speaks for its dance. It is evidence and no
/// command: music that is heard clearly has a mean of ln probabilities that is further apart. Of
/// 67 clips of people's music that no model was trained on, the decision is right at the end for
/// 37 without a tag; with the right tag of strength 1.5, 2, 2.5 for 58, 61, 62; with a wrong one
/// for 27, 17, 16.
inline constexpr float kGenreTagStrength = 1.5F;
/// The same of a word in title, artist or album, which is often no genre.
inline constexpr float kTitleStrength = 0.6F;

/// The texts of a file's tags. UTF-8, or nearly; each of any length.
struct TagTexts {
    std::string_view genre{};
    std::string_view title{};
    std::string_view artist{};
    std::string_view album{};
};

/// What a file's own words say of its dance. Threads: any. Real-time: no.
struct TagEvidence {
    /// A name of GenreWords' rows and how much is said for it, in nats; each once, in the order of
    /// the words. All but kFallback are dances.
    std::vector<std::pair<std::string, float>> dances;
    std::vector<std::string> words;  ///< that were understood, as the table has them; each once
    /// The person said it, and not the file: then `dances` may weigh any amount.
    bool is_by_person = false;

    /// The dance, or kFallback, for which most is said; of equals the first. Empty: none.
    [[nodiscard]] std::string_view dance() const noexcept;
};

/// Looks the words up. A genre tag may hold several genres: its strength is shared out among them.
/// Title, artist and album share theirs. No dance has more than kGenreTagStrength.
[[nodiscard]] TagEvidence evidence_of(const TagTexts& tags, const GenreWords& table);

/// The evidence by class of a model, to be added to ln probabilities: GenreSettings::prior. What
/// none of the model's genres is counts for none of them.
[[nodiscard]] GenreLogProbabilities prior_of(const TagEvidence& evidence, const GenreModel& model);

}  // namespace raks::audio
