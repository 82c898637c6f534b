#include "engine/live/playback.hpp"

#include <utility>

#include "audio/io/hearing.hpp"
#include "engine/setup/told_genre.hpp"

namespace raks::engine {

Expected<std::unique_ptr<Playback>> Playback::create(std::unique_ptr<audio::FilePlayer> player,
                                                     const AnalyzerModels& models) {
    // The analyzer works at the file's rate: what it computes does not depend on the device.
    const audio::AudioFileInfo& info = player->first_info();
    auto analysis = AnalysisStage::create(info.rate, told(models, info.tags, player->path_of(0)));
    if (!analysis) {
        return fail(analysis.error());
    }
    return std::unique_ptr<Playback>(new Playback(std::move(player), std::move(*analysis)));
}

Playback::Playback(std::unique_ptr<audio::FilePlayer> player,
                   std::unique_ptr<AnalysisStage> analysis)
    : FileSound(std::move(player)), analysis_(std::move(analysis)), mono_(kPullFrames) {}

Expected<void> Playback::prepare(SampleRate device_rate) {
    return FileSound::prepare(device_rate, analysis_->taken_until());
}

void Playback::stop_clock() noexcept {
    fade_in();
    analysis_->stop_clock(given_until());
}

void Playback::on_pulled(const audio::PulledAudio& pulled,
                         std::span<const float> stereo) noexcept RAKS_NONBLOCKING {
    // A seek or another file: the analyzer must not track beats across the cut. The first frames of
    // all follow nothing.
    if (pulled.is_jump && analysis_->taken_until() > StreamTime{}) {
        analysis_->skip(0);
    }
    analysis_->planned().set_place(analysis_->taken_until(), file_rate().time_of(pulled.position));
    const std::span<float> mono = std::span(mono_).first(stereo.size() / 2);
    analysis_->pass_on(stereo, 2);
    audio::hear_mono(stereo, 2, pulled.hearing, mono);
    analysis_->analyze(mono);
}

void Playback::on_output(std::span<float> interleaved,
                         int channels,
                         const audio::BlockTime& time) noexcept RAKS_NONBLOCKING {
    const HostTime start = host_now();
    const Filled filled = fill(interleaved, channels, this);
    if (filled.is_still) {
        analysis_->stop_clock(filled.first);
        return;
    }
    if (time.is_xrun) {
        analysis_->loosen_clock();
    }
    // A block without any of the file's sound moves no stream time: the clock stops until there is.
    if (filled.has_sound) {
        analysis_->mark_clock(filled.first, time.entered);
    } else {
        analysis_->stop_clock(filled.first);
    }
    analysis_->add_callback_time(host_now() - start);
}

}  // namespace raks::engine
