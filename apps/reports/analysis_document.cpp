#include "apps/reports/analysis_document.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "base/json.hpp"
#include "base/printable.hpp"
#include "base/statistics.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Hops between two points of what comes twice a second.
constexpr HopIndex kHopsPerPoint = 50;

// To microseconds, finer than any beat: more digits only lengthen the document.
double rounded(double seconds) { return std::round(seconds * 1e6) / 1e6; }
double rounded(StreamTime time) { return rounded(to_seconds(time)); }
// Four decimals of a confidence or posterior.
double shortened(float value) { return std::round(static_cast<double>(value) * 1e4) / 1e4; }

Json json_of(const MusicField& field, const MusicValue& value) {
    if (const auto* const number = std::get_if<double>(&value)) {
        const double scale = std::pow(10.0, field.decimals);
        return std::round(*number * scale) / scale;
    }
    return std::visit([](const auto& other) { return Json(other); }, value);
}

}  // namespace

AnalysisDocument::AnalysisDocument(std::string file,
                                   SampleRate rate,
                                   std::vector<std::string> genres)
    : file_(std::move(file)), rate_(rate), genres_(std::move(genres)) {}

// `written`: by this row so far.
bool AnalysisDocument::is_due(const MusicRow& row,
                              const MusicState& state,
                              const std::vector<MusicPoint>& written) {
    switch (row.written) {
        case Written::twice_a_second:
            return state.hop % kHopsPerPoint == 0;
        case Written::when_it_changes:
            return written.empty() ||
                   written.back().values.front() != row.fields.front().value(state);
        case Written::when_it_happens:
            return row.happens(state);
    }
    return false;
}

// What happens is taken at every hop, the slow quantities at every fiftieth.
void AnalysisDocument::add(const MusicState& state) {
    if (state.has_beat) {
        beats_.push_back(state.beat);
    }
    if (state.has_predicted) {
        predicted_.push_back(rounded(state.predicted));
    }
    for (std::size_t i = 0; i < kMusicTable.size(); ++i) {
        const MusicRow& row = kMusicTable[i];
        if (is_due(row, state, music_[i])) {
            MusicPoint& point = music_[i].emplace_back();
            point.time = rounded(row.time(state));
            for (std::size_t field = 0; field < row.used().size(); ++field) {
                point.values[field] = row.fields[field].value(state);
            }
        }
    }
    // The document has one metre: the last one.
    beats_per_bar_ = state.grid.beats_per_bar;
    if (state.hop % kHopsPerPoint != 0) {
        return;
    }
    const double time = rounded(state.time);
    tempo_.push_back(
        {time, state.grid.tempo.bpm(), state.grid.confidence, state.rival, state.beat_parts});
    genre_.push_back({time, state.genre_class, state.is_genre_told, state.genre_log_probability});
}

void AnalysisDocument::add_tags(const audio::TaggerWord& word) {
    const auto strongest = audio::strongest_tags(word);
    TagPoint point{.time = rounded(word.until), .tags = {}, .probabilities = {}};
    for (std::size_t i = 0; i < kStrongest; ++i) {
        point.tags[i] = strongest[i];
        point.probabilities[i] = 1.0F / (1.0F + std::exp(-word.mean_logits[point.tags[i]]));
    }
    tags_.push_back(point);
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
        point.rival = {};
        if (next < beats_.size()) {
            // Tempo of the one interval, without smoothing.
            point.bpm = 60.0 / to_seconds(beats_[next].time - beats_[next - 1].time);
            point.confidence = beats_[next].confidence;
        }
    }
}

void AnalysisDocument::add_music(Json& document) const {
    for (std::size_t i = 0; i < kMusicTable.size(); ++i) {
        const MusicRow& row = kMusicTable[i];
        auto& points = document[row.name] = Json::array();
        for (const MusicPoint& point : music_[i]) {
            Json entry = {{"time", point.time}};
            for (std::size_t field = 0; field < row.used().size(); ++field) {
                entry[row.fields[field].key] = json_of(row.fields[field], point.values[field]);
            }
            points.push_back(std::move(entry));
        }
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
    if (!told_.words.empty()) {
        document["tags"] = {{"words", told_.words}, {"dance", told_.dance()}};
    }
    auto& tempo = document["tempo"] = Json::array();
    for (const TempoPoint& point : tempo_) {
        tempo.push_back({{"time", point.time},
                         {"bpm", std::round(point.bpm * 1e3) / 1e3},
                         {"confidence", shortened(point.confidence)},
                         {"rival_bpm", std::round(point.rival.bpm * 1e3) / 1e3},
                         {"rival", shortened(point.rival.probability)},
                         {"parts", point.parts}});
    }
    auto& beats = document["beats"] = Json::array();
    for (const BeatEvent& beat : beats_) {
        beats.push_back({{"time", rounded(beat.time)},
                         {"bar_position", beat.bar_position},
                         {"confidence", shortened(beat.confidence)},
                         {"bar_confidence", shortened(beat.bar_confidence)}});
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
        if (point.is_told) {
            genre.back()["by_tags"] = true;
        }
    }
    if (has_tags_) {
        auto& tags = document["tagger"] = Json::array();
        for (const TagPoint& point : tags_) {
            Json strongest = Json::array();
            for (std::size_t i = 0; i < kStrongest; ++i) {
                strongest.push_back({{"tag", audio::kTagNames[point.tags[i]]},
                                     {"probability", shortened(point.probabilities[i])}});
            }
            tags.push_back({{"time", point.time}, {"strongest", strongest}});
        }
    }
    add_music(document);
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
    text += !genre_.empty() && genre_.back().is_told ? ", as the file says" : "";
    return text + "\n";
}

}  // namespace raks::apps
