#include "engine/live/loss_words.hpp"

#include <gtest/gtest.h>

namespace raks::engine {
namespace {

TEST(LossWords, count_what_happened_and_nothing_else) {
    EXPECT_EQ(losses_in_words({}), "");
    EXPECT_EQ(losses_in_words({.dropped_states = 0, .xruns = 1, .underruns = 0}),
              "1 gap in the sound");
    EXPECT_EQ(losses_in_words({.dropped_states = 1, .xruns = 2, .underruns = 1}),
              "2 gaps in the sound, 1 pause to read the file, 1 moment that the dancers missed");
    EXPECT_EQ(losses_in_words({.dropped_states = 7, .xruns = 0, .underruns = 3}),
              "3 pauses to read the file, 7 moments that the dancers missed");
}

}  // namespace
}  // namespace raks::engine
