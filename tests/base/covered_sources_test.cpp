// Each source of training/ and motion/dance/ has a test file of its name, or is covered by a test
// that is named here.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "tests/base/source_tree.hpp"

namespace raks {
namespace {

namespace fs = std::filesystem;
using test::kSourceTree;
using test::source_text;

/// Source -> suite and test by which it is covered.
const std::map<std::string, std::string> kCovered = {
    {"motion/dance/baking/arms.cpp", "RestoreArms, gives_back_the_lengths_and_keeps"},
    {"motion/dance/baking/contact_windows.cpp", "ContactWindows, close_short_gaps_and_drop"},
    {"motion/dance/baking/feature_pose.cpp", "PoseAtPlaces, gives_back_a_body_whose_joints"},
    {"motion/dance/baking/figure_passage.cpp", "DanceCache, gives_back_the_bits_that_were"},
    {"motion/dance/baking/flight.cpp", "Flight, takes_off_what_is_quick_and_leaves_rests"},
    {"motion/dance/baking/foot_lock.cpp", "Feet, do_not_skate"},
    {"motion/dance/baking/free_figure.cpp", "LowPass, keeps_dancing_and_takes_trembling"},
    {"motion/dance/baking/landing_delay.cpp", "Landing, is_on_the_beat_on_steady_music"},
    {"motion/dance/baking/variation.cpp", "DrawnTracks, every_kind_of_covariance_is_drawn"},
    {"motion/dance/beat_phase.cpp", "DancePhase, is_monotone_and_close_to_the_music"},
    {"motion/dance/body/elbow.cpp", "PartnerBody, arms_of_any_length_give_numbers"},
    {"motion/dance/body/limb_ik.cpp", "LegIk, reaches_the_target_and_keeps_bone_lengths"},
    {"motion/dance/content_file.cpp", "DanceCache, solves_anew_what_is_damaged"},
    {"motion/dance/cell_content.cpp", "TrainTake, a_take_is_danced_by_its_name"},
    {"motion/dance/cell_joins.cpp", "CellSequence, calm_manners_make_its_poses_smaller"},
    {"motion/dance/dynamics/breath.cpp", "Breath, raises_both_shoulders_alike_and_little"},
    {"motion/dance/dynamics/ending_gestures.cpp", "Waiting, every_ending_shows_and_comes_back"},
    {"motion/dance/dynamics/gesture.cpp", "Waiting, moves_smoothly"},
    {"motion/dance/dynamics/idle_gestures.cpp", "Waiting, each_dance_waits_in_its_own_way"},
    {"motion/dance/partner_clearance.cpp", "PartnerBody, hands_and_forearms_keep_a_centimetre"},
    {"motion/dance/partner_place.cpp", "PartnerPlace, brings_her_to_the_place_of_the_hold"},
    {"motion/dance/pose_join.cpp", "FigureSequence, all_figures_begin_and_end_on_the"},
    {"training/cells/cell_cutting.cpp", "CellTraining, "},
    {"training/cells/prepared_take.cpp", "CellTraining, "},
    {"training/cells/state_ties.cpp", "CellTraining, "},
    {"training/cells/grid_cues.cpp", "GridProposal, is_the_same_for_a_clip_of_another_rate"},
    {"training/cells/take_likeness.cpp", "GridProposal, finds_a_planted_loop"},
    {"training/cells/take_moments.cpp", "TakeMoments, mirrored_twice_are_the_same"},
    {"motion/dance/dance_content.cpp", "FigureSequence, all_figures_begin_and_end_on_the"},
    {"motion/dance/figure_places.cpp", "FigureSequence, two_half_turns_lead_back"},
    {"motion/dance/figure_sequence.cpp", "FigureSequence, two_half_turns_lead_back"},
    {"motion/dance/inertialization.cpp", "Inertialization, starts_where_it_was_and_ends"},
    {"motion/dance/standing.cpp", "Idle, stands_with_both_feet_on_the_floor"},
    {"motion/dancer_course.cpp", "Dynamics, a_dancer_stops_with_the_music_and_goes_on"},
    {"motion/dancer_state.cpp", "Dancer, never_jumps_also_when_the_music_does"},
    {"motion/dancer_stillness.cpp", "Dynamics, the_end_of_a_known_song_is_a_posture"},
    {"motion/figures/figure_grammar_text.cpp", "FigureGrammar, its_own_text_reads_back"},
    {"motion/figures/dance_habits_reader.cpp", "FigureGrammar, reads_what_dancers_do_beside"},
    {"training/beat/corpus.cpp", "TrainingFiles, a_kept_corpus_is_the_same_again"},
    {"training/figures/figure_classifier.cpp", "FitWeights, trusts_the_part_that_tells"},
    {"training/figures/figure_statistics.cpp", "FigureTrainer, learns_when_the_feet_rest"},
    {"training/figures/state_learning.cpp", "FigureTrainer, baum_welch_rounds_move_states"},
    {"training/figures/training_clip.cpp", "FigureTrainer, refuses_what_cannot_be_learnt"},
    {"training/genre/mfcc_trainer.cpp", "GenreTraining, tells_made_up_genres_apart"},
    {"training/genre/network_trainer.cpp", "GenreTraining, branches_give_the_mean_of_the"},
    {"training/genre/pattern_trainer.cpp", "GenreTraining, the_same_plan_gives_the_same"},
    {"training/genre/written_corpus.cpp", "WrittenMusic, "},
    {"training/hmm/hmm_statistics.cpp", "EveryCovariance, any_number_of_threads_gives"},
    {"training/networks/network_descent.cpp", "Adam, steps_are_those_of_the_equations"},
    {"training/networks/network_gradient.cpp", "NetworkTrainingLoss, gradient_is_that_of"},
};

TEST(CoveredSources, of_training_and_dance_have_a_test) {
    std::set<std::string> files;
    std::string tests;
    for (const auto& entry : fs::recursive_directory_iterator(kSourceTree / "tests")) {
        if (entry.path().extension() == ".cpp") {
            files.insert(entry.path().filename().string());
            tests += source_text(entry.path());
        }
    }
    std::size_t sources = 0;
    for (const char* const folder : {"training", "motion/dance"}) {
        for (const auto& entry : fs::recursive_directory_iterator(kSourceTree / folder)) {
            if (entry.path().extension() != ".cpp") {
                continue;
            }
            ++sources;
            const std::string name = fs::relative(entry.path(), kSourceTree).string();
            const bool has_own = files.contains(entry.path().stem().string() + "_test.cpp");
            const auto covered = kCovered.find(name);
            EXPECT_NE(has_own, covered != kCovered.end()) << name << ": one of both";
            if (covered != kCovered.end()) {
                EXPECT_NE(tests.find("(" + covered->second), std::string::npos)
                    << name << ": no test (" << covered->second;
            }
        }
    }
    EXPECT_GT(sources, 40U);
}

}  // namespace
}  // namespace raks
