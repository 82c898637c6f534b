#include "engine/setup/formations.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <thread>

#include "tests/engine/installed.hpp"

namespace raks::engine {
namespace {

Formations formations_of(const std::string& dance, const std::string& formation) {
    Settings settings;
    settings.dance = dance;
    settings.formation = formation;
    auto formations = Formations::load(settings, installed::dances(), motion::mannequin_skeleton());
    EXPECT_TRUE(formations) << formations.error().message;
    return std::move(*formations);
}

/// Polls until what was asked for is there, or cannot be: then the error.
std::string error_when_there(Formations& formations) {
    for (;;) {
        const auto is_there = formations.poll();
        if (!is_there) {
            return is_there.error().message;
        }
        if (*is_there) {
            return "";
        }
        std::this_thread::yield();
    }
}

TEST(Formations, begin_with_the_one_of_the_settings_and_go_round) {
    Formations formations = formations_of("salsa", "solo");
    EXPECT_EQ(formations.name(), "solo");
    EXPECT_EQ(formations.cast().members.size(), 1U);
    EXPECT_FALSE(formations.poll().value()) << "nobody asked";
    struct Case {
        const char* name;
        std::size_t members;
    };
    for (const Case& next : {Case{"couple", 2},
                             Case{"unison", 3},
                             Case{"canon", 3},
                             Case{"free", 3},
                             Case{"solo", 1},
                             Case{"couple", 2}}) {
        EXPECT_EQ(formations.ask_for_next(), next.name);
        EXPECT_EQ(error_when_there(formations), "") << next.name;
        EXPECT_EQ(formations.name(), next.name);
        EXPECT_EQ(formations.cast().members.size(), next.members) << next.name;
        EXPECT_EQ(formations.cast().members.front().part.is_in_couple, next.members == 2U);
        EXPECT_FALSE(formations.poll().value()) << "told once";
    }
    EXPECT_TRUE(formations.wait().empty());
}

TEST(Formations, without_couples_are_there_at_once) {
    Formations formations = formations_of("salsa", "unison");
    formations.ask_for_next();
    EXPECT_TRUE(formations.poll().value());
    EXPECT_EQ(formations.name(), "canon");
}

TEST(Formations, passed_over_while_they_load_are_not_told) {
    Formations formations = formations_of("salsa", "solo");
    EXPECT_EQ(formations.ask_for_next(), "couple");
    EXPECT_FALSE(formations.poll().value());
    EXPECT_EQ(formations.ask_for_next(), "unison");
    EXPECT_TRUE(formations.poll().value());
    EXPECT_EQ(formations.name(), "unison");
    EXPECT_TRUE(formations.wait().empty());
}

TEST(Formations, that_a_dance_has_not_are_told_once_and_the_dancers_stay) {
    Formations formations = formations_of("belly", "solo");
    formations.ask_for_next();
    EXPECT_EQ(error_when_there(formations),
              "formation couple: belly is danced alone; a couple dances salsa");
    EXPECT_EQ(formations.name(), "solo");
    EXPECT_EQ(formations.cast().members.size(), 1U);
    EXPECT_FALSE(formations.poll().value());
    EXPECT_EQ(formations.ask_for_next(), "unison");
    EXPECT_TRUE(formations.poll().value());
}

}  // namespace
}  // namespace raks::engine
