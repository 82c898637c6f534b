#include "apps/raks/commands.hpp"

#include "audio/io/audio_file.hpp"
#include "audio/music/generator/music_generator.hpp"

namespace raks::apps {

ExitCode synth(const SynthArguments& arguments) {
    if (arguments.output.extension() != ".wav") {
        return fail(arguments.output.string() + ": cannot write this kind of sound; known: .wav");
    }
    const auto style = audio::style_from_name(arguments.style);
    if (!style) {
        return fail(style.error());
    }
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
