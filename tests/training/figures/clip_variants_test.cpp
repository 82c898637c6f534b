// A figure that is learnt from one motion is the same, however its file describes it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "tests/motion/skeleton/clip_variants.hpp"
#include "tests/support/temporary_folder.hpp"
#include "training/figures/figure_trainer.hpp"
#include "training/figures/training_clip.hpp"

namespace raks::motion::clip_variants_test {
namespace {

/// All numbers of a figure's file, in order.
std::vector<double> numbers_of(const FigureModel& model) {
    const std::string text = figure_text(model);
    std::vector<double> numbers;
    for (std::size_t at = 0; at < text.size();) {
        const bool is_start = std::isdigit(static_cast<unsigned char>(text[at])) != 0 ||
                              (text[at] == '-' && at + 1 < text.size());
        char* end = nullptr;
        const double number = is_start ? std::strtod(text.c_str() + at, &end) : 0.0;
        if (is_start && end != text.c_str() + at) {
            numbers.push_back(number);
            at = static_cast<std::size_t>(end - text.c_str());
        } else {
            ++at;
        }
    }
    return numbers;
}

class ClipVariants : public ::testing::Test {
 protected:
    /// The numbers of a figure that is learnt from the clip as a file.
    std::vector<double> learnt(const MotionClip& clip) {
        const auto path = folder_.path() / "clip.bvh";
        std::ofstream(path) << bvh_text(clip);
        std::vector<std::string> warnings;
        const auto loaded = load_clip(path, ClipUnits{}, warnings);
        EXPECT_TRUE(loaded) << loaded.error().message;
        const std::vector<FigureRepeat> repeats = {{0, {5.0, 18.0, 31.0}}, {0, {31.0, 44.0, 57.0}}};
        FigureTrainingOptions options;
        options.name = options.dance = "x";
        options.beats = 2;
        options.samples_per_beat = 6;
        options.states = 4;
        const auto result = train_figure(std::vector<TrainingClip>{*loaded}, repeats, options);
        EXPECT_TRUE(result) << result.error().message;
        return numbers_of(result->model);
    }

    raks::test::TemporaryFolder folder_;
};

TEST_F(ClipVariants, have_their_unit_said_in_one_line) {
    // The second is none that is usual, which is doubtful.
    for (const double unit : {0.0254, 0.3}) {
        const auto path = folder_.path() / "clip.bvh";
        std::ofstream(path) << bvh_text(in_unit(own_dance(), unit));
        std::vector<std::string> warnings;
        ASSERT_TRUE(load_clip(path, ClipUnits{}, warnings));
        EXPECT_EQ(std::count_if(warnings.begin(),
                                warnings.end(),
                                [](const std::string& line) {
                                    return line.find("is taken for") != std::string::npos;
                                }),
                  1)
            << unit;
    }
}

TEST_F(ClipVariants, teach_the_same_figure) {
    const std::vector<double> expected = learnt(own_dance());
    ASSERT_GT(expected.size(), 500U);
    const std::vector<MotionClip> variants = {
        with_rest(own_dance(), RestVariant::a_pose_30),
        with_rest(own_dance(), RestVariant::sitting),
        with_rest(own_dance(), RestVariant::along_x),
        with_up(own_dance(), {0.0, 0.0, 1.0}, UpStyle::root_only),
        with_up(with_rest(own_dance(), RestVariant::n_pose), {1.0, 0.0, 0.0}, UpStyle::whole_file),
        in_unit(own_dance(), 0.0254)};
    for (std::size_t v = 0; v < variants.size(); ++v) {
        const std::vector<double> numbers = learnt(variants[v]);
        ASSERT_EQ(numbers.size(), expected.size()) << v;
        double most = 0.0;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            most = std::max(
                most, std::abs(numbers[i] - expected[i]) / std::max(1.0, std::abs(expected[i])));
        }
        // Poses are in single precision, which gives the last bit of rounding away.
        EXPECT_LT(most, 1e-6) << "variant " << v;
    }
}

}  // namespace
}  // namespace raks::motion::clip_variants_test
