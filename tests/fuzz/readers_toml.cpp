// What is done with texts that are TOML.
#include <string>

#include "audio/music/styles/style_book_reader.hpp"
#include "base/dance_list.hpp"
#include "engine/setup/device_offsets.hpp"
#include "engine/setup/settings.hpp"
#include "motion/choreography/authored_dance.hpp"
#include "motion/choreography/figure_evaluation.hpp"
#include "motion/choreography/figure_measures.hpp"
#include "motion/figures/figure_grammar.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "tests/fuzz/readers.hpp"

namespace raks::fuzz {

void read_settings(std::string_view text) {
    engine::Settings settings;
    if (engine::parse_settings(text, "x.toml", settings)) {
        // What was read can be written and read again.
        engine::Settings again;
        if (!engine::parse_settings(engine::to_toml(settings), "y.toml", again)) {
            __builtin_trap();
        }
    }
}

void read_devices(std::string_view text) {
    if (const auto offsets = engine::DeviceOffsets::parse(text, "x.toml")) {
        if (!engine::DeviceOffsets::parse(offsets->to_toml(), "y.toml")) {
            __builtin_trap();
        }
    }
}

void read_dances(std::string_view text) {
    if (const auto dances = parse_dances(text, "x.toml", {})) {
        if (!parse_dances(dances_text(*dances), "y.toml", {})) {
            __builtin_trap();
        }
    }
}

void read_grammar(std::string_view text) {
    if (const auto grammar = motion::parse_grammar(text, "x.toml")) {
        for (const auto& rule : grammar->rules) {
            if (rule.after.size() != grammar->rules.size()) {
                __builtin_trap();
            }
        }
    }
    static_cast<void>(motion::figures_in_grammar(text, "x.toml"));
}

void read_styles(std::string_view text) {
    const audio::StyleText file{"x.toml", std::string(text)};
    static_cast<void>(audio::parse_styles({&file, 1}, "the styles"));
}

void read_choreography(std::string_view text) {
    const auto dance = motion::parse_authored_dance(text, "x.toml");
    if (!dance) {
        return;
    }
    for (const motion::AuthoredFigure& figure : dance->figures) {
        motion::EvaluationOptions options;
        options.written = options.tempo = dance->written;
        options.repeats = 2;
        options.frames_per_second = 30.0;
        static_cast<void>(motion::evaluate_figure(figure, motion::mannequin_skeleton(), options));
    }
}

}  // namespace raks::fuzz
