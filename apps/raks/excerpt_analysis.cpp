#include "apps/raks/excerpt_analysis.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <future>
#include <optional>
#include <utility>

#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "audio/beat/paper_beat.hpp"
#include "audio/music_analyzer.hpp"
#include "engine/offline/last_hops.hpp"
#include "engine/offline/music_source.hpp"
#include "engine/setup/analyzer_setup.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Time between two looks at how far the workers are.
constexpr auto kBetweenLooks = std::chrono::milliseconds(100);

// To microseconds, as the document of `raks analyze` writes them: both must score the same.
double rounded_seconds(StreamTime time) { return std::round(to_seconds(time) * 1e6) / 1e6; }

// Collects beats and predictions of the states whose moment lies before `end`.
class NoteBeats final : public audio::MusicAnalyzer::Sink {
 public:
    void on_state(const MusicState& state) noexcept override {
        newest = state.time;
        if (state.time >= end) {
            return;
        }
        if (state.has_beat) {
            beats.push_back(state.beat);
        }
        if (state.has_predicted) {
            predicted.push_back(rounded_seconds(state.predicted));
        }
    }
    StreamTime end = StreamTime::max();
    StreamTime newest{Nanos(-1)};
    std::vector<BeatEvent> beats;
    std::vector<double> predicted;
};

// The paper's method knows no bars: a list without positions has no downbeat scores.
enum class Bars { told, not_told };
audio::BeatList list_of(const std::vector<BeatEvent>& beats, Bars bars) {
    audio::BeatList list;
    for (const BeatEvent& beat : beats) {
        list.times.push_back(rounded_seconds(beat.time));
        list.confidences.push_back(beat.confidence);
        if (bars == Bars::told) {
            list.bar_positions.push_back(beat.bar_position);
            list.bar_confidences.push_back(beat.bar_confidence);
        }
    }
    return list;
}

// Tracks with a streaming method; stops early after a signal.
Expected<audio::BeatEstimate> analyze_streaming(engine::MusicSource& source,
                                                audio::BeatMethod method,
                                                std::shared_ptr<const audio::BeatNetwork> network) {
    auto analyzer =
        // No genre model and no list of dances: beats do not need them.
        engine::make_analyzer(source.rate(), {std::move(network), nullptr, nullptr}, method);
    if (!analyzer) {
        return fail(std::move(analyzer.error()));
    }
    NoteBeats notes;
    for (auto block = source.next(); !block.mono.empty() && !stop_signal(); block = source.next()) {
        analyzer->process(block.mono, notes);
    }
    notes.end = StreamTime(source.given());
    engine::bring_last_hops_out(*analyzer, source.rate(), notes.end, notes);
    const Bars bars = method == audio::BeatMethod::pointer ? Bars::told : Bars::not_told;
    return audio::BeatEstimate{list_of(notes.beats, bars), std::move(notes.predicted)};
}

// Tracks by the plan of the whole song.
Expected<audio::BeatEstimate> analyze_song(engine::MusicSource& source,
                                           std::shared_ptr<const audio::BeatNetwork> network) {
    auto analyzer =
        engine::make_song_analyzer(source.rate(), {std::move(network), nullptr, nullptr});
    if (!analyzer) {
        return fail(std::move(analyzer.error()));
    }
    for (auto block = source.next(); !block.mono.empty() && !stop_signal(); block = source.next()) {
        analyzer->process(block.mono);
    }
    NoteBeats notes;
    for (const MusicState& state : analyzer->finish().states) {
        notes.on_state(state);
    }
    return audio::BeatEstimate{list_of(notes.beats, Bars::told), std::nullopt};
}

// Tracks with the paper's method that gets the whole file first.
Expected<audio::BeatEstimate> analyze_whole(engine::MusicSource& source) {
    audio::PaperFile paper;
    if (auto prepared = paper.prepare(source.rate()); !prepared) {
        return fail(std::move(prepared.error()));
    }
    for (auto block = source.next(); !block.mono.empty() && !stop_signal(); block = source.next()) {
        paper.add(block.mono);
    }
    return audio::BeatEstimate{list_of(paper.finish(source.given()), Bars::not_told), std::nullopt};
}

}  // namespace

Expected<ExcerptBeats> analyze_excerpt(const Path& audio,
                                       FileBeatMethod method,
                                       std::shared_ptr<const audio::BeatNetwork> network) {
    auto source = engine::MusicSource::open(audio);
    if (!source) {
        return fail(std::move(source.error()));
    }
    auto estimate =
        method == FileBeatMethod::paper_whole ? analyze_whole(*source)
        : method == FileBeatMethod::whole     ? analyze_song(*source, std::move(network))
        : method == FileBeatMethod::paper
            ? analyze_streaming(*source, audio::BeatMethod::paper, nullptr)
            : analyze_streaming(*source, audio::BeatMethod::pointer, std::move(network));
    // The file's name is part of the error, as many files are tracked.
    if (!estimate) {
        return fail(std::move(estimate.error()).in(audio.string()));
    }
    return ExcerptBeats{std::move(*estimate), source->warning()};
}

Expected<std::vector<std::optional<ExcerptBeats>>> analyze_excerpts(
    std::span<const audio::BeatExcerpt> excerpts,
    FileBeatMethod method,
    const std::vector<std::shared_ptr<const audio::BeatNetwork>>& networks,
    const std::string& what) {
    std::vector<std::optional<Expected<ExcerptBeats>>> analyzed(excerpts.size());
    std::atomic<std::size_t> next{0};
    std::atomic<std::size_t> done{0};
    // Workers take the next excerpt each; every excerpt has a slot of its own. relaxed: the
    // futures' get() orders the slots before they are read.
    const auto work = [&] {
        for (std::size_t i = next.fetch_add(1, std::memory_order_relaxed); i < excerpts.size();
             i = next.fetch_add(1, std::memory_order_relaxed)) {
            auto result = analyze_excerpt(excerpts[i].audio, method, networks[i]);
            if (stop_signal()) {
                return;  // the signal may have cut this excerpt short
            }
            analyzed[i] = std::move(result);
            done.fetch_add(1, std::memory_order_relaxed);
        }
    };
    ProgressLine progress(what);
    // Two workers; the results are the same for any number.
    std::array<std::future<void>, 2> workers = {std::async(std::launch::async, work),
                                                std::async(std::launch::async, work)};
    for (std::future<void>& worker : workers) {
        while (worker.wait_for(kBetweenLooks) == std::future_status::timeout) {
            progress.show(fmt::format(
                "{} of {} excerpts", done.load(std::memory_order_relaxed), excerpts.size()));
        }
        worker.get();
    }
    // In order, so that the first error does not depend on the threads.
    std::vector<std::optional<ExcerptBeats>> results;
    for (auto& result : analyzed) {
        if (result && !*result) {
            return fail(std::move(result->error()));
        }
        results.push_back(result ? std::optional(std::move(**result)) : std::nullopt);
    }
    return results;
}

}  // namespace raks::apps
