#include "apps/raks_train/found_repeats.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "apps/reports/repeat_page.hpp"
#include "apps/reports/text_table.hpp"
#include "apps/terminal/say.hpp"
#include "base/file_set.hpp"
#include "base/printable.hpp"
#include "motion/figures/label_tables.hpp"
#include "training/discovery/proposal_check.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

std::vector<std::string> remarks_of(const TrainFigureArguments& arguments) {
    return {
        "Repeats that raks found. Delete the rows that are not the figure, mend borders (frames "
        "from 0),",
        "set the confidence of a row that is to be learnt all the same to 1; then",
        "raks train figure CLIPS --labels " + arguments.propose.filename().string() +
            " learns from those of 0.9 or more."};
}

/// Seconds, joined by ", "; at most three.
std::string listed(const std::vector<double>& seconds) {
    std::string text;
    for (std::size_t i = 0; i < std::min<std::size_t>(seconds.size(), 3); ++i) {
        text += fmt::format("{}{:.2f}", i == 0 ? "" : " ", seconds[i]);
    }
    return seconds.size() > 3 ? text + " ..." : text;
}

std::vector<double> different(std::vector<double> seconds) {
    constexpr double kSame = 0.04;
    std::sort(seconds.begin(), seconds.end());
    std::vector<double> kept;
    for (const double value : seconds) {
        if (kept.empty() || value > (1.0 + kSame) * kept.back()) {
            kept.push_back(value);
        }
    }
    return kept;
}

/// The takes beside their labels, and the sums over all.
std::string comparison(const std::vector<motion::TakeCheck>& checks, const std::string& figure) {
    std::vector<Row> rows = {
        {"take", "found s", "labelled s", "right", figure + " within half a beat", "all figures"}};
    motion::TakeCheck sum;
    int takes = 0;
    int right = 0;
    for (const motion::TakeCheck& check : checks) {
        const bool is_judged = !check.true_seconds.empty();
        rows.push_back({check.take,
                        fmt::format("{:.2f}", check.found_seconds),
                        is_judged ? listed(different(check.true_seconds)) : "-",
                        !is_judged              ? "-"
                        : check.is_period_right ? "yes"
                                                : "no",
                        fmt::format("{} of {}", check.hit, check.labelled),
                        fmt::format("{} of {}", check.all_hit, check.all_labelled)});
        takes += is_judged ? 1 : 0;
        right += is_judged && check.is_period_right ? 1 : 0;
        sum.hit += check.hit;
        sum.labelled += check.labelled;
        sum.all_hit += check.all_hit;
        sum.all_labelled += check.all_labelled;
    }
    rows.push_back({"all",
                    "",
                    "",
                    fmt::format("{} of {}", right, takes),
                    fmt::format("{} of {}", sum.hit, sum.labelled),
                    fmt::format("{} of {}", sum.all_hit, sum.all_labelled)});
    return text_table(rows);
}

/// The likeliest other ways to count a phrase, and how to ask for one of them; empty: none.
std::string doubts_of(const motion::FoundRepeats& phrase) {
    constexpr std::size_t kMostSaid = 3;
    std::string text;
    for (std::size_t i = 1; i < std::min(phrase.counts.size(), 1 + kMostSaid); ++i) {
        const motion::PhraseCount& other = phrase.counts[i];
        text += fmt::format("{}{} beats at {:.1f} BPM ({:.0f} %)",
                            i == 1 ? "" : ", ",
                            other.beats,
                            other.bpm,
                            100.0 * other.probability);
    }
    return text.empty() ? text : fmt::format("; or {}: --bpm takes another", text);
}

std::string phrase_line(const motion::DiscoveredClip& clip) {
    const motion::FoundRepeats& phrase = clip.found;
    const std::string sure = phrase.counts.empty()
                                 ? ""
                                 : fmt::format(" ({:.0f} %)", 100.0 * phrase.counts[0].probability);
    return fmt::format("{}: one phrase of {:.2f} s from {:.2f} s on: {} beats at {:.1f} BPM{}{}\n",
                       printable(clip.take),
                       phrase.seconds,
                       phrase.repeats.front().start / clip.clip.frames_per_second,
                       phrase.beats,
                       phrase.tempo(),
                       sure,
                       doubts_of(phrase));
}

}  // namespace

Path page_beside(const Path& table) {
    Path page = table;
    return page.replace_extension(".html");
}

Expected<motion::DiscoveredClips> found_in_clips(const TrainFigureArguments& arguments,
                                                 const motion::FigureTrainingPlan& plan) {
    motion::DiscoveryOptions options;
    options.beats_per_bar = arguments.beats_per_bar;
    if (arguments.beats > 0) {
        options.beats = arguments.beats;
    }
    if (arguments.bpm > 0.0) {
        options.bpm = arguments.bpm;
    }
    const auto what = arguments.once ? motion::Discovery::whole_phrase : motion::Discovery::repeats;
    auto found = motion::discover_clips(plan, what, options);
    if (found) {
        for (const std::string& warning : found->warnings) {
            say(warning);
        }
        for (const std::string& why : found->skipped) {
            say(why + "; it is left out");
        }
    }
    return found;
}

std::string few_alike(const motion::DiscoveredClips& found) {
    std::size_t repeats = 0;
    for (const motion::DiscoveredClip& clip : found.clips) {
        repeats += clip.found.repeats.size();
    }
    return fmt::format("{} of {} repeats are alike", found.good(), repeats);
}

std::string found_lines(const motion::DiscoveredClips& found) {
    std::string text;
    for (const motion::DiscoveredClip& clip : found.clips) {
        const motion::FoundRepeats& repeats = clip.found;
        if (repeats.repeats.empty()) {
            continue;
        }
        if (repeats.repeats.size() == 1 && repeats.repeats.front().is_good) {
            text += phrase_line(clip);
            continue;
        }
        std::string starts;
        for (const motion::FoundRepeat& repeat : repeats.repeats) {
            if (repeat.is_good) {
                starts += fmt::format("{}{:.1f}",
                                      starts.empty() ? "" : ", ",
                                      repeat.start / clip.clip.frames_per_second);
            }
        }
        starts = starts.empty() ? "none is like the commonest"
                                : fmt::format("learnt: those from {} s", starts);
        text +=
            fmt::format("{}: {} of {} repeats of {} beats ({:.2f} s, {:.0f} BPM) are alike; {}\n",
                        printable(clip.take),
                        repeats.good(),
                        repeats.repeats.size(),
                        repeats.beats,
                        repeats.seconds,
                        repeats.tempo(),
                        starts);
    }
    return text;
}

Expected<void> propose(const TrainFigureArguments& arguments,
                       const motion::FigureTrainingPlan& plan) {
    const auto found = found_in_clips(arguments, plan);
    if (!found) {
        return fail(found.error());
    }
    const std::vector<motion::FigureLabel> labels = found->labels(plan);
    const Path page = page_beside(arguments.propose);
    if (auto written =
            write_files({{page, draw_repeats(*found, plan.figure)},
                         {arguments.propose, motion::labels_text(labels, remarks_of(arguments))}});
        !written) {
        return written;
    }
    print_text(found_lines(*found));
    if (found->good() < motion::kFewestRepeats) {
        say(fmt::format("{}; six make a good figure", few_alike(*found)));
    }
    if (!arguments.labels.empty()) {
        const auto truth = motion::load_labels(arguments.labels);
        if (!truth) {
            return fail(truth.error());
        }
        print_text(comparison(motion::check_proposal(*found, *truth, plan), plan.figure));
    }
    say(fmt::format("{} holds the repeats, {} shows them; edited or not, --labels {} learns them",
                    arguments.propose.string(),
                    page.string(),
                    arguments.propose.string()));
    return {};
}

}  // namespace raks::apps
