// The options of `raks train figure` and `raks train report`.
#include "apps/clips/body_options.hpp"
#include "apps/clips/joint_options.hpp"
#include "apps/raks_train/train_command_table.hpp"
#include "apps/raks_train/train_commands.hpp"
#include "apps/terminal/option_checks.hpp"

namespace raks::apps {

void add_train_figure(CommandTable& table) {
    auto [app, a] =
        table.add(table.app(), "figure", "learn a dance figure from motion", train_figure);
    app->add_option("clips", a->clips, "motion files, a folder of them, or a written X.toml")
        ->required();
    // Not required: a written dance has no labels, and repeats are found where nobody labelled
    // them.
    auto* labels =
        app->add_option("--labels", a->labels, "TSV: take, role, start, end, figure, ...");
    auto* propose =
        app->add_option("--propose", a->propose, "X.tsv: only find repeats; X.html shows them");
    app->add_option("--beats", a->beats, "beats of one repeat, or of a phrase, without labels")
        ->check(in_range(1, kLongestPhrase));
    auto* once = app->add_flag("--once", a->once, "each clip is one phrase, learnt as a whole")
                     ->excludes(labels)
                     ->excludes(propose);
    auto* bpm = app->add_option("--bpm", a->bpm, "tempo of such a phrase")
                    ->check(in_range(20.0, 400.0))
                    ->needs(once)
                    ->excludes("--beats");
    add_named_option(*app,
                     "--travel",
                     a->travel,
                     motion::kClipTravelNames,
                     "whether the dance leads where the clips do: file, or none");
    auto* counts = app->add_option("--counts", a->counts, "TSV: when each count falls");
    auto* music = app->add_option("--music", a->music, "music danced to: its beats are the counts");
    // Counts come from a table or from the music's beats, never from both.
    music->excludes(counts)->excludes(bpm);
    app->add_option("--offset", a->offset, "seconds of the music at a clip's first frame")
        ->check(in_range(-kLongestSeconds, kLongestSeconds))
        ->needs(music);
    app->add_option("--faults", a->faults, "TSV: stretches that the capture got wrong");
    app->add_option("--figure", a->figure, "which label, or figure of a dance, to learn");
    app->add_option("--dance", a->dance, "the dance that it belongs to");
    app->add_option("--extends", a->extends, "a dance that its figures join");
    app->add_option(
           "--beats-per-bar", a->beats_per_bar, "beats in a bar of the music, for a new dance")
        ->check(in_range(2, 12));
    add_named_option(*app, "--role", a->role, motion::kRoleNames, "lead or follow");
    add_named_option(*app,
                     "--features",
                     a->features,
                     motion::kFeaturesNames,
                     "what is learnt of the joints: angles or positions");
    app->add_option("--split", a->split, "only labels whose column split says this");
    app->add_option("--min-confidence", a->min_confidence, "only labels at least so sure")
        ->check(in_range(0.0, 1.0));
    app->add_option("--fps", a->fps, "frames a second, when the file is wrong")
        ->check(in_range(1.0, 1000.0));
    app->add_option("--skeleton", a->skeleton, "X.asf of clips that are .amc");
    add_body_options(*app, a->body);
    add_joint_options(*app, a->joints, "the clips");
    // 0, the default, cannot be given: it stands for the number that suits the material.
    app->add_option("--states", a->states, "states of each part")->check(in_range(2, 96));
    app->add_option("--iterations", a->iterations, "rounds of training (Baum-Welch)")
        ->check(in_range(0, 100));
    add_named_option(*app,
                     "--covariance",
                     a->covariance,
                     motion::kCovarianceKindNames,
                     "covariances of the states: tied, full or diagonal");
    add_named_option(*app,
                     "--start",
                     a->start,
                     motion::kStatesStartNames,
                     "how states are placed before training: flat, segmental");
    app->add_option("--source", a->source, "cmu: the model acknowledges mocap.cs.cmu.edu")
        ->check(one_of({"cmu"}));
    app->add_option(
        "-o,--out",
        a->output,
        "NAME of a dance to install it as, a folder, or X.json for one model; none: the dance's "
        "own name");
}

void add_train_take(CommandTable& table) {
    auto [app, a] = table.add(table.app(), "take", "make a dance of whole takes", train_take);
    app->add_option("clips", a->clips, "motion files, or a folder of them")->required();
    auto* const counts =
        app->add_option("--counts", a->counts, "TSV: take, time, half, used; a row a beat");
    app->add_option("--propose", a->propose, "X.tsv: propose that table and stop")
        ->excludes(counts);
    auto* const music =
        app->add_option("--music", a->music, "song that was danced to: its beats are the counts")
            ->excludes(counts);
    app->add_option("--offset", a->offset, "seconds of the song at a clip's first frame")
        ->check(in_range(-86400.0, 86400.0))
        ->needs(music);
    app->add_option("--dance", a->dance, "its name, where -o is a folder");
    app->add_option("--without", a->without, "takes of the table that are left out");
    app->add_flag("--lay-arms",
                  a->lays_arms,
                  "where arms hang in a robot's home pose, give them those of other beats of the "
                  "take, in place of leaving such beats out");
    app->add_option("--licence", a->licence, "of the takes, and who made them");
    add_body_options(*app, a->body);
    app->add_option("-o,--out", a->output, "NAME of a dance to install it as, or a folder");
}

void add_train_report(CommandTable& table) {
    auto [app, a] = table.add(table.app(), "report", "show how figures are learnt", train_report);
    app->add_option(
           "clips",
           a->clips,
           "motion files, or a folder of them; or X.cells, or a folder of a dance of takes")
        ->required();
    // Not required: a dance of takes has none.
    app->add_option("--labels", a->labels, "TSV: take, role, start, end, figure, ...");
    app->add_option("--counts", a->counts, "TSV: when each count falls");
    app->add_option("--faults", a->faults, "TSV: stretches that the capture got wrong");
    app->add_option("--figure", a->figures, "one or several; several are also told apart");
    app->add_option("--dance", a->dance, "the dance that they belong to");
    app->add_option("--role", a->role, "lead, follow or both")
        ->check(one_of({"lead", "follow", "both"}));
    add_named_option(*app,
                     "--features",
                     a->features,
                     motion::kFeaturesNames,
                     "what is learnt of the joints: angles or positions");
    app->add_option("--split", a->split, "learn only from labels of this split");
    // Training and test splits keep their repeats apart.
    app->add_option("--test-split", a->test_split, "tell figures apart in this split, too");
    app->add_option("--min-confidence", a->min_confidence, "learn only from labels as sure")
        ->check(in_range(0.0, 1.0));
    app->add_option("--test-confidence", a->test_confidence, "the same of --test-split")
        ->check(in_range(0.0, 1.0));
    app->add_option("--fps", a->fps, "frames a second, when the file is wrong")
        ->check(in_range(1.0, 1000.0));
    app->add_option("--skeleton", a->skeleton, "X.asf of clips that are .amc");
    add_joint_options(*app, a->joints, "the clips");
    // One scale for both dancers, or the lead's and the follow's.
    app->add_option("--scale", a->scales, "metres per unit of the file: lead's, follow's")
        ->expected(1, 2)
        ->check(in_range(1e-4, 10.0));
    // The report tries every number from 2 up; --states is for the classifier's models alone.
    app->add_option("--most-states", a->most_states, "most states that are tried, from 2 on")
        ->check(in_range(2, 64));
    app->add_option("--states", a->states, "states of the models that tell figures apart")
        ->check(in_range(2, 64));
    app->add_option("--iterations", a->iterations, "rounds of training (Baum-Welch)")
        ->check(in_range(0, 100));
    app->add_option("--threads", a->threads, "0: all cores; the page is the same for any")
        ->check(in_range(0, 256));
    app->add_option("-o,--out", a->output, "X.html")->required();
}

}  // namespace raks::apps
