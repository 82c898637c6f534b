#include "engine/cli/commands.hpp"

#include <array>
#include <cstdio>
#include <utility>

#include "audio/beat/paper_file.hpp"
#include "audio/music_analyzer.hpp"
#include "engine/analysis_document.hpp"
#include "engine/cli/progress.hpp"
#include "engine/cli/signals.hpp"
#include "engine/music_source.hpp"

namespace raks::cli {
namespace {

/// Collects the states whose moment lies inside the file.
class Collect final : public audio::MusicAnalyzer::Sink {
 public:
    explicit Collect(engine::AnalysisDocument& document) : document_(document) {}
    void on_state(const MusicState& state) noexcept override {
        if (state.time < end) {
            document_.add(state);
        }
        newest = state.time;
    }
    StreamTime end = StreamTime::max();
    StreamTime newest{Nanos(-1)};

 private:
    engine::AnalysisDocument& document_;
};

audio::BeatMethod streaming_method(FileBeatMethod method) {
    return method == FileBeatMethod::pointer ? audio::BeatMethod::pointer
                                             : audio::BeatMethod::paper;
}

}  // namespace

ExitCode analyze(const AnalyzeArguments& arguments) {
    auto source = engine::MusicSource::open(arguments.input);
    if (!source) {
        return fail(source.error());
    }
    audio::MusicAnalyzer analyzer;
    audio::PaperFile whole;
    const bool is_whole = arguments.beat == FileBeatMethod::paper_whole;
    auto prepared = analyzer.prepare(
        {.sample_rate = source->rate(), .beat_method = streaming_method(arguments.beat)});
    if (prepared && is_whole) {
        prepared = whole.prepare(source->rate());
    }
    if (!prepared) {
        return fail(std::move(prepared.error()).in(arguments.input.string()));
    }
    engine::AnalysisDocument document(arguments.input.string(), source->rate());
    Collect collect(document);
    ProgressLine progress("analyzing");
    for (auto block = source->next(); !block.mono.empty() && !stop_signal();
         block = source->next()) {
        analyzer.process(block.mono, collect);
        if (is_whole) {
            whole.add(block.mono);
        }
        if (const auto share = source->progress()) {
            progress.show(*share);
        }
    }
    // Silence brings the last hops out; what it says beyond the file's end is not told.
    collect.end = StreamTime(source->given());
    const std::array<float, 256> silence{};
    for (Nanos fed{}; fed <= analyzer.delay() + kHop && collect.newest + kHop < collect.end;
         fed += source->rate().time_of(silence.size()).time_since_epoch()) {
        analyzer.process(silence, collect);
    }
    if (is_whole) {
        document.replace_beats(whole.finish(source->given()));
    }
    if (!source->warning().empty()) {
        std::fprintf(stderr, "raks: %s\n", source->warning().c_str());
    }
    const std::string text =
        arguments.as_json ? document.to_json(source->given()) : document.to_text(source->given());
    std::fwrite(text.data(), 1, text.size(), stdout);
    return kExitDone;
}

}  // namespace raks::cli
