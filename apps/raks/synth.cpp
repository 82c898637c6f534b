#include "apps/raks/commands.hpp"

#include <array>
#include <string>
#include <string_view>

#include "audio/evaluate/event_corpus.hpp"
#include "audio/io/wav_writer.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "base/pending_file.hpp"
#include "base/suggest.hpp"
#include "engine/setup/dance_catalogue.hpp"

#include <fmt/format.h>

namespace raks::apps {

namespace {

// What to play, and how fast by itself.
struct Music {
    audio::Style style;
    Bpm tempo;
};

// The style of this name, or the style of the dance of this name; without a name, that of the first
// dance. Errors: neither a style nor a dance, or a dance without a style.
Expected<Music> music_of(const std::string& name) {
    // Styles first: dances are only loaded when they are needed.
    if (const auto style = audio::style_from_name(name)) {
        return Music{*style, audio::usual_tempo(*style)};
    }
    const auto catalogue = engine::DanceCatalogue::load();
    if (!catalogue) {
        return fail(catalogue.error());
    }
    const DanceList& dances = *catalogue->list();
    const DanceInfo* const dance =
        name.empty() ? &dances.all().front() : dances.find(dances.id_of(name));
    if (dance == nullptr) {
        // Both kinds of names can be suggested.
        std::vector<std::string_view> known = dances.names();
        const auto styles = audio::style_names();
        known.insert(known.end(), styles.begin(), styles.end());
        return fail(unknown_name("style", name, known));
    }
    if (dance->style.empty()) {
        return fail(dance->name +
                    ": no style of our own music fits it; name one in its dances.toml");
    }
    const auto style = audio::style_from_name(dance->style);
    if (!style) {
        return fail(style.error());
    }
    return Music{*style, dance->likely};
}

// One beat a line: seconds, and its place in the bar.
std::string text_of(const std::vector<audio::ReferenceBeat>& beats) {
    std::string text;
    for (const audio::ReferenceBeat& beat : beats) {
        text += fmt::format("{:.6f}\t{}\n", to_seconds(beat.time), beat.bar_position);
    }
    return text;
}

// "steady", "song" or sections with their beats, as the form of this plan.
Expected<std::vector<audio::FormSection>> form_of(const std::string& form,
                                                  const audio::MusicPlan& plan) {
    if (form == "steady") {
        return std::vector<audio::FormSection>{};
    }
    if (form == "song") {
        return audio::song_form_of(plan);
    }
    if (form.find(':') == std::string::npos) {
        constexpr std::array<std::string_view, 2> kForms{"steady", "song"};
        return fail(unknown_name("--form", form, kForms) + ", or sections such as full:32,stop:4");
    }
    auto sections = audio::parse_form(form);
    if (!sections) {
        return fail(std::move(sections.error()).in("--form"));
    }
    return sections;
}

// Block by block: an hour would not fit into the memory of small machines.
ExitCode write_music(const audio::MusicPlan& plan, const SynthArguments& arguments) {
    auto file = audio::WavWriter::create(
        arguments.output, audio::frames_of(plan), plan.channels, plan.rate);
    if (!file) {
        return fail(file.error());
    }
    Expected<void> wrote;
    const auto truth = audio::generate(plan, [&](std::span<const float> samples) {
        wrote = file->write(samples);
        return wrote.has_value();
    });
    if (!truth) {
        return fail(wrote ? truth.error() : wrote.error());
    }
    if (auto written = file->commit(); !written) {
        return fail(written.error());
    }
    if (!arguments.beats.empty()) {
        if (auto written = write_file(arguments.beats, text_of(truth->beats)); !written) {
            return fail(written.error());
        }
    }
    if (!arguments.events.empty()) {
        if (auto written = write_file(arguments.events, audio::events_text(truth->events));
            !written) {
            return fail(written.error());
        }
    }
    return kExitDone;
}

}  // namespace

ExitCode synth(const SynthArguments& arguments) {
    if (arguments.output.extension() != ".wav") {
        return fail(arguments.output.string() + ": cannot write this kind of sound; known: .wav");
    }
    // All files can be written, or none is.
    for (const Path& file : {arguments.output, arguments.beats, arguments.events}) {
        if (auto checked = file.empty() ? Expected<void>() : check_output(file, {}); !checked) {
            return fail(checked.error());
        }
    }
    const auto what = music_of(arguments.style);
    if (!what) {
        return fail(what.error());
    }
    // All but these are the generator's defaults.
    audio::MusicPlan plan;
    plan.style = what->style;
    plan.tempo = {{0.0, arguments.bpm > 0.0 ? arguments.bpm : what->tempo.bpm()}};
    plan.seconds = arguments.seconds;
    plan.seed = static_cast<std::uint64_t>(arguments.seed);
    auto form = form_of(arguments.form, plan);
    if (!form) {
        return fail(std::move(form.error()));
    }
    plan.form = std::move(*form);
    return write_music(plan, arguments);
}

}  // namespace raks::apps
