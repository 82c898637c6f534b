#include "motion/figures/dance_mood_reader.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace raks::motion {
namespace {

TEST(DanceMood, is_read_from_the_head_of_a_dance) {
    const auto mood = parse_mood(
        "dance = \"salsa\"\nmood = { base = \"happy\", strength = 0.5, teeth = 1, brows = 0, "
        "away = 0.25, passing = { sad = 2, surprised = 0.5 } }\n",
        "x.toml");
    ASSERT_TRUE(mood) << mood.error().message;
    EXPECT_EQ(mood->base, Emotion::happy);
    EXPECT_EQ(mood->strength, 0.5F);
    EXPECT_EQ(mood->teeth, 1.0F);
    EXPECT_EQ(mood->brows, 0.0F);
    EXPECT_EQ(mood->away, 0.25F);
    EXPECT_EQ(mood->passing[static_cast<std::size_t>(Emotion::sad)], 2.0F);
    EXPECT_EQ(mood->passing[static_cast<std::size_t>(Emotion::happy)], 0.0F) << "not named";
}

TEST(DanceMood, is_the_default_where_nothing_is_said) {
    for (const char* const text : {"", "dance = \"salsa\"\n", "mood = {}\n"}) {
        const auto mood = parse_mood(text, "x.toml");
        ASSERT_TRUE(mood) << mood.error().message;
        EXPECT_EQ(*mood, DanceMood());
    }
}

TEST(DanceMood, that_is_mangled_is_refused_in_one_line) {
    for (const auto& [text, what] : std::vector<std::pair<std::string, std::string>>{
             {"mood = \"happy\"\n", "x.toml: line 1: mood: mood must be a table"},
             {"mood = { base = \"hapy\" }\n", "did you mean \"happy\"?"},
             {"mood = { bas = \"happy\" }\n", "did you mean \"base\"?"},
             {"mood = { strength = 2 }\n", "strength is 2, must be 0 to 1"},
             {"mood = { teeth = nan }\n", "teeth is nan, must be 0 to 1"},
             {"mood = { passing = [1, 2] }\n", "passing must be { emotion = how often, ... }"},
             {"mood = { passing = {} }\n", "passing must be { emotion = how often, ... }"},
             {"mood = { passing = { joy = 1 } }\n", "joy"},
             {"mood = { passing = { sad = -1 } }\n", "sad is -1, must be 0 to 100"}}) {
        const auto refused = parse_mood(text, "x.toml");
        ASSERT_FALSE(refused) << text;
        EXPECT_NE(refused.error().message.find(what), std::string::npos) << refused.error().message;
        EXPECT_EQ(refused.error().message.find('\n'), std::string::npos);
    }
}

}  // namespace
}  // namespace raks::motion
