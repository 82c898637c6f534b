#include "engine/outputs/osc_output.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "engine/outputs/osc_presets.hpp"
#include "engine/outputs/osc_target.hpp"
#include "engine/outputs/paced_turns.hpp"

namespace raks::engine {
namespace {

constexpr std::int64_t kBarsOfPhrase = 8;
constexpr double kMostBeatsAhead = 32.0;        // that /next is told before its event
constexpr HopIndex kRepeated = kHopsPerSecond;  // hops after which numbers are sent again
constexpr float kQuietest = -60.0F;             // dBFS: level 0

std::string text_of(std::string_view view) { return std::string(view); }

// A number that is sent where it has moved by a step, and once a second.
class MovingNumber {
 public:
    explicit MovingNumber(double step) : step_(step) {}
    [[nodiscard]] bool takes(double value, HopIndex hop) noexcept {
        if (has_value_ && std::abs(value - value_) < step_ && hop - hop_ < kRepeated &&
            hop >= hop_) {
            return false;
        }
        has_value_ = true;
        value_ = value;
        hop_ = hop;
        return true;
    }

 private:
    double step_;
    bool has_value_ = false;
    double value_ = 0.0;
    HopIndex hop_ = 0;
};

// Something that is sent where it changes.
template <typename Value>
class Change {
 public:
    [[nodiscard]] bool takes(const Value& value) {
        const bool is_new = !value_ || *value_ != value;
        value_ = value;
        return is_new;
    }

 private:
    std::optional<Value> value_;
};

// Three bands of a spectrum, each [0, 1].
std::array<float, 3> bands_of(const MusicSpectrum& spectrum) {
    constexpr std::array<std::size_t, 4> kEdges = {0, 3, 11, MusicSpectrum::kBands};
    std::array<float, 3> bands{};
    for (std::size_t i = 0; i < bands.size(); ++i) {
        float sum = 0.0F;
        for (std::size_t band = kEdges[i]; band < kEdges[i + 1]; ++band) {
            sum += static_cast<float>(spectrum.bands[band]);
        }
        bands[i] = sum / (255.0F * static_cast<float>(kEdges[i + 1] - kEdges[i]));
    }
    return bands;
}

// The addresses of our own.
class RaksOsc final : public OscOutput {
 public:
    explicit RaksOsc(const OscTarget& target) : OscOutput(target) {
        if (target.rate > 0.0) {
            paced_.emplace(target.rate);
        }
    }
    ~RaksOsc() override { send("/goodbye", std::int32_t{1}); }

    void tell(const OutputMoment& moment) override {
        switch (moment.notice.kind) {
            case Notice::Kind::beat:
                tell_beat(moment);
                break;
            case Notice::Kind::event:
                send(("/trigger/" + text_of(music_event_name(moment.notice.event))).c_str(), 1.0F);
                break;
            case Notice::Kind::accent: {
                constexpr std::array kBands = {"/trigger/kick", "/trigger/snare", "/trigger/hat"};
                send(kBands[static_cast<std::size_t>(moment.notice.accent.band)],
                     moment.notice.accent.strength);
                break;
            }
        }
    }

    void hear(const OutputHop& hop) override {
        newest_ = hop.music;
        const MusicState& music = hop.music;
        const bool is_locked = music.grid.confidence >= BeatGrid::kDanceable || music.is_tempo_held;
        // While it is sought the tempo says nothing.
        const double bpm = music.grid.tempo.bpm() * factor();
        if (is_locked && bpm_.takes(bpm, music.hop)) {
            send("/bpm", static_cast<float>(bpm));
        }
        if (energy_.takes(static_cast<double>(music.energy.now), music.hop)) {
            send("/energy", music.energy.now);
        }
        if (part_.takes(music.part)) {
            send("/part", text_of(music_part_name(music.part)).c_str());
        }
        if (lock_.takes(is_locked)) {
            send("/lock", std::int32_t{is_locked});
        }
        if (silence_.takes(music.is_silent)) {
            send("/silence", std::int32_t{music.is_silent});
        }
        if (genre_.takes(music.genre)) {
            const float log = music.genre_log_probability[std::min<std::size_t>(
                music.genre_class, music.genre_log_probability.size() - 1)];
            send("/genre", text_of(hop.dances.name_of(music.genre)).c_str(), std::exp(log));
        }
        if (figure_.takes(hop.figure)) {
            send("/figure", hop.figure.name.data(), std::int32_t{hop.figure.counts});
        }
    }

    void name_song(const SongName& song) override {
        send("/now", song.title.c_str(), song.artist.c_str());
    }

    void turn(const OutputTurn& turn) override {
        OscOutput::turn(turn);
        if (paced_ && newest_ && paced_->take(turn.now) && turn.line) {
            send_levels(*turn.line, turn.now);
        }
    }

    [[nodiscard]] std::optional<HostTime> due() const override {
        return paced_ ? std::optional(paced_->next()) : std::nullopt;
    }

 private:
    [[nodiscard]] double factor() const noexcept {
        return timing().pace == BeatSchedule::Pace::half    ? 0.5
               : timing().pace == BeatSchedule::Pace::twice ? 2.0
                                                            : 1.0;
    }

    // First what a desk maps, each by itself; the rest of the moment in one bundle.
    void tell_beat(const OutputMoment& moment) {
        const Notice& beat = moment.notice;
        if (beat.is_paced) {
            send("/trigger/beat", 1.0F);
        }
        const bool is_bar = beat.is_counted && beat.count == 1;
        if (is_bar) {
            send("/trigger/bar", 1.0F);
        }
        if (is_bar && begins_phrase(beat.bar)) {
            send("/trigger/phrase", 1.0F);
        }
        OscPacket bundle(osc_time(moment.heard_at));
        if (beat.is_paced) {
            bundle.add(prefix() + "/beat",
                       std::int32_t{beat.count},
                       static_cast<std::int32_t>(beat.bar),
                       static_cast<float>(beat.paced_tempo.bpm()),
                       beat.confidence);
        }
        if (beat.is_counted) {
            add_next(beat, bundle);
        }
        send(bundle);
    }

    // From the first whole bar on; bars are counted anew when a beat is found.
    [[nodiscard]] bool begins_phrase(std::int64_t bar) noexcept {
        first_bar_ = bar <= last_bar_ ? bar : first_bar_.value_or(bar);
        last_bar_ = bar;
        return (bar - *first_bar_) % kBarsOfPhrase == 0;
    }

    void add_next(const Notice& beat, OscPacket& bundle) const {
        if (!newest_ || !newest_->ahead.is_known) {
            return;
        }
        for (const MusicEvent& event : newest_->ahead.events) {
            const double beats = to_seconds(event.time - beat.time) * beat.tempo.beats_per_second();
            if (event.kind != MusicEvent::Kind::none && beats > 0.5) {
                if (beats <= kMostBeatsAhead) {
                    bundle.add(prefix() + "/next",
                               text_of(music_event_name(event.kind)).c_str(),
                               static_cast<float>(beats));
                }
                return;
            }
        }
    }

    void send_levels(const HeardLine& line, HostTime now) {
        const MusicState& music = *newest_;
        const StreamTime heard = line.heard_by(now + timing().lead);
        const Beats beats = music.grid.beats_at(heard);
        OscPacket bundle(osc_time(now + timing().lead));
        bundle.add(prefix() + "/phase",
                   static_cast<float>(BeatPhase(beats).value()),
                   static_cast<float>(music.grid.bar_position(beats) / music.grid.beats_per_bar));
        bundle.add(prefix() + "/level",
                   std::clamp(1.0F - music.level_dbfs / kQuietest, 0.0F, 1.0F));
        const std::array<float, 3> bands = bands_of(music.spectrum);
        bundle.add(prefix() + "/bands", bands[0], bands[1], bands[2]);
        send(bundle);
    }

    std::optional<PacedTurns> paced_;
    std::optional<MusicState> newest_;
    std::optional<std::int64_t> first_bar_;  // that began with count 1
    std::int64_t last_bar_ = 0;
    MovingNumber bpm_{0.1};
    MovingNumber energy_{0.02};
    Change<MusicPart> part_;
    Change<bool> lock_;
    Change<bool> silence_;
    Change<DanceId> genre_;
    Change<FeedFigure> figure_;
};

}  // namespace

Expected<std::unique_ptr<Output>> open_osc(const std::string& target) {
    const auto read = read_osc_target(target);
    if (!read) {
        return fail("--osc " + target + ": " + read.error().message);
    }
    if (read->preset == OscPreset::raks) {
        return std::make_unique<RaksOsc>(*read);
    }
    return open_foreign_osc(*read);
}

Expected<void> check_osc(const std::string& target) {
    const auto read = read_osc_target(target);
    return read ? Expected<void>() : fail(read.error());
}

}  // namespace raks::engine
