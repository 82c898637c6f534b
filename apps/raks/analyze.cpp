#include "apps/raks/commands.hpp"

#include <cstdio>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/dances/known_dances.hpp"
#include "apps/raks/sound_pipe.hpp"
#include "apps/reports/analysis_document.hpp"
#include "apps/reports/plot_svg.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "audio/beat/paper_beat.hpp"
#include "audio/genre/music_tagger.hpp"
#include "audio/io/audio_file.hpp"
#include "audio/music_analyzer.hpp"
#include "base/pending_file.hpp"
#include "base/printable.hpp"
#include "engine/offline/last_hops.hpp"
#include "engine/offline/music_source.hpp"
#include "engine/setup/analyzer_setup.hpp"
#include "engine/setup/dance_files.hpp"
#include "engine/setup/play_list.hpp"
#include "engine/setup/told_genre.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Passes on the states whose moment lies inside the file; the silence after it makes more of them.
class Collect final : public audio::MusicAnalyzer::Sink {
 public:
    Collect(AnalysisDocument& document, PlotData* plot) : document_(document), plot_(plot) {}
    void on_state(const MusicState& state) noexcept override {
        if (state.time < end) {
            document_.add(state);
            if (plot_ != nullptr) {
                plot_->add(state);
            }
        }
        newest = state.time;
    }
    StreamTime end = StreamTime::max();
    StreamTime newest{Nanos(-1)};

 private:
    AnalysisDocument& document_;
    PlotData* plot_;  // may be null
};

// The tagger, which also keeps what it said of each patch.
class KeepTags final : public audio::TagSource {
 public:
    KeepTags(std::shared_ptr<const audio::TaggerNetwork> network, AnalysisDocument& document)
        : tagger_(std::move(network)), document_(document) {}
    void hear(const audio::TaggerHop& hop) noexcept RAKS_NONBLOCKING override {
        tagger_.hear(hop);
        const audio::TaggerWord& word = tagger_.word();
        if (word.patches > 0 && word.until != said_) {
            said_ = word.until;
            // No thread of ours is in a hurry where a whole file is analyzed.
            RAKS_TRUSTED(document_.add_tags(word));
        }
    }
    [[nodiscard]] const audio::TaggerWord& word() noexcept RAKS_NONBLOCKING override {
        return tagger_.word();
    }

 private:
    audio::HopTagger tagger_;
    AnalysisDocument& document_;
    StreamTime said_{};
};

// The streaming method; paper_whole runs the paper's streaming method beside, for tempo and genre.
audio::BeatMethod streaming_method(FileBeatMethod method) {
    const bool is_pointer = method == FileBeatMethod::pointer || method == FileBeatMethod::whole;
    return is_pointer ? audio::BeatMethod::pointer : audio::BeatMethod::paper;
}

// Everything that gets the file's samples, and what is drawn in the end.
struct Analyses {
    audio::MusicAnalyzer analyzer;
    std::optional<audio::SongAnalyzer> song;          // --beat whole: instead of `analyzer`
    std::optional<audio::PaperFile> whole;            // --beat paper-whole
    std::optional<PlotData> plot;                     // --plot
    std::optional<std::vector<BeatEvent>> reference;  // --reference: beats to draw beside
    std::optional<PendingFile> plot_file;  // written under another name until it is complete
};

// Checks and opens all that is asked for before the analysis, which may take long.
Expected<void> prepare(const AnalyzeArguments& arguments,
                       const Path& input,
                       SampleRate rate,
                       const engine::AnalyzerModels& models,
                       std::shared_ptr<audio::TagSource> tags,
                       Analyses& to) {
    // A plot that cannot be written is noticed at once.
    if (!arguments.plot.empty()) {
        if (arguments.plot.extension() != ".svg") {
            return fail(arguments.plot.string() + ": a plot is written as .svg");
        }
        const std::vector<Path> read = {input, arguments.reference};
        if (auto checked = check_is_no_input(arguments.plot, read); !checked) {
            return checked;
        }
        auto file = PendingFile::create(arguments.plot);
        if (!file) {
            return fail(std::move(file.error()));
        }
        to.plot_file = std::move(*file);
        if (auto prepared = to.plot.emplace().prepare(rate); !prepared) {
            return prepared;
        }
    }
    if (!arguments.reference.empty()) {
        auto beats = read_reference_beats(arguments.reference);
        if (!beats) {
            return fail(std::move(beats.error()));
        }
        to.reference = std::move(*beats);
    }
    if (arguments.beat == FileBeatMethod::paper_whole) {
        if (auto prepared = to.whole.emplace().prepare(rate); !prepared) {
            return prepared;
        }
    }
    if (arguments.beat == FileBeatMethod::whole) {
        auto song = engine::make_song_analyzer(rate, models, std::move(tags));
        if (!song) {
            return fail(std::move(song.error()));
        }
        to.song.emplace(std::move(*song));
        return {};
    }
    auto analyzer =
        engine::make_analyzer(rate, models, streaming_method(arguments.beat), std::move(tags));
    if (!analyzer) {
        return fail(std::move(analyzer.error()));
    }
    to.analyzer = std::move(*analyzer);
    return {};
}

// Analyzes the whole file, and then as much silence as brings out the last hops.
void analyze_source(engine::MusicSource& source, Analyses& analyses, Collect& collect) {
    ProgressLine progress("analyzing");
    for (auto block = source.next(); !block.mono.empty() && !stop_signal(); block = source.next()) {
        if (analyses.song) {
            analyses.song->process(block.mono);
        } else {
            analyses.analyzer.process(block.mono, collect);
        }
        if (analyses.whole) {
            analyses.whole->add(block.mono);
        }
        if (analyses.plot) {
            analyses.plot->add(block.mono);
        }
        // Not every file says how long it is: then no progress is shown.
        if (const auto share = source.progress()) {
            progress.show(*share);
        }
    }
    // From here on states beyond the file's end are dropped.
    collect.end = StreamTime(source.given());
    if (analyses.song) {
        for (const MusicState& state : analyses.song->finish().states) {
            collect.on_state(state);
        }
        return;
    }
    engine::bring_last_hops_out(analyses.analyzer, source.rate(), collect.end, collect);
}

// As the plot names the method.
const char* description_of(FileBeatMethod method) {
    switch (method) {
        case FileBeatMethod::pointer:
            return "bar pointer, streaming";
        case FileBeatMethod::whole:
            return "bar pointer, whole file";
        case FileBeatMethod::paper:
            return "the paper's method, streaming";
        case FileBeatMethod::paper_whole:
            return "the paper's method, whole file";
    }
    return "";
}

// Draws the plot into its temporary file and gives it its name.
Expected<void> write_plot(const AnalyzeArguments& arguments,
                          const Path& input,
                          Analyses& analyses,
                          Nanos duration) {
    analyses.plot->finish(duration);
    const auto svg = draw_plot(*analyses.plot,
                               {.title = printable(input.filename().string(), 200),
                                .method = description_of(arguments.beat),
                                .reference = std::move(analyses.reference)});
    if (!svg) {
        return fail(svg.error());
    }
    auto wrote = analyses.plot_file->write(*svg);
    return wrote ? analyses.plot_file->commit() : wrote;
}

// A file, or what comes through a pipe.
Expected<engine::MusicSource> open_source(const Path& input) {
    if (!engine::is_pipe(input)) {
        return engine::MusicSource::open(input);
    }
    auto pipe = open_sound_pipe(input);
    if (!pipe) {
        return fail(pipe.error());
    }
    return engine::MusicSource::of(std::move(*pipe));
}

// The document of one file, as text or as JSON. Errors: those of the file and of the plot.
Expected<std::string> analyze_one(const AnalyzeArguments& arguments,
                                  const Path& input,
                                  const engine::AnalyzerModels& models) {
    auto source = open_source(input);
    if (!source) {
        return fail(source.error());
    }
    // The last class of the model's posterior.
    std::vector<std::string> genres = models.genres->genres;
    genres.emplace_back("unknown");
    AnalysisDocument document(input.string(), source->rate(), std::move(genres));
    document.set_told(engine::told_by(models, source->tags(), input));
    std::shared_ptr<audio::TagSource> tags;
    if (models.tagger) {
        document.expect_tags();
        tags = std::make_shared<KeepTags>(models.tagger, document);
    }
    Analyses analyses;
    if (auto prepared = prepare(arguments,
                                input,
                                source->rate(),
                                engine::told(models, source->tags(), input),
                                std::move(tags),
                                analyses);
        !prepared) {
        return fail(std::move(prepared.error()));
    }
    Collect collect(document, analyses.plot ? &*analyses.plot : nullptr);
    analyze_source(*source, analyses, collect);
    // The method with the whole file before it replaces the streaming beats, in both outputs.
    if (analyses.whole) {
        auto beats = analyses.whole->finish(source->given());
        if (analyses.plot) {
            analyses.plot->replace_beats(beats);
        }
        document.replace_beats(std::move(beats));
    }
    if (!source->warning().empty()) {
        say(source->warning());
    }
    if (analyses.plot) {
        if (auto written = write_plot(arguments, input, analyses, source->given()); !written) {
            return fail(std::move(written.error()));
        }
    }
    return arguments.as_json ? document.to_json(source->given())
                             : document.to_text(source->given());
}

// Of one file its own document. Of several one document around theirs, which come as they are
// ready: memory does not grow with their number.
class Output {
 public:
    Output(bool is_json, bool has_several) : is_json_(is_json), has_several_(has_several) {
        if (is_set()) {
            std::fputs("{\"format\":\"raks-analyses\",\"version\":1,\"files\":[", stdout);
        }
    }
    void add(std::string_view document) {
        if (has_several_ && count_ > 0) {
            // JSON has a comma between two, text an empty line.
            std::fputs(is_json_ ? ",\n" : "\n", stdout);
        }
        if (is_set() && document.ends_with('\n')) {
            document.remove_suffix(1);
        }
        ++count_;
        if (is_json_) {
            print_json(document);
        } else {
            print_text(document);
        }
    }
    void finish(const engine::SkippedFiles& skipped) {
        if (is_set()) {
            const std::string rest = fmt::format("],\"skipped\":{}}}\n", skipped.count());
            std::fputs(rest.c_str(), stdout);
        }
    }
    [[nodiscard]] std::size_t count() const noexcept { return count_; }

 private:
    [[nodiscard]] bool is_set() const noexcept { return is_json_ && has_several_; }

    bool is_json_;
    bool has_several_;
    std::size_t count_ = 0;
};

}  // namespace

ExitCode analyze(const AnalyzeArguments& arguments) {
    auto list = engine::read_play_list(arguments.inputs);
    if (!list) {
        return fail(list.error());
    }
    const bool has_several = list->files.size() > 1;
    if (has_several && !arguments.plot.empty()) {
        return fail(arguments.plot.string() + ": a plot shows one file; name one");
    }
    // One file that is no music is said before the models are loaded.
    if (!has_several && !engine::is_pipe(list->files.front())) {
        if (const auto file = audio::open_audio_file(list->files.front()); !file) {
            return fail(file.error());
        }
    }
    const auto models = load_models_of_known_dances(engine::genre_aids_of(arguments.settings));
    if (!models) {
        return fail(models.error());
    }
    if (!models->tagger_note.empty()) {
        say(models->tagger_note);
    }
    Output output(arguments.as_json, has_several);
    for (const Path& input : list->files) {
        if (stop_signal()) {
            break;
        }
        const auto document = analyze_one(arguments, input, *models);
        if (document) {
            output.add(*document);
        } else if (!has_several) {
            return fail(document.error());
        } else {
            list->skipped.add(document.error().message);
        }
    }
    output.finish(list->skipped);
    for (const std::string& line : list->skipped.report()) {
        complain(line);
    }
    return list->skipped.count() == 0 ? kExitDone : output.count() == 0 ? kExitFailed : kExitPartly;
}

}  // namespace raks::apps
