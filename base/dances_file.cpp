// Reading and writing dances.toml.
#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <utility>

#include "base/dance_list.hpp"
#include "base/file.hpp"
#include "base/toml_reader.hpp"

#include <fmt/format.h>

namespace raks {
namespace {

constexpr std::string_view kDancesFormat = "raks-dances";
constexpr std::int64_t kDancesVersion = 1;
constexpr NumberRange kTempi{20.0, 400.0};  // BPM

// Reads one file. Goes on after a fault with harmless values; `complaints_` keeps the first.
class DancesReader {
 public:
    DancesReader(std::string file, const std::vector<std::string_view>& styles)
        : complaints_(std::move(file)), styles_(styles) {}

    Expected<DancesFile> read(const toml::table& root) {
        constexpr std::array<std::string_view, 4> kKeys = {"format", "version", "pair", "dance"};
        complaints_.check_head(root, kDancesFormat, kDancesVersion);
        complaints_.check_keys(root, kKeys);
        DancesFile file;
        const toml::array* const dances = root["dance"].as_array();
        if (dances == nullptr || dances->empty()) {
            complaints_.complain("needs at least one [[dance]]");
        } else {
            for (const toml::node& node : *dances) {
                file.dances.push_back(read_dance(node));
            }
        }
        file.pair = texts(root, "pair");
        if (!file.pair.empty() && file.pair.size() != 2) {
            complaints_.complain(root, "pair must be two names of dances");
        }
        if (!complaints_.is_sound()) {
            return fail(complaints_.fault());
        }
        return file;
    }

 private:
    // A list of texts; empty where the key is missing.
    std::vector<std::string> texts(const toml::table& table, std::string_view key) {
        std::vector<std::string> texts;
        const toml::node* const node = table.get(key);
        if (node == nullptr) {
            return texts;
        }
        const toml::array* const array = node->as_array();
        if (array == nullptr) {
            complaints_.complain(*node, fmt::format("{} must be [\"...\", ...]", key));
            return texts;
        }
        for (const toml::node& one : *array) {
            if (!one.is_string()) {
                complaints_.complain(one, fmt::format("{} must hold texts in quotes", key));
            }
            texts.push_back(one.value_or(std::string()));
        }
        return texts;
    }

    DanceInfo read_dance(const toml::node& node) {
        DanceInfo dance;
        const toml::table* const table = node.as_table();
        if (table == nullptr) {
            complaints_.complain(node, "a dance must be a [[dance]] table");
            return dance;
        }
        constexpr std::array<std::string_view, 14> kKeys = {"name",
                                                            "title",
                                                            "beats_per_bar",
                                                            "tempo",
                                                            "likely_tempo",
                                                            "roles",
                                                            "style",
                                                            "dress",
                                                            "labels",
                                                            "trials",
                                                            "fallback",
                                                            "people_jerk_rms",
                                                            "people_jerk_p999",
                                                            "extends"};
        complaints_.check_keys(*table, kKeys);
        // A dance that extends another needs no name of its own: it takes the other's.
        dance.extends = complaints_.text(*table, "extends");
        if (!dance.extends.empty() && !is_dance_name(dance.extends)) {
            complaints_.complain(node, "extends: " + why_no_dance_name(dance.extends));
        }
        dance.name = table->contains("name") ? complaints_.text(*table, "name") : dance.extends;
        if (!is_dance_name(dance.name)) {
            complaints_.complain(node, "name: " + why_no_dance_name(dance.name));
        }
        // Names are unique within a file.
        if (!names_.insert(dance.name).second) {
            complaints_.complain(node, fmt::format("dance \"{}\" is there twice", dance.name));
        }
        dance.title = table->contains("title") ? complaints_.text(*table, "title") : dance.name;
        dance.beats_per_bar = whole(*table, "beats_per_bar", {2.0, 12.0}, dance.beats_per_bar);
        dance.roles = whole(*table, "roles", {1.0, 2.0}, dance.roles);
        dance.labels = texts(*table, "labels");
        read_tempi(*table, dance);
        read_jerk(*table, "people_jerk_rms", dance.people_jerk_rms);
        read_jerk(*table, "people_jerk_p999", dance.people_jerk_p999);
        if (const toml::node* const fallback = table->get("fallback"); fallback != nullptr) {
            if (!fallback->is_boolean()) {
                complaints_.complain(*fallback, "fallback must be true or false");
            }
            dance.is_fallback = fallback->value_or(false);
        }
        // Before it is compared, because an empty text stands for a missing key.
        const std::string trials = complaints_.text(*table, "trials");
        if (!trials.empty() && trials != "brief" && trials != "full") {
            complaints_.complain(*table->get("trials"), "trials must be \"brief\" or \"full\"");
        }
        dance.trials = trials == "full" ? DanceInfo::Trials::full : DanceInfo::Trials::brief;
        dance.dress = complaints_.text(*table, "dress");
        dance.style = complaints_.text(*table, "style");
        // Without a list of styles every name passes.
        const bool is_known =
            styles_.empty() || dance.style.empty() ||
            std::find(styles_.begin(), styles_.end(), dance.style) != styles_.end();
        if (!is_known) {
            complaints_.complain(*table->get("style"), unknown_name("style", dance.style, styles_));
        }
        return dance;
    }

    // [lead, follow], m/s^3.
    void read_jerk(const toml::table& table, std::string_view key, std::array<double, 2>& jerk) {
        if (const toml::node* const node = table.get(key)) {
            jerk = complaints_.numbers<2>(*node, key, {0.0, 1e6}, "[lead, follow] in m/s^3");
        }
    }

    // The likely tempo defaults to the middle of the range and must lie within it.
    void read_tempi(const toml::table& table, DanceInfo& dance) {
        if (const toml::node* const tempo = table.get("tempo")) {
            const auto range =
                complaints_.numbers<2>(*tempo, "tempo", kTempi, "[lowest, highest] in BPM");
            if (range[0] > range[1]) {
                complaints_.complain(
                    *tempo,
                    fmt::format(
                        "tempo is [{}, {}], the lowest must come first", range[0], range[1]));
            }
            dance.lowest = Bpm(range[0]);
            dance.highest = Bpm(range[1]);
            dance.likely = Bpm(0.5 * (range[0] + range[1]));
        }
        if (const toml::node* const likely = table.get("likely_tempo")) {
            dance.likely = Bpm(complaints_.number(
                *likely, "likely_tempo", {dance.lowest.bpm(), dance.highest.bpm()}));
        }
    }

    // Only TOML integers: 4.0 is refused, too.
    int whole(const toml::table& table, std::string_view key, NumberRange range, int otherwise) {
        const toml::node* const node = table.get(key);
        if (node == nullptr) {
            return otherwise;
        }
        if (!node->is_integer()) {
            complaints_.complain(*node, fmt::format("{} must be a whole number", key));
            return otherwise;
        }
        return static_cast<int>(complaints_.number(*node, key, range));
    }

    TomlComplaints complaints_;
    const std::vector<std::string_view>& styles_;
    std::set<std::string> names_;
};

/// A text as a basic string of TOML. Control characters become spaces.
std::string toml_string(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            out += '\\';
        }
        out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return out + "\"";
}

// An array of TOML strings on one line.
std::string list_text(const std::vector<std::string>& texts) {
    std::string out;
    for (const std::string& text : texts) {
        out += (out.empty() ? "" : ", ") + toml_string(text);
    }
    return "[" + out + "]";
}

}  // namespace

Expected<DancesFile> parse_dances(std::string_view toml,
                                  const std::string& file,
                                  const std::vector<std::string_view>& styles) {
    const auto root = parse_toml(toml, file);
    return root ? DancesReader(file, styles).read(*root) : fail(root.error());
}

Expected<DancesFile> load_dances(const std::filesystem::path& file,
                                 const std::vector<std::string_view>& styles) {
    auto text = read_text_file(file, kLongestToml);
    if (!text) {
        return fail(std::move(text.error()));
    }
    return parse_dances(*text, file.string(), styles);
}

std::string dance_text(const DanceInfo& dance) {
    std::string text = fmt::format("\n[[dance]]\nname = {}\n", toml_string(dance.name));
    // A dance that extends another has no data of its own.
    if (!dance.extends.empty()) {
        return text + fmt::format("extends = {}\n", toml_string(dance.extends));
    }
    text += fmt::format(
        "title = {}\nbeats_per_bar = {}\ntempo = [{}, {}]\nlikely_tempo = {}\nroles = {}\n",
        toml_string(dance.title),
        dance.beats_per_bar,
        dance.lowest.bpm(),
        dance.highest.bpm(),
        dance.likely.bpm(),
        dance.roles);
    // The keys below are written only where they differ from their default.
    if (!dance.style.empty()) {
        text += fmt::format("style = {}\n", toml_string(dance.style));
    }
    if (!dance.dress.empty()) {
        text += fmt::format("dress = {}\n", toml_string(dance.dress));
    }
    if (!dance.labels.empty()) {
        text += fmt::format("labels = {}\n", list_text(dance.labels));
    }
    if (dance.is_fallback) {
        text += "fallback = true\n";
    }
    if (dance.trials == DanceInfo::Trials::full) {
        text += "trials = \"full\"\n";
    }
    if (dance.people_jerk_rms != DanceInfo{}.people_jerk_rms) {
        text += fmt::format("people_jerk_rms = [{}]\n", fmt::join(dance.people_jerk_rms, ", "));
    }
    if (dance.people_jerk_p999 != DanceInfo{}.people_jerk_p999) {
        text += fmt::format("people_jerk_p999 = [{}]\n", fmt::join(dance.people_jerk_p999, ", "));
    }
    return text;
}

std::string dances_text(const DancesFile& file) {
    std::string text =
        fmt::format("format = \"{}\"\nversion = {}\n", kDancesFormat, kDancesVersion);
    if (!file.pair.empty()) {
        text += fmt::format("pair = {}\n", list_text(file.pair));
    }
    for (const DanceInfo& dance : file.dances) {
        text += dance_text(dance);
    }
    return text;
}

}  // namespace raks
