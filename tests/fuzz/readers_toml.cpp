// What is done with texts that are TOML.
#include <array>
#include <string>

#include "audio/genre/tag_evidence.hpp"
#include "audio/music/styles/style_book_reader.hpp"
#include "base/dance_list.hpp"
#include "engine/setup/desktop_calm.hpp"
#include "engine/setup/device_offsets.hpp"
#include "engine/setup/presets.hpp"
#include "engine/setup/settings.hpp"
#include "engine/setup/window_memory.hpp"
#include "motion/choreography/authored_dance.hpp"
#include "motion/choreography/figure_evaluation.hpp"
#include "motion/choreography/figure_measures.hpp"
#include "motion/figures/figure_grammar.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "render/scene/theme.hpp"
#include "tests/fuzz/promise.hpp"
#include "tests/fuzz/readers.hpp"

namespace raks::fuzz {
bool read_settings(std::string_view text) {
    engine::Settings settings;
    if (!engine::parse_settings(text, "x.toml", settings)) {
        return false;
    }
    engine::Settings again;
    must(engine::parse_settings(engine::to_toml(settings), "y.toml", again).has_value());
    return true;
}

bool read_devices(std::string_view text) {
    const auto offsets = engine::DeviceOffsets::parse(text, "x.toml");
    must(!offsets || engine::DeviceOffsets::parse(offsets->to_toml(), "y.toml"));
    return offsets.has_value();
}

bool read_preset(std::string_view text) {
    const auto loaded = engine::parse_preset(text, "x.toml");
    if (!loaded) {
        must_be_one_line(loaded.error().message);
        return false;
    }
    const auto again = engine::parse_preset(engine::toml_of(loaded->preset), "y.toml");
    must(again && again->preset == loaded->preset);
    engine::Settings settings;
    engine::apply_preset(*loaded, settings);
    must(engine::validate(settings).empty());
    return true;
}

bool read_theme(std::string_view text) {
    const auto theme = render::parse_theme(text, "x", "x.toml");
    if (!theme) {
        must_be_one_line(theme.error().message);
        return false;
    }
    must(theme->exposure >= 0.05F && theme->exposure <= 10.0F);
    must(theme->beams.count >= 0 && theme->beams.count <= 12);
    for (const glm::vec3& colour : {theme->floor_centre, theme->key_light, theme->drop_tint}) {
        must(colour.x >= 0.0F && colour.y >= 0.0F && colour.z >= 0.0F);
        must(colour.x + colour.y + colour.z <= 30.0F);
    }
    return true;
}

bool read_window_memory(std::string_view text) {
    const auto loaded = engine::parse_window_memory(text, "x.toml");
    if (!loaded) {
        must_be_one_line(loaded.error().message);
        return false;
    }
    const std::string written = engine::toml_of(loaded->memory);
    const auto again = engine::parse_window_memory(written, "y.toml");
    must(again && engine::toml_of(again->memory) == written);
    engine::Settings settings;
    engine::apply_window_memory(*loaded, settings);
    must(engine::validate(settings).empty());
    return true;
}

bool read_kdeglobals(std::string_view text) { return engine::calm_in_kdeglobals(text).has_value(); }

bool read_dances(std::string_view text) {
    const auto dances = parse_dances(text, "x.toml", {});
    must(!dances || parse_dances(dances_text(*dances), "y.toml", {}));
    return dances.has_value();
}

bool read_genre_words(std::string_view text) {
    constexpr std::array<std::string_view, 7> kNames = {
        "salsa", "belly", "house", "hiphop", "rock", "waltz", "disco"};
    const auto words = audio::parse_genre_words(text, "x.toml", kNames);
    // The text as tags, too, whatever it is.
    const audio::TagEvidence evidence =
        audio::evidence_of({.genre = text, .title = text}, words ? *words : audio::GenreWords());
    for (const auto& [dance, strength] : evidence.dances) {
        must(strength > 0.0F && strength <= audio::kGenreTagStrength);
    }
    return words.has_value();
}

bool read_grammar(std::string_view text) {
    static_cast<void>(motion::figures_in_grammar(text, "x.toml"));
    const auto grammar = motion::parse_grammar(text, "x.toml");
    if (!grammar) {
        return false;
    }
    for (const auto& rule : grammar->rules) {
        must(rule.after.size() == grammar->rules.size());
    }
    return true;
}

bool read_styles(std::string_view text) {
    const audio::StyleText file{"x.toml", std::string(text)};
    return audio::parse_styles({&file, 1}, "the styles").has_value();
}

bool read_choreography(std::string_view text) {
    const auto dance = motion::parse_authored_dance(text, "x.toml");
    if (!dance) {
        return false;
    }
    for (const motion::AuthoredFigure& figure : dance->figures) {
        motion::EvaluationOptions options;
        options.written = options.tempo = dance->written;
        options.repeats = 2;
        options.frames_per_second = 30.0;
        const auto danced = motion::evaluate_figure(figure, motion::mannequin_skeleton(), options);
        must(!danced.poses.empty());
    }
    return true;
}

}  // namespace raks::fuzz
