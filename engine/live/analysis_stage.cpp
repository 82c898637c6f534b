#include "engine/live/analysis_stage.hpp"

#include <algorithm>
#include <utility>

#include "base/decibels.hpp"
#include "engine/live/tagger_thread.hpp"
#include "engine/setup/analyzer_setup.hpp"

namespace raks::engine {
namespace {

// A meter falls slowly enough to be read: IEC 60268-10 type I, 20 dB in 1.7 s.
constexpr float kMeterFallPerSecond = 20.0F / 1.7F;
constexpr float kFloorDbfs = -120.0F;
// The longest that a device takes for a block, nearly: a meter without sound for longer falls.
constexpr Nanos kBlockPatience = std::chrono::milliseconds(300);

// RMS level of a block in dBFS; the floor of -120 dBFS keeps silence finite.
float level_of(std::span<const float> mono) noexcept {
    return static_cast<float>(decibels_of_power(std::max(mean_square(mono), 1e-12)));
}

}  // namespace

Expected<std::unique_ptr<AnalysisStage>> AnalysisStage::create(SampleRate rate,
                                                               const AnalyzerModels& models) {
    // Tagging a patch takes longer than a callback may: on a thread of its own.
    std::shared_ptr<audio::TagSource> tags;
    if (models.tagger) {
        tags = std::make_shared<TaggerThread>(models.tagger);
    }
    auto analyzer = make_analyzer(rate, models, audio::BeatMethod::pointer, std::move(tags));
    if (!analyzer) {
        return fail(analyzer.error());
    }
    return std::unique_ptr<AnalysisStage>(new AnalysisStage(rate, std::move(*analyzer)));
}

AnalysisStage::AnalysisStage(SampleRate rate, audio::MusicAnalyzer analyzer)
    : rate_(rate), analyzer_(std::move(analyzer)) {}

void AnalysisStage::analyze(std::span<const float> mono) noexcept RAKS_NONBLOCKING {
    // Subnormal numbers, which filters produce in silence, are slow on the processor.
    const FlushToZeroScope flush_to_zero;
    // Commands first, so that one which is due takes effect within this block.
    take_news();
    run_commands();
    analyzer_.process(mono, queue_);
    const float seconds = static_cast<float>(mono.size()) / static_cast<float>(rate_.hertz());
    // The meter rises at once and falls at a fixed rate per second of audio, not per block.
    const HostTime now = host_now();
    const float fallen = level_dbfs(now) - seconds * kMeterFallPerSecond;
    // relaxed: a meter, written here alone; a reader may see one of the two a block earlier.
    level_dbfs_.store(std::max(level_of(mono), fallen), std::memory_order_relaxed);
    level_at_ns_.store(now.time_since_epoch().count(), std::memory_order_relaxed);
    // release: pairs with the acquire in taken_until().
    frames_taken_.fetch_add(static_cast<std::int64_t>(mono.size()), std::memory_order_release);
}

float AnalysisStage::level_dbfs(HostTime now) const noexcept RAKS_NONBLOCKING {
    // relaxed: see analyze()
    const Nanos at(level_at_ns_.load(std::memory_order_relaxed));
    const Nanos still = std::max(now.time_since_epoch() - at - kBlockPatience, Nanos(0));
    const float fall = static_cast<float>(to_seconds(still)) * kMeterFallPerSecond;
    return std::max(level_dbfs_.load(std::memory_order_relaxed) - fall, kFloorDbfs);
}

void AnalysisStage::pass_on(std::span<const float> interleaved,
                            std::size_t channels) noexcept RAKS_NONBLOCKING {
    for (const std::atomic<SoundTap*>& place : taps_) {
        // acquire: pairs with the release in set_tap().
        if (SoundTap* const tap = place.load(std::memory_order_acquire)) {
            tap->put(taken_until(), rate_, interleaved, channels);
        }
    }
}

void AnalysisStage::mark_clock(StreamTime stream, HostTime host) noexcept RAKS_NONBLOCKING {
    clock_map_.update(stream, host);
    publish_clock();
}

// Each reader gets the whole line at once, never half of an update.
void AnalysisStage::publish_clock() noexcept {
    clock_line_.write(clock_map_.line());
    feed_->set_clock(clock_map_.line());
}

void AnalysisStage::stop_clock(StreamTime stream) noexcept RAKS_NONBLOCKING {
    // A pause calls this with every block; only the first call changes anything.
    if (clock_map_.line().is_running) {
        clock_map_.stop(stream);
        publish_clock();
    }
}

void AnalysisStage::skip(std::int64_t frames) noexcept RAKS_NONBLOCKING {
    // The analyzer advances its grid over the gap; the sample count must advance by the same.
    analyzer_.skip(rate_.time_of(frames).time_since_epoch());
    frames_taken_.fetch_add(frames, std::memory_order_release);  // see analyze()
}

// Counted from the first of them on: samples of a hop need not be a whole number.
void AnalysisStage::pass_blind_hop() noexcept RAKS_NONBLOCKING {
    take_news();
    run_commands();
    const StreamTime taken = taken_until();
    // Less than a sample apart: this hop follows the one before.
    const bool is_next = taken - blind_until_ < rate_.time_of(1).time_since_epoch();
    blind_until_ = (is_next ? blind_until_ : taken) + kHop;
    analyzer_.skip(kHop);
    analyzer_.process({}, queue_);
    frames_taken_.store(rate_.index_at(blind_until_), std::memory_order_release);  // see analyze()
}

Expected<void> AnalysisStage::change_rate(SampleRate rate) {
    const StreamTime taken = taken_until();
    if (auto changed = analyzer_.change_rate(rate, taken); !changed) {
        return changed;
    }
    rate_ = rate;
    frames_taken_.store(rate.index_at(taken), std::memory_order_release);  // see analyze()
    return {};
}

StreamTime AnalysisStage::taken_until() const noexcept RAKS_NONBLOCKING {
    return rate_.time_of(frames_taken_.load(std::memory_order_acquire));  // see analyze()
}

void AnalysisStage::take_news() noexcept {
    // At most as many as the queue holds: bounded, as the audio thread needs.
    SongNews news{};
    while (news_.pop(news)) {
        switch (news.kind) {
            case SongNews::Kind::told:
                analyzer_.tell(news.song);
                break;
            case SongNews::Kind::begins:
                analyzer_.tell(news.song);
                analyzer_.begin_song();
                break;
            case SongNews::Kind::jump:
                analyzer_.skip(Nanos(0));
                break;
            case SongNews::Kind::pause:
                analyzer_.announce_pause();
                break;
            case SongNews::Kind::known:
                planned_.follow(*news.plan, taken_until(), news.shift);
                break;
            case SongNews::Kind::unknown:
                planned_.leave();
                break;
        }
    }
}

void AnalysisStage::run_commands() noexcept {
    // At most as many as the queue holds: bounded, as the audio thread needs.
    audio::AnalyzerCommand command{};
    while (commands_.pop(command)) {
        // Whoever sets beats by hand leads, until the tempo is given back to the music.
        planned_.let_person_lead(command.kind != audio::AnalyzerCommand::Kind::release_tempo);
        analyzer_.command(command);
    }
}

}  // namespace raks::engine
