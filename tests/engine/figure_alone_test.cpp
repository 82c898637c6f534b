// The written dances as they are danced from their models: what each file expects holds there, too.
#include "engine/figure_alone.hpp"

#include <gtest/gtest.h>

#include "engine/dance_files.hpp"

namespace raks::engine {
namespace {

TEST(WrittenFigures, dance_as_their_files_expect) {
    std::size_t figures = 0;
    for (const char* const dance : {"belly", "hiphop", "house", "rock", "waltz"}) {
        const auto library = load_dance(dance, motion::DanceRole::lead, DanceForm());
        ASSERT_TRUE(library) << library.error().message;
        const auto danced = danced_written_figures(dance, *library);
        ASSERT_TRUE(danced) << danced.error().message;
        for (const DancedWrittenFigure& figure : *danced) {
            ++figures;
            for (const std::string& fault : figure.faults) {
                ADD_FAILURE() << fault;
            }
            // People's repeats of the basic lie 8 to 15 cm apart.
            EXPECT_GT(figure.measures.repeat_distance, 0.06) << figure.name;
            EXPECT_LT(figure.measures.repeat_distance, 0.14) << figure.name;
            EXPECT_LT(figure.measures.slip_p90, 0.027) << figure.name;
        }
    }
    EXPECT_EQ(figures, 28U);
}

TEST(WrittenFigures, a_captured_dance_has_none) {
    const auto library = load_dance("salsa", motion::DanceRole::lead, DanceForm());
    ASSERT_TRUE(library) << library.error().message;
    const auto danced = danced_written_figures("salsa", *library);
    ASSERT_TRUE(danced) << danced.error().message;
    EXPECT_TRUE(danced->empty());
}

}  // namespace
}  // namespace raks::engine
