// The written dances as they are danced from their models: what each file expects holds there, too.
#include "engine/figure_alone.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

TEST(WrittenFigures, close_their_hands_as_written) {
    const auto library = load_dance("rock", motion::DanceRole::lead, DanceForm());
    ASSERT_TRUE(library) << library.error().message;
    const std::vector<std::string_view> names = (*library)->figure_names();
    const auto bend_of = [&](std::string_view figure) {
        FigureOnBeat on;
        on.tempo = Bpm(138.0);
        on.figure =
            static_cast<std::size_t>(std::find(names.begin(), names.end(), figure) - names.begin());
        const double beats[] = {1.0};
        const auto poses = dance_alone(*library, on, beats);
        return poses ? std::abs((*poses)[0].rotation(motion::Bone::left_middle_proximal).z) : -1.0F;
    };
    EXPECT_GT(bend_of("pogo"), 0.5F);  // a fist: over 60 degrees
    EXPECT_LT(bend_of("step_clap"), 0.2F);
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
