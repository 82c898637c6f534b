#pragma once

#include <optional>

#include "apps/terminal/completion.hpp"
#include "apps/terminal/manual_page.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"

namespace raks::apps {

/// What a program is asked for by others, not by people: its manual, when Raks is built; what may
/// stand next on a command line, by shells. The exit code to end with; nothing: go on.
[[nodiscard]] inline std::optional<int> asked_of_table(const CLI::App& program,
                                                       int argc,
                                                       const char* const* argv) {
    if (const auto wish = manual_wish(argc, argv)) {
        const auto written = write_manual(program, wish->folder, wish->tree);
        if (!written) {
            complain(written.error().message);
        }
        return written ? kExitDone : kExitFailed;
    }
    if (const auto words = words_to_complete(argc, argv)) {
        const auto any_file = [](const CLI::Option&, Candidates& candidates) {
            candidates.has_files = true;
        };
        print_json(text_of(complete(program, *words, any_file)));
        return kExitDone;
    }
    return std::nullopt;
}

}  // namespace raks::apps
