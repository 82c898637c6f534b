#include "engine/show/dress_by_dance.hpp"

#include <string>

#include <gtest/gtest.h>

namespace raks::engine {
namespace {

using render::Costume;

DanceList dances() {
    DanceInfo plain;
    plain.name = "plain";
    DanceInfo street;
    street.name = "street_dance";
    street.dress = "street";
    DanceInfo odd;
    odd.name = "odd";
    odd.dress = "pyja\nmas";
    return DanceList({plain, street, odd});
}
constexpr DanceId kPlain{0};
constexpr DanceId kStreet{1};
constexpr DanceId kOdd{2};

/// A show of which the tests say what is danced.
struct Danced {
    MusicState music{};
    motion::DancerStatus dancer{};
    void dance(DanceId id) {
        dancer.is_dancing = id != DanceId::none;
        dancer.dance = id;
    }
    [[nodiscard]] ShownMoment shown() const {
        return {.music = music, .dancer = dancer, .danced = {.tracks = {}, .moment = {}}};
    }
};

Look by_dance() {
    Look look;
    look.dresses_by_dance = true;
    return look;
}

TEST(DressByDance, knows_what_each_dance_asks_for) {
    const DanceList list = dances();
    EXPECT_EQ(costume_for(list, kStreet), Costume::street);
    EXPECT_EQ(costume_for(list, kPlain), Costume::unitard);
    EXPECT_EQ(costume_for(list, kOdd), Costume::unitard);
    EXPECT_FALSE(costume_for(list, DanceId::none));
}

TEST(DressByDance, says_in_one_line_which_dress_there_is_not) {
    const auto notes = dress_notes(dances());
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes[0].find("odd: there is no dress \"pyja"), std::string::npos) << notes[0];
    EXPECT_EQ(notes[0].find('\n'), std::string::npos);
}

TEST(DressByDance, changes_clothes_once_with_the_dance) {
    const DanceList list = dances();
    Danced show;
    show.music.genre = DanceId::none;
    DressByDance dress(by_dance());
    EXPECT_FALSE(dress.next(show.shown(), list));
    show.dance(kStreet);
    EXPECT_EQ(dress.next(show.shown(), list), Costume::street);
    EXPECT_FALSE(dress.next(show.shown(), list));
    show.dance(kPlain);
    EXPECT_EQ(dress.next(show.shown(), list), Costume::unitard);
}

TEST(DressByDance, wears_what_is_likely_before_the_first_dance_and_keeps_it_on_while_standing) {
    const DanceList list = dances();
    Danced show;
    show.music.genre = kStreet;
    DressByDance dress(by_dance());
    EXPECT_EQ(dress.next(show.shown(), list), Costume::street);
    // Who stands between two dances does not undress because the music is in doubt.
    show.music.genre = kPlain;
    EXPECT_FALSE(dress.next(show.shown(), list));
}

TEST(DressByDance, the_dance_that_is_asked_for_comes_before_what_is_heard) {
    const DanceList list = dances();
    Look look = by_dance();
    look.dance = "street_dance";
    Danced show;
    show.music.genre = kPlain;
    DressByDance dress(look);
    EXPECT_EQ(dress.next(show.shown(), list), Costume::street);
}

TEST(DressByDance, leaves_alone_who_has_chosen) {
    const DanceList list = dances();
    Danced show;
    show.dance(kStreet);
    DressByDance dress{Look{}};
    EXPECT_FALSE(dress.next(show.shown(), list));
}

TEST(DressByDance, dresses_a_look_for_a_dance_that_is_known_beforehand) {
    const DanceList list = dances();
    Look look = by_dance();
    look.avatars = {mannequin()};
    dress_for(list, "street_dance", look);
    EXPECT_EQ(look.costume, Costume::street);
    EXPECT_EQ(look.avatars.front().avatar->style.costume, Costume::street);
    Look chosen;
    dress_for(list, "street_dance", chosen);
    EXPECT_EQ(chosen.costume, Costume::unitard);
}

}  // namespace
}  // namespace raks::engine
