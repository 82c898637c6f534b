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
    auto formations =
        Formations::load(settings, installed::dances(), {motion::mannequin_skeleton()});
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
        if (*is_there != Formations::Change::none) {
            return "";
        }
        std::this_thread::yield();
    }
}

TEST(Formations, begin_with_the_one_of_the_settings_and_go_round) {
    Formations formations = formations_of("salsa", "solo");
    EXPECT_EQ(formations.name(), "solo");
    EXPECT_EQ(formations.cast().size(), 1U);
    EXPECT_EQ(formations.poll().value(), Formations::Change::none) << "nobody asked";
    struct Case {
        const char* name;
        std::size_t members;
    };
    for (const Case& next : {Case{"couple", 2},
                             Case{"unison", 3},
                             Case{"canon", 3},
                             Case{"free", 3},
                             Case{"grid", 6},
                             Case{"ring", 6},
                             Case{"v", 5},
                             Case{"solo", 1},
                             Case{"couple", 2}}) {
        EXPECT_EQ(formations.ask_for_next(), next.name);
        EXPECT_EQ(error_when_there(formations), "") << next.name;
        EXPECT_EQ(formations.name(), next.name);
        EXPECT_EQ(formations.cast().size(), next.members) << next.name;
        EXPECT_EQ(formations.cast().front().part.is_in_couple, next.members == 2U);
        EXPECT_EQ(formations.poll().value(), Formations::Change::none) << "told once";
    }
    EXPECT_TRUE(formations.wait().empty());
}

TEST(Formations, of_as_many_dancers_as_are_asked_for_go_round) {
    Settings settings;
    settings.dance = "salsa";
    settings.dancers = 8;
    auto loaded = Formations::load(settings, installed::dances(), {motion::mannequin_skeleton()});
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->name(), "grid");
    EXPECT_EQ(loaded->cast().size(), 8U);
    loaded->ask_for_next();
    EXPECT_EQ(error_when_there(*loaded), "");
    EXPECT_EQ(loaded->name(), "ring");
    EXPECT_EQ(loaded->cast().size(), 8U);
}

TEST(Formations, without_couples_are_there_at_once) {
    Formations formations = formations_of("salsa", "unison");
    formations.ask_for_next();
    EXPECT_EQ(formations.poll().value(), Formations::Change::formation);
    EXPECT_EQ(formations.name(), "canon");
}

TEST(Formations, passed_over_while_they_load_are_not_told) {
    Formations formations = formations_of("salsa", "solo");
    EXPECT_EQ(formations.ask_for_next(), "couple");
    EXPECT_EQ(formations.poll().value(), Formations::Change::none);
    EXPECT_EQ(formations.ask_for_next(), "unison");
    EXPECT_EQ(formations.poll().value(), Formations::Change::formation);
    EXPECT_EQ(formations.name(), "unison");
    EXPECT_TRUE(formations.wait().empty());
}

// "salsa, house": those that come with Raks.
std::string dances_of_couples() {
    std::string names;
    for (const DanceInfo& dance : installed::dances().list()->all()) {
        if (dance.roles == 2) {
            names += (names.empty() ? "" : ", ") + dance.name;
        }
    }
    return names;
}

TEST(Formations, that_a_dance_has_not_are_told_once_and_the_dancers_stay) {
    Formations formations = formations_of("belly", "solo");
    formations.ask_for_next();
    EXPECT_EQ(error_when_there(formations),
              "formation couple: belly is danced alone; a couple dances " + dances_of_couples());
    EXPECT_EQ(formations.name(), "solo");
    EXPECT_EQ(formations.cast().size(), 1U);
    EXPECT_EQ(formations.poll().value(), Formations::Change::none);
    EXPECT_EQ(formations.ask_for_next(), "unison");
    EXPECT_EQ(formations.poll().value(), Formations::Change::formation);
}

TEST(Formations, are_solved_for_another_body_while_the_dance_goes_on) {
    Formations formations = formations_of("salsa", "unison");
    motion::Skeleton body = motion::mannequin_skeleton();
    body.girth.trunk = 0.12F;
    formations.ask_for_bodies({body});
    EXPECT_EQ(formations.cast().front().body.skeleton, motion::mannequin_skeleton());
    EXPECT_EQ(error_when_there(formations), "");
    EXPECT_EQ(formations.name(), "unison");
    EXPECT_EQ(formations.cast().front().body.skeleton, body);
    EXPECT_EQ(formations.poll().value(), Formations::Change::none) << "told once";
    EXPECT_EQ(formations.ask_for_next(), "canon");
    EXPECT_EQ(formations.poll().value(), Formations::Change::formation) << "they share the dances";
    EXPECT_EQ(formations.cast().front().body.skeleton, body);
}

TEST(Formations, are_solved_for_each_of_several_bodies_once) {
    Formations formations = formations_of("auto", "unison");
    const motion::Skeleton& own = motion::mannequin_skeleton();
    motion::Skeleton other = own;
    other.girth.trunk = 0.12F;
    formations.ask_for_bodies({own, other});
    EXPECT_EQ(error_when_there(formations), "");
    const Cast cast = formations.cast();
    ASSERT_EQ(cast.size(), 3U);
    EXPECT_EQ(cast[0].body.skeleton, own);
    EXPECT_EQ(cast[1].body.skeleton, other);
    EXPECT_EQ(cast[2].body.skeleton, own);
    EXPECT_EQ(cast[0].body.repertoire, cast[2].body.repertoire);
    EXPECT_NE(cast[0].body.repertoire, cast[1].body.repertoire);
    EXPECT_TRUE(formations.wait().empty());
    for (std::size_t i = 0; i < installed::dances().list()->size(); ++i) {
        EXPECT_NE(cast[1].body.repertoire->of(static_cast<DanceId>(i)), nullptr) << i;
    }
}

TEST(Formations, of_a_couple_have_the_first_two_of_several_bodies) {
    Formations formations = formations_of("salsa", "couple");
    const motion::Skeleton& own = motion::mannequin_skeleton();
    motion::Skeleton other = own;
    motion::Skeleton third = own;
    other.girth.trunk = 0.12F;
    third.girth.trunk = 0.13F;
    formations.ask_for_bodies({own, other, third});
    EXPECT_EQ(error_when_there(formations), "");
    ASSERT_EQ(formations.cast().size(), 2U);
    EXPECT_EQ(formations.cast()[0].body.skeleton, own);
    EXPECT_EQ(formations.cast()[1].body.skeleton, other);
}

TEST(Formations, go_back_to_a_body_with_all_their_dances) {
    Formations formations = formations_of("auto", "solo");
    motion::Skeleton body = motion::mannequin_skeleton();
    body.girth.trunk = 0.12F;
    formations.ask_for_bodies({body});
    formations.ask_for_bodies({motion::mannequin_skeleton()});
    EXPECT_EQ(error_when_there(formations), "");
    EXPECT_EQ(formations.cast().front().body.skeleton, motion::mannequin_skeleton());
    EXPECT_TRUE(formations.wait().empty());
    const auto& dances = *installed::dances().list();
    for (std::size_t i = 0; i < dances.size(); ++i) {
        EXPECT_NE(formations.cast().front().body.repertoire->of(static_cast<DanceId>(i)), nullptr)
            << i;
    }
}

TEST(Formations, that_are_left_wait_for_one_dance_at_most) {
    Settings settings;
    settings.dance = "salsa";
    std::vector<motion::Skeleton> bodies;
    for (int i = 0; i < 32; ++i) {
        // Of no other test: nothing of them is kept.
        bodies.push_back(motion::mannequin_skeleton());
        bodies.back().girth.trunk += 1e-4F * static_cast<float>(i + 1);
    }
    const StopSolving stop;
    stop.ask();
    const auto stopped = Dancers::load(settings, installed::dances(), bodies, 1, stop);
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().message, "nobody waits for the dance any more");
    // Else this would take half a minute.
    Formations formations = formations_of("salsa", "grid");
    formations.ask_for_bodies(bodies);
    EXPECT_EQ(formations.poll().value(), Formations::Change::none);
    EXPECT_TRUE(formations.is_loading());
    // What is asked for meanwhile is served, and what was given up is no error.
    formations.ask_for_bodies({bodies.front()});
    EXPECT_EQ(error_when_there(formations), "");
    EXPECT_EQ(formations.cast().front().body.skeleton, bodies.front());
    formations.ask_for_bodies(bodies);
    EXPECT_EQ(formations.poll().value(), Formations::Change::none);
}

TEST(Formations, of_another_kind_are_solved_for_the_body_that_was_asked_for) {
    Formations formations = formations_of("salsa", "solo");
    motion::Skeleton body = motion::mannequin_skeleton();
    body.girth.trunk = 0.12F;
    formations.ask_for_bodies({body});
    EXPECT_EQ(formations.ask_for_next(), "couple");
    EXPECT_EQ(error_when_there(formations), "");
    EXPECT_EQ(formations.name(), "couple");
    EXPECT_EQ(formations.cast().front().body.skeleton, body);
}

TEST(Formations, go_on_as_they_are_where_the_dance_that_is_danced_is_not_solved_for_a_body) {
    Formations formations = formations_of("salsa", "solo");
    motion::Skeleton body = motion::mannequin_skeleton();
    body.girth.trunk = 0.12F;
    formations.ask_for_bodies({body});
    const DanceId other = installed::dances().list()->id_of("belly");
    while (formations.poll(other).value() == Formations::Change::none && formations.is_loading()) {
        std::this_thread::yield();
    }
    EXPECT_EQ(formations.cast().front().body.skeleton, motion::mannequin_skeleton());
    EXPECT_EQ(formations.poll().value(), Formations::Change::bodies);
}

}  // namespace
}  // namespace raks::engine
