#include "engine/outputs/osc_presets.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace raks::engine {
namespace {

constexpr double kTempoStep = 0.1;  // BPM

// A tempo that is told where it changes.
class ToldTempo {
 public:
    [[nodiscard]] bool is_new(Bpm tempo) noexcept {
        if (told_ && std::abs(*told_ - tempo.bpm()) < kTempoStep) {
            return false;
        }
        told_ = tempo.bpm();
        return true;
    }

 private:
    std::optional<double> told_;
};

/// What knows beats alone.
class BeatOsc : public OscOutput {
 public:
    using OscOutput::OscOutput;

    void tell(const OutputMoment& moment) final {
        if (moment.notice.kind == Notice::Kind::beat) {
            tell_beat(moment.notice);
        }
    }

 private:
    virtual void tell_beat(const Notice& beat) = 0;
};

class PlainOsc final : public BeatOsc {
 public:
    using BeatOsc::BeatOsc;

 private:
    void tell_beat(const Notice& beat) override {
        if (beat.is_paced) {
            send("/beat", 1.0F);
        }
        if (beat.is_counted && beat.count == 1) {
            send("/bar", 1.0F);
        }
        if (tempo_.is_new(beat.paced_tempo)) {
            send("/bpm", static_cast<float>(beat.paced_tempo.bpm()));
        }
    }

    ToldTempo tempo_;
};

// Its tempo is 0 to 1 from 20 to 500 BPM; a resync says "now is the first beat".
class ResolumeOsc final : public BeatOsc {
 public:
    using BeatOsc::BeatOsc;

 private:
    void tell_beat(const Notice& beat) override {
        if (tempo_.is_new(beat.paced_tempo)) {
            const double share = (beat.paced_tempo.bpm() - 20.0) / 480.0;
            send("/composition/tempocontroller/tempo",
                 static_cast<float>(std::clamp(share, 0.0, 1.0)));
        }
        owes_resync_ = owes_resync_ || beat.is_change;
        if (owes_resync_ && beat.is_counted && beat.count == 1) {
            send("/composition/tempocontroller/resync", std::int32_t{1});
            owes_resync_ = false;
        }
    }

    ToldTempo tempo_;
    bool owes_resync_ = false;
};

}  // namespace

std::unique_ptr<Output> open_foreign_osc(const OscTarget& target) {
    if (target.preset == OscPreset::resolume) {
        return std::make_unique<ResolumeOsc>(target);
    }
    return std::make_unique<PlainOsc>(target);
}

}  // namespace raks::engine
