#include "apps/reports/analysis_document.hpp"

#include <cmath>
#include <utility>

#include "base/json.hpp"
#include "base/printable.hpp"
#include "base/statistics.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Hops between two points: tempo, genre and loudness come twice a second.
constexpr HopIndex kHopsPerPoint = 50;

// To microseconds, finer than any beat: more digits only lengthen the document.
double rounded(double seconds) { return std::round(seconds * 1e6) / 1e6; }
double rounded(StreamTime time) { return rounded(to_seconds(time)); }
// Four decimals of a confidence or posterior.
double shortened(float value) { return std::round(static_cast<double>(value) * 1e4) / 1e4; }

}  // namespace

AnalysisDocument::AnalysisDocument(std::string file,
                                   SampleRate rate,
                                   std::vector<std::string> genres)
    : file_(std::move(file)), rate_(rate), genres_(std::move(genres)) {}

// What happens is taken at every hop, the slow quantities at every fiftieth.
void AnalysisDocument::add(const MusicState& state) {
    if (state.has_beat) {
        beats_.push_back(state.beat);
    }
    if (state.has_predicted) {
        predicted_.push_back(rounded(state.predicted));
    }
    if (parts_.empty() || parts_.back().part != state.part) {
        parts_.push_back({rounded(state.time), state.part});
    }
    if (state.event.kind != MusicEvent::Kind::none) {
        events_.push_back({state.event, state.time});
    }
    if (state.accent.strength > 0.0F) {
        accents_.push_back(state.accent);
    }
    // The document has one metre: the last one.
    beats_per_bar_ = state.grid.beats_per_bar;
    if (state.hop % kHopsPerPoint != 0) {
        return;
    }
    const double time = rounded(state.time);
    tempo_.push_back({time, state.grid.tempo.bpm(), state.grid.confidence});
    genre_.push_back({time, state.genre_class, state.genre_log_probability});
    loudness_.push_back({time, state.loudness_lufs});
    energy_.push_back({time, state.energy});
}

void AnalysisDocument::replace_beats(std::vector<BeatEvent> beats) {
    beats_ = std::move(beats);
    predicted_.clear();
    // Beats and points both ascend: the interval from beat next - 1 to next is the one around the
    // point.
    std::size_t next = 1;
    for (TempoPoint& point : tempo_) {
        while (next + 1 < beats_.size() && to_seconds(beats_[next].time) <= point.time) {
            ++next;
        }
        // Beyond the last beat the tempo stays the streaming tracker's, without confidence.
        point.confidence = 0.0F;
        if (next < beats_.size()) {
            // Tempo of the one interval, without smoothing.
            point.bpm = 60.0 / to_seconds(beats_[next].time - beats_[next - 1].time);
            point.confidence = beats_[next].confidence;
        }
    }
}

// Energy, parts, events and accents.
void AnalysisDocument::add_form(Json& document) const {
    auto& energy = document["energy"] = Json::array();
    for (const EnergyPoint& point : energy_) {
        energy.push_back({{"time", point.time},
                          {"now", shortened(point.energy.now)},
                          {"lately", shortened(point.energy.lately)},
                          {"longer", shortened(point.energy.longer)}});
    }
    auto& parts = document["parts"] = Json::array();
    for (const PartPoint& point : parts_) {
        parts.push_back({{"time", point.time}, {"part", music_part_name(point.part)}});
    }
    auto& events = document["events"] = Json::array();
    for (const ToldEvent& told : events_) {
        events.push_back({{"time", rounded(told.event.time)},
                          {"event", music_event_name(told.event.kind)},
                          {"told", rounded(told.told)}});
    }
    auto& accents = document["accents"] = Json::array();
    for (const MusicAccent& accent : accents_) {
        accents.push_back({{"time", rounded(accent.time)},
                           {"strength", shortened(accent.strength)},
                           {"band", music_band_name(accent.band)},
                           {"on_beat", accent.is_on_beat}});
    }
}

// ordered_json keeps the keys in the order in which they are added.
std::string AnalysisDocument::to_json(Nanos duration) const {
    Json document;
    document["format"] = "raks-analysis";
    document["version"] = 1;
    document["file"] = file_;
    document["duration"] = rounded(to_seconds(duration));
    document["sample_rate"] = rate_.hertz();
    auto& tempo = document["tempo"] = Json::array();
    for (const TempoPoint& point : tempo_) {
        tempo.push_back({{"time", point.time},
                         {"bpm", std::round(point.bpm * 1e3) / 1e3},
                         {"confidence", shortened(point.confidence)}});
    }
    auto& beats = document["beats"] = Json::array();
    for (const BeatEvent& beat : beats_) {
        beats.push_back({{"time", rounded(beat.time)},
                         {"bar_position", beat.bar_position},
                         {"confidence", shortened(beat.confidence)}});
    }
    document["predicted"] = predicted_;
    document["meter"] = beats_per_bar_;
    auto& genre = document["genre"] = Json::array();
    // The posterior by class name; the state holds natural logarithms.
    for (const GenrePoint& point : genre_) {
        Json posterior;
        for (std::size_t i = 0; i < genres_.size(); ++i) {
            posterior[genres_[i]] = shortened(std::exp(point.log_probability[i]));
        }
        genre.push_back(
            {{"time", point.time}, {"label", genres_[point.label]}, {"posterior", posterior}});
    }
    auto& loudness = document["loudness"] = Json::array();
    for (const LoudnessPoint& point : loudness_) {
        loudness.push_back({{"time", point.time},
                            {"lufs", std::round(static_cast<double>(point.lufs) * 10) / 10}});
    }
    add_form(document);
    // A file's name need not be UTF-8; invalid bytes become the replacement character.
    return document.text(2) + "\n";
}

// Median over the points at which the tracker was fairly sure; 0 when there are none.
double AnalysisDocument::median_bpm() const {
    std::vector<double> bpm;
    for (const TempoPoint& point : tempo_) {
        if (point.confidence > 0.3F) {
            bpm.push_back(point.bpm);
        }
    }
    return bpm.empty() ? 0.0 : upper_median(std::move(bpm));
}

// The dance is the last decision, which rests on the most music.
std::string AnalysisDocument::to_text(Nanos duration) const {
    const double bpm = median_bpm();
    std::string text = fmt::format("{}: {:.1f} s\n", printable(file_), to_seconds(duration));
    text += bpm > 0.0 ? fmt::format("tempo  {:.1f} BPM, bars of {}\n", bpm, beats_per_bar_)
                      : std::string("tempo  none found\n");
    text += fmt::format("beats  {}", beats_.size());
    if (!beats_.empty()) {
        text += fmt::format(", the first at {:.3f} s", to_seconds(beats_.front().time));
    }
    text += "\ndance  ";
    text += genre_.empty() ? "unknown" : genres_[genre_.back().label];
    return text + "\n";
}

}  // namespace raks::apps
