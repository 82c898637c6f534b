#include "audio/evaluate/form_scores.hpp"

#include <gtest/gtest.h>

namespace raks::audio {
namespace {

using Kind = MusicEvent::Kind;

MusicEvent event(Kind kind, double seconds) { return {kind, stream_time_from_seconds(seconds)}; }
TrueEvent wanted(Kind kind, double seconds) {
    return {event(kind, seconds), std::chrono::milliseconds(500)};
}
ToldEvent told(Kind kind, double seconds, double at) {
    return {event(kind, seconds), stream_time_from_seconds(at)};
}
const EventScore& of(const FormScores& scores, Kind kind) {
    return scores[static_cast<std::size_t>(kind)];
}

TEST(FormScores, counts_what_was_found_missed_and_wrongly_told) {
    const std::vector<TrueEvent> truth = {
        wanted(Kind::stop, 10.0), wanted(Kind::entry, 12.0), wanted(Kind::stop, 20.0)};
    const std::vector<ToldEvent> heard = {told(Kind::stop, 10.1, 10.2),
                                          told(Kind::stop, 10.3, 10.4),
                                          told(Kind::entry, 12.0, 12.1),
                                          told(Kind::stop, 21.0, 21.1)};
    FormScores scores;
    score_form(truth, heard, scores);
    EXPECT_EQ(of(scores, Kind::stop).wanted, 2U);
    EXPECT_EQ(of(scores, Kind::stop).found, 1U);
    EXPECT_EQ(of(scores, Kind::stop).false_ones, 2U) << "told twice, and too late";
    EXPECT_NEAR(of(scores, Kind::stop).offsets.front(), 0.1, 1e-9);
    EXPECT_NEAR(of(scores, Kind::stop).delays.front(), 0.2, 1e-9);
    EXPECT_EQ(of(scores, Kind::entry).found, 1U);
}

TEST(FormScores, an_entry_at_a_drop_and_what_rings_after_the_end_are_no_faults) {
    const std::vector<TrueEvent> truth = {wanted(Kind::drop, 10.0), wanted(Kind::end, 20.0)};
    const std::vector<ToldEvent> heard = {told(Kind::entry, 10.0, 10.0),
                                          told(Kind::drop, 10.0, 10.4),
                                          told(Kind::stop, 24.0, 24.1),
                                          told(Kind::end, 20.0, 27.0)};
    FormScores scores;
    score_form(truth, heard, scores);
    for (const EventScore& score : scores) {
        EXPECT_EQ(score.false_ones, 0U);
        EXPECT_EQ(score.found, score.wanted);
    }
}

}  // namespace
}  // namespace raks::audio
