#include "apps/reports/music_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "apps/reports/analysis_document.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "audio/music_analyzer.hpp"
#include "audio/song/song_plan.hpp"
#include "tests/base/source_tree.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace raks::apps {
namespace {

class Collect final : public audio::MusicAnalyzer::Sink {
 public:
    void on_state(const MusicState& state) noexcept override { states.push_back(state); }
    std::vector<MusicState> states;
};

const audio::GeneratedMusic& song() {
    static const audio::GeneratedMusic music = [] {
        audio::MusicPlan plan;
        plan.style = audio::Style::four_on_the_floor;
        plan.tempo = {{0.0, 124.0}};
        plan.seconds = 40.0;
        plan.channels = 1;
        plan.form = *audio::parse_form("full:32,breakdown:16,stop:4,drop:16,ending:8");
        return *audio::generate(plan);
    }();
    return music;
}

// As it comes, and known ahead.
const std::vector<std::vector<MusicState>>& both_ways() {
    static const std::vector<std::vector<MusicState>> ways = [] {
        const audio::AnalyzerConfig config{.sample_rate = song().rate};
        audio::MusicAnalyzer live;
        audio::SongAnalyzer ahead;
        EXPECT_TRUE(live.prepare(config));
        EXPECT_TRUE(ahead.prepare(config));
        Collect heard;
        live.process(song().samples, heard);
        ahead.process(song().samples);
        return std::vector{heard.states, ahead.finish().states};
    }();
    return ways;
}

bool is_told(const MusicRow& row, const MusicState& state) {
    return row.happens == nullptr || row.happens(state);
}

bool is_allowed(const MusicField& field, const MusicValue& value) {
    if (const auto* const number = std::get_if<double>(&value)) {
        return *number >= field.low && *number <= field.high;
    }
    if (const auto* const word = std::get_if<std::string_view>(&value)) {
        return std::find(field.words.begin(), field.words.end(), *word) != field.words.end();
    }
    return true;
}

// As docs/reference/files.md has the row.
std::string reference_of(const MusicRow& row) {
    constexpr std::array<const char*, 3> kWritten = {
        "twice a second", "at each change", "one by one"};
    std::string text = fmt::format("| `{}[]` | {}, {}: `time`",
                                   row.name,
                                   row.title,
                                   kWritten[static_cast<std::size_t>(row.written)]);
    for (const MusicField& field : row.used()) {
        text += fmt::format("; `{}`", field.key);
        if (!field.words.empty()) {
            text += fmt::format(" (`{}`)", fmt::join(field.words, "`, `"));
        } else if (std::holds_alternative<double>(field.value({})) && std::isfinite(field.high)) {
            text += fmt::format(" {:g}..{:g}", field.low, field.high);
        }
        text += field.unit.empty() ? "" : fmt::format(" {}", field.unit);
        text += field.what.empty() ? "" : fmt::format(": {}", field.what);
    }
    return text + " |\n";
}

TEST(MusicTable, all_that_states_say_is_in_its_range_live_and_known_ahead) {
    for (const auto& states : both_ways()) {
        for (const MusicState& state : states) {
            for (const MusicRow& row : kMusicTable) {
                for (const MusicField& field : row.used()) {
                    ASSERT_TRUE(!is_told(row, state) || is_allowed(field, field.value(state)))
                        << row.name << '.' << field.key << " at hop " << state.hop;
                }
            }
        }
    }
}

// Neither the analyzer nor the second pass over a whole song loses a field.
TEST(MusicTable, every_row_says_something_live_and_known_ahead) {
    for (const auto& states : both_ways()) {
        for (const MusicRow& row : kMusicTable) {
            const bool says = std::any_of(states.begin(), states.end(), [&](const auto& state) {
                return is_told(row, state) &&
                       row.fields.front().value(state) != row.fields.front().value(MusicState());
            });
            EXPECT_EQ(says, states.front().ahead.is_known || !row.is_of_known_songs) << row.name;
        }
    }
}

TEST(MusicTable, the_document_has_every_row_with_its_fields) {
    AnalysisDocument document("song", song().rate, std::vector<std::string>(kMostGenres + 1, "x"));
    for (const MusicState& state : both_ways().back()) {
        document.add(state);
    }
    const auto json = nlohmann::ordered_json::parse(document.to_json(std::chrono::seconds(40)));
    for (const MusicRow& row : kMusicTable) {
        ASSERT_FALSE(json[std::string(row.name)].empty()) << row.name;
        for (const auto& entry : json[std::string(row.name)]) {
            std::vector<std::string> keys;
            for (const auto& [key, value] : entry.items()) {
                keys.push_back(key);
            }
            std::vector<std::string> wanted = {"time"};
            for (const MusicField& field : row.used()) {
                wanted.emplace_back(field.key);
            }
            ASSERT_EQ(keys, wanted) << row.name;
        }
    }
}

TEST(MusicTable, has_each_name_and_key_once) {
    std::set<std::string_view> names;
    for (const MusicRow& row : kMusicTable) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        std::set<std::string_view> keys = {"time"};
        for (const MusicField& field : row.used()) {
            EXPECT_TRUE(keys.insert(field.key).second) << row.name << '.' << field.key;
        }
    }
}

TEST(MusicTable, is_what_the_reference_of_files_says) {
    const std::string text = test::source_text(test::kSourceTree / "docs/reference/files.md");
    std::string wanted;
    for (const MusicRow& row : kMusicTable) {
        wanted += reference_of(row);
    }
    EXPECT_NE(text.find(wanted), std::string::npos)
        << "docs/reference/files.md should have these rows one after the other:\n"
        << wanted;
}

}  // namespace
}  // namespace raks::apps
