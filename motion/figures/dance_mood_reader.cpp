#include "motion/figures/dance_mood_reader.hpp"

#include <array>
#include <cstddef>

#include "base/file.hpp"
#include "base/toml_reader.hpp"

namespace raks::motion {
namespace {

constexpr NumberRange kMoodShare{0.0, 1.0};
constexpr NumberRange kMoodWeight{0.0, 100.0};
constexpr std::size_t kMostMoodBytes = std::size_t{1} << 20U;
constexpr std::array<std::string_view, 6> kMoodKeys = {
    "base", "strength", "passing", "teeth", "brows", "away"};

void read_float(const toml::table& table,
                std::string_view key,
                NumberRange range,
                TomlComplaints& faults,
                float& target) {
    auto read = static_cast<double>(target);
    faults.read(table, key, range, read);
    target = static_cast<float>(read);
}

/// How often each emotion passes; those that are not named do not.
void read_passing(const toml::node& node, TomlComplaints& faults, DanceMood& mood) {
    const toml::table* const table = node.as_table();
    if (table == nullptr || table->empty()) {
        faults.complain(node, "passing must be { emotion = how often, ... }");
        return;
    }
    faults.check_keys(*table, kEmotionNames);
    mood.passing = {};
    for (std::size_t i = 0; i < kEmotionCount; ++i) {
        read_float(*table, kEmotionNames[i], kMoodWeight, faults, mood.passing[i]);
    }
}

DanceMood read_mood(const toml::node& node, TomlComplaints& faults) {
    DanceMood mood;
    const toml::table* const table = node.as_table();
    if (table == nullptr) {
        faults.complain(node, "mood must be a table, such as { base = \"happy\" }");
        return mood;
    }
    faults.check_keys(*table, kMoodKeys);
    if (const toml::node* const base = table->get("base")) {
        mood.base = static_cast<Emotion>(faults.word(*base, "emotion", kEmotionNames));
    }
    read_float(*table, "strength", kMoodShare, faults, mood.strength);
    read_float(*table, "teeth", kMoodShare, faults, mood.teeth);
    read_float(*table, "brows", kMoodShare, faults, mood.brows);
    read_float(*table, "away", kMoodShare, faults, mood.away);
    if (const toml::node* const passing = table->get("passing")) {
        read_passing(*passing, faults, mood);
    }
    return mood;
}

}  // namespace

Expected<DanceMood> parse_mood(std::string_view toml, const std::string& name) {
    const auto root = parse_toml(toml, name);
    if (!root) {
        return fail(root.error());
    }
    const toml::node* const node = root->get("mood");
    if (node == nullptr) {
        return DanceMood();
    }
    TomlComplaints faults(name);
    faults.enter("mood");
    const DanceMood mood = read_mood(*node, faults);
    if (!faults.is_sound()) {
        return fail(faults.fault());
    }
    return mood;
}

Expected<DanceMood> load_mood(const std::filesystem::path& path) {
    const auto text = read_text_file(path, kMostMoodBytes);
    if (!text) {
        return fail(text.error());
    }
    return parse_mood(*text, path.string());
}

}  // namespace raks::motion
