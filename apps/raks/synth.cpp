#include "apps/raks/commands.hpp"

#include "audio/io/audio_file.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "base/suggest.hpp"
#include "engine/setup/dance_catalogue.hpp"

namespace raks::apps {

namespace {

// The style of this name, or the style of the dance of this name; without a name, that of the first
// dance. Errors: neither a style nor a dance, or a dance without a style.
Expected<audio::Style> style_of(const std::string& name) {
    // Styles first: dances are only loaded when they are needed.
    if (const auto style = audio::style_from_name(name)) {
        return style;
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
    return audio::style_from_name(dance->style);
}

}  // namespace

ExitCode synth(const SynthArguments& arguments) {
    if (arguments.output.extension() != ".wav") {
        return fail(arguments.output.string() + ": cannot write this kind of sound; known: .wav");
    }
    const auto style = style_of(arguments.style);
    if (!style) {
        return fail(style.error());
    }
    // All but these four are the generator's defaults.
    audio::MusicPlan plan;
    plan.style = *style;
    plan.tempo = {{0.0, arguments.bpm}};
    plan.seconds = arguments.seconds;
    plan.seed = static_cast<std::uint64_t>(arguments.seed);
    const auto music = audio::generate(plan);
    if (!music) {
        return fail(music.error());
    }
    if (auto written =
            audio::write_wav(arguments.output, music->samples, music->channels, music->rate);
        !written) {
        return fail(written.error());
    }
    return kExitDone;
}

}  // namespace raks::apps
