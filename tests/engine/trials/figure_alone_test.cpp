// The written dances as they are danced from their models: what each file expects holds there, too.
#include "engine/trials/figure_alone.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>

#include "engine/setup/dance_files.hpp"
#include "tests/engine/installed.hpp"
#include "tests/support/dances.hpp"

#include <glm/geometric.hpp>

namespace raks::engine {
namespace {

/// A dance of its written figures, also where takes of people are danced otherwise.
Expected<std::shared_ptr<const motion::DanceLibrary>> written_library(std::string_view dance) {
    DanceForm form;
    form.material = Material::written;
    return load_dance(
        installed::dances(), dance, motion::mannequin_skeleton(), motion::DanceRole::lead, form);
}

TEST(WrittenFigures, dance_as_their_files_expect) {
    std::size_t figures = 0;
    for (const auto& file : test::written_dances()) {
        const std::string dance = file.stem();
        const auto library = written_library(dance);
        ASSERT_TRUE(library) << library.error().message;
        const auto danced = danced_written_figures(dance, *library, motion::mannequin_skeleton());
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
    EXPECT_GE(figures, 30U);
}

/// Two repeats of a figure, 16 poses a beat.
std::vector<motion::WorldPose> danced_at(const char* dance, std::string_view figure, double bpm) {
    const auto library = written_library(dance);
    std::vector<motion::WorldPose> poses;
    if (!library) {
        ADD_FAILURE() << library.error().message;
        return poses;
    }
    const std::vector<std::string_view> names = (*library)->figure_names();
    FigureOnBeat on;
    on.figure =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), figure) - names.begin());
    on.tempo = Bpm(bpm);
    std::vector<double> beats;
    // Twelve bars, since each repeat is danced in a way of its own.
    for (int i = 0; i < 48 * 16; ++i) {
        beats.push_back(i / 16.0);
    }
    const auto danced = dance_alone(*library, motion::mannequin_skeleton(), on, beats);
    if (!danced) {
        ADD_FAILURE() << danced.error().message;
        return poses;
    }
    for (const motion::Pose& pose : *danced) {
        poses.push_back(world_pose(motion::mannequin_skeleton(), pose));
    }
    return poses;
}

template <typename Value>
double range_of(const std::vector<motion::WorldPose>& poses, const Value& value) {
    double least = 1e9;
    double most = -1e9;
    for (const motion::WorldPose& pose : poses) {
        const auto here = static_cast<double>(value(pose));
        least = std::min(least, here);
        most = std::max(most, here);
    }
    return most - least;
}

TEST(WrittenFigures, step_less_far_in_faster_music) {
    const auto step = [](double bpm) {
        return range_of(danced_at("hiphop", "two_step", bpm), [](const motion::WorldPose& pose) {
            return pose.position(motion::Bone::left_foot).x;
        });
    };
    const double written = step(96.0);
    EXPECT_NEAR(step(115.0) / written, std::pow(96.0 / 115.0, 0.7), 0.04);
    EXPECT_NEAR(step(85.0) / written, 1.0, 0.03) << "slower: as learnt";
}

TEST(WrittenFigures, jump_less_high_in_faster_music) {
    const auto jump = [](double bpm) {
        return range_of(danced_at("rock", "pogo", bpm), [](const motion::WorldPose& pose) {
            return std::min(pose.position(motion::Bone::left_toes).y,
                            pose.position(motion::Bone::right_toes).y);
        });
    };
    const double written = jump(138.0);
    EXPECT_GT(written, 0.07);
    // Not wholly the square: the first centimetre over the floor is no jump yet.
    EXPECT_NEAR(jump(165.0) / written, std::pow(138.0 / 165.0, 2.0), 0.1);
}

TEST(WrittenFigures, clap_at_every_clap_and_any_tempo) {
    const auto palm = [](const motion::WorldPose& pose, motion::Side side) {
        return 0.5F * (pose.position(on_side(motion::Bone::left_hand, side)) +
                       pose.position(on_side(motion::Bone::left_middle_proximal, side)));
    };
    for (const double bpm : {104.0, 138.0, 165.0}) {
        const std::vector<motion::WorldPose> poses = danced_at("rock", "step_clap", bpm);
        for (const int clap : {1, 3, 5, 7}) {
            float least = 1e9F;
            for (int i = 16 * clap - 3; i <= 16 * clap + 3; ++i) {
                const motion::WorldPose& pose = poses[static_cast<std::size_t>(i)];
                least = std::min(
                    least,
                    glm::distance(palm(pose, motion::Side::left), palm(pose, motion::Side::right)));
            }
            EXPECT_LT(least, 0.075F) << "beat " << clap << " at " << bpm;
            EXPECT_GT(least, 0.02F) << "hands in one another";
        }
    }
}

TEST(WrittenFigures, close_their_hands_as_written) {
    const auto library = load_dance(installed::dances(), "rock", motion::mannequin_skeleton());
    ASSERT_TRUE(library) << library.error().message;
    const std::vector<std::string_view> names = (*library)->figure_names();
    const auto bend_of = [&](std::string_view figure) {
        FigureOnBeat on;
        on.tempo = Bpm(138.0);
        on.figure =
            static_cast<std::size_t>(std::find(names.begin(), names.end(), figure) - names.begin());
        const double beats[] = {1.0};
        const auto poses = dance_alone(*library, motion::mannequin_skeleton(), on, beats);
        return poses ? std::abs((*poses)[0].rotation(motion::Bone::left_middle_proximal).z) : -1.0F;
    };
    EXPECT_GT(bend_of("pogo"), 0.5F);  // a fist: over 60 degrees
    EXPECT_LT(bend_of("step_clap"), 0.2F);
}

TEST(WrittenFigures, a_captured_dance_has_none) {
    const auto library = load_dance(installed::dances(), "salsa", motion::mannequin_skeleton());
    ASSERT_TRUE(library) << library.error().message;
    const auto danced = danced_written_figures("salsa", *library, motion::mannequin_skeleton());
    ASSERT_TRUE(danced) << danced.error().message;
    EXPECT_TRUE(danced->empty());
}

}  // namespace
}  // namespace raks::engine
