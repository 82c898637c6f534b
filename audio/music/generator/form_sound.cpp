#include "audio/music/generator/form_sound.hpp"

#include <algorithm>
#include <cmath>

namespace raks::audio {
namespace {

constexpr double kGlideSeconds = 0.004;    // between two levels: a jump would click
constexpr std::int64_t kFilterSteps = 16;  // frames between changes of the low-pass
constexpr double kButterworth = 0.7071;
constexpr double kRiffGain = 2.5;  // about what drums and bass leave room for

}  // namespace

FormSound::FormSound(std::span<const SectionSpan> form, const TempoCurve& curve, double rate)
    : rate_(rate),
      glide_(1.0 - std::exp(-1.0 / (kGlideSeconds * rate))),
      left_low_(1000.0, kButterworth, rate),
      right_low_(1000.0, kButterworth, rate) {
    for (const SectionSpan& section : form) {
        Stretch stretch{std::llround(curve.seconds_at(section.from) * rate),
                        std::llround(curve.seconds_at(section.to) * rate)};
        switch (section.kind) {
            case SectionKind::intro:
            case SectionKind::verse:
                stretch.gain_from = stretch.gain_to = 0.63;
                break;
            case SectionKind::breakdown:
                stretch.gain_from = stretch.gain_to = 0.5;
                break;
            case SectionKind::filtered:
                stretch.gain_from = stretch.gain_to = 0.25;
                stretch.hertz_from = stretch.hertz_to = 300.0;
                break;
            case SectionKind::riff:
                stretch.gain_from = stretch.gain_to = kRiffGain;
                break;
            case SectionKind::build_up:
                stretch.gain_from = 0.4;
                stretch.gain_to = 0.95;
                stretch.hertz_from = 500.0;
                stretch.hertz_to = 16'000.0;
                break;
            case SectionKind::ending:
            case SectionKind::fade_out:
                stretch.gain_to = 0.0;
                break;
            case SectionKind::full:
            case SectionKind::drop:
            case SectionKind::stop:
            case SectionKind::hit_stop:
                break;
        }
        stretches_.push_back(stretch);
    }
}

// Where gain and low-pass are to be at this frame.
void FormSound::set_goals(std::int64_t frame) {
    while (at_ + 1 < stretches_.size() && frame >= stretches_[at_].to) {
        ++at_;
    }
    const Stretch& now = stretches_[at_];
    const double share =
        std::clamp(static_cast<double>(frame - now.from) /
                       static_cast<double>(std::max<std::int64_t>(now.to - now.from, 1)),
                   0.0,
                   1.0);
    // Squared at the end: what falls evenly to the ear falls faster at first.
    const double way = now.gain_to > 0.0 ? share : 1.0 - (1.0 - share) * (1.0 - share);
    goal_gain_ = now.gain_from + way * (now.gain_to - now.gain_from);
    goal_wet_ = now.hertz_from > 0.0 ? 1.0 : 0.0;
    if (now.hertz_from > 0.0) {
        const double hertz = now.hertz_from * std::pow(now.hertz_to / now.hertz_from, share);
        left_low_.set(hertz, kButterworth, rate_);
        right_low_.set(hertz, kButterworth, rate_);
    }
}

void FormSound::begin(std::int64_t frame) {
    left_low_ = right_low_ = StateVariableFilter(1000.0, kButterworth, rate_);
    if (!stretches_.empty()) {
        set_goals(frame);
        gain_ = goal_gain_;
        wet_ = goal_wet_;
    }
}

void FormSound::process(std::int64_t from, std::span<float> left, std::span<float> right) {
    if (stretches_.empty()) {
        return;
    }
    for (std::size_t i = 0; i < left.size(); ++i) {
        const std::int64_t frame = from + static_cast<std::int64_t>(i);
        // By the frame's number, not by the block's: blocks may begin anywhere.
        if (i == 0 || frame % kFilterSteps == 0) {
            set_goals(frame);
        }
        gain_ += glide_ * (goal_gain_ - gain_);
        wet_ += glide_ * (goal_wet_ - wet_);
        const auto changed = [&](StateVariableFilter& filter, float dry) {
            filter.feed(static_cast<double>(dry));
            return static_cast<float>(
                gain_ * (wet_ * filter.low() + (1.0 - wet_) * static_cast<double>(dry)));
        };
        left[i] = changed(left_low_, left[i]);
        right[i] = changed(right_low_, right[i]);
    }
}

}  // namespace raks::audio
