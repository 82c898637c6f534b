#include "tests/fuzz/readers.hpp"

#include <algorithm>

namespace raks::fuzz {

std::span<const Reader> readers() {
    static const std::vector<Reader> all = {
        {"settings", read_settings, {"config/default.toml"}, 300},
        {"devices", read_devices, {}, 300},
        {"dances", read_dances, {"models/trained/dances.toml"}, 300},
        {"grammar", read_grammar, {"models/trained/salsa.toml", "models/trained/belly.toml"}, 300},
        {"styles", read_styles, {"config/styles/palettes.toml"}, 60},
        {"choreography",
         read_choreography,
         {"config/choreographies/waltz.toml", "config/choreographies/rock.toml"},
         20},
        {"figure_angles", read_figure, {"models/trained/salsa_basic_lead.json"}, 8},
        {"figure_positions", read_figure, {"models/trained/salsa_basic_lead_positions.json"}, 8},
        {"genre", read_genre, {"models/trained/genres.json"}, 4},
        {"beats", read_beats, {"models/trained/beats.json"}, 2},
        {"labels", read_labels, {}, 300},
        {"counts", read_counts, {}, 300},
        {"faults", read_faults, {}, 300},
        {"index", read_index, {}, 300},
        {"beat_list", read_beat_list, {}, 300},
        {"playlist", read_playlist, {}, 300},
    };
    return all;
}

const Reader* reader_named(std::string_view name) {
    const auto all = readers();
    const auto found = std::find_if(
        all.begin(), all.end(), [name](const Reader& reader) { return reader.name == name; });
    return found != all.end() ? &*found : nullptr;
}

}  // namespace raks::fuzz
