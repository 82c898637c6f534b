#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "apps/reports/genre_track.hpp"
#include "audio/genre/dance_decision.hpp"
#include "audio/music_analyzer.hpp"

namespace raks::apps {

/// Follows an analyzer that is not told the tags, hop by hop: what each part says, and what would
/// be shown by each of them alone and by all. Threads: one. Real-time: no.
class GenreWatch final : public audio::MusicAnalyzer::Sink {
 public:
    /// What is known of the file.
    struct File {
        std::size_t truth = 0;          ///< class of its genre
        GenreLogProbabilities prior{};  ///< what its tags say
        bool has_tagger = false;        ///< whether the analyzer has one
    };
    /// `analyzer`: prepared, with a genre model; it must outlive this, and its states come here.
    GenreWatch(const audio::MusicAnalyzer& analyzer, const File& file);

    void on_state(const MusicState& state) noexcept override;

    /// The file over time; complete after its last hop.
    [[nodiscard]] const GenreTrack& track() const noexcept { return track_; }
    /// What would be shown by each; nothing for those who have nothing to say.
    [[nodiscard]] ByVoice<std::optional<ShownDance>> shown() const;
    /// With which confidence; none of those who have nothing to say. See shown_claims().
    [[nodiscard]] ByVoice<std::vector<audio::Claim>> claims() const;

 private:
    void judge(const MusicState& state);
    [[nodiscard]] bool is_shown(std::size_t voice) const noexcept;

    const audio::MusicAnalyzer& analyzer_;
    std::size_t truth_;
    GenreTrack track_;
    ByVoice<audio::DanceDecision> decisions_;
    ByVoice<ShownDanceTally> tallies_;
    std::int64_t judged_ = 0;  // number of the moment that was judged last
};

}  // namespace raks::apps
