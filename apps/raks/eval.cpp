#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "apps/raks/commands.hpp"
#include "apps/raks/excerpt_analysis.hpp"
#include "apps/reports/eval_report.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "audio/evaluate/beat_corpus.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "base/suggest.hpp"
#include "engine/setup/analyzer_setup.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

namespace fs = std::filesystem;
using Excerpts = std::vector<audio::BeatExcerpt>;

// Names of our trackers in the report, and of their folders.
const char* name_of(FileBeatMethod method) {
    switch (method) {
        case FileBeatMethod::pointer:
            return "raks";
        case FileBeatMethod::whole:
            return "raks-whole";
        case FileBeatMethod::paper:
            return "raks-paper";
        case FileBeatMethod::paper_whole:
            return "raks-paper-whole";
    }
    return "";
}

// The excerpts of the class asked for, or all. Errors: those of the corpus; no such class.
Expected<Excerpts> load_excerpts(const EvalBeatsArguments& arguments) {
    auto corpus = audio::load_beat_corpus(arguments.corpus);
    if (!corpus || arguments.category.empty()) {
        return corpus;
    }
    Excerpts chosen;
    // All classes, for the suggestion.
    std::vector<std::string_view> known;
    for (const audio::BeatExcerpt& excerpt : *corpus) {
        if (excerpt.category == arguments.category) {
            chosen.push_back(excerpt);
        }
        if (std::find(known.begin(), known.end(), excerpt.category) == known.end()) {
            known.push_back(excerpt.category);
        }
    }
    if (chosen.empty()) {
        return fail(unknown_name("class", arguments.category, known));
    }
    return chosen;
}

// The folders of other trackers' beats: `peers` itself when it holds .beats files, else the folders
// in it, sorted.
Expected<std::vector<Path>> tracker_folders(const Path& peers) {
    const auto listed = list_folder(peers);
    if (!listed) {
        return fail(listed.error());
    }
    std::vector<Path> folders;
    bool has_beats = false;
    for (const Path& path : *listed) {
        std::error_code ignored;
        if (fs::is_directory(path, ignored)) {
            folders.push_back(path);
        }
        has_beats = has_beats || path.extension() == ".beats";
    }
    if (has_beats) {
        return std::vector<Path>{peers};
    }
    if (folders.empty()) {
        return fail(peers.string() + ": holds no tracker: neither NAME.beats nor folders of them");
    }
    return folders;
}

// The last part of a path, also of "a/b/" and ".".
std::string folder_name(const Path& folder) {
    std::error_code ignored;
    const Path full = fs::weakly_canonical(folder, ignored);
    return full.filename().empty() ? folder.string() : full.filename().string();
}

// Scores of a tracker that ran elsewhere. An excerpt without a file counts as one without beats,
// and a line says so.
Expected<ScoredTracker> score_peer(const Path& folder, const Excerpts& excerpts) {
    ScoredTracker tracker{folder_name(folder), {}, {}};
    std::size_t missing = 0;
    for (const audio::BeatExcerpt& excerpt : excerpts) {
        auto estimate = audio::load_beat_estimate(folder, excerpt.name);
        if (!estimate) {
            return fail(std::move(estimate.error()));
        }
        // Zero beats score as low as they must: leaving excerpts out would flatter the tracker.
        missing += *estimate ? 0U : 1U;
        tracker.scores.push_back(
            audio::score_beats(excerpt.reference, estimate->value_or(audio::BeatEstimate{})));
    }
    // All missing means a wrong folder.
    if (missing == excerpts.size()) {
        return fail(folder.string() + ": has no beats of any excerpt");
    }
    if (missing > 0) {
        say(fmt::format("{}: lacks {} of {} excerpts; they count as without beats",
                        folder.string(),
                        missing,
                        excerpts.size()));
    }
    return tracker;
}

// The folder for a method's beats: one each when there are several methods.
Expected<Path> output_folder(const EvalBeatsArguments& arguments, FileBeatMethod method) {
    const Path folder =
        arguments.methods.size() > 1 ? arguments.output / name_of(method) : arguments.output;
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
        return fail(folder.string() + ": cannot be created: " + error.message());
    }
    return folder;
}

// One network an excerpt, shared between excerpts; null: none.
using Networks = std::vector<std::shared_ptr<const audio::BeatNetwork>>;

// The same network for every excerpt; "none": onset features without a network.
Expected<Networks> networks_for(const Excerpts& excerpts, const Path& network) {
    if (network == "none") {
        return Networks(excerpts.size());
    }
    auto loaded = engine::load_beat_network(network);
    if (!loaded) {
        return fail(std::move(loaded.error()));
    }
    return Networks(excerpts.size(), *loaded);
}

// For every excerpt the network of its class, folder/CLASS.json, loaded once a class.
Expected<Networks> networks_by_class(const Excerpts& excerpts, const Path& folder) {
    std::map<std::string, std::shared_ptr<const audio::BeatNetwork>> loaded;
    Networks networks;
    for (const audio::BeatExcerpt& excerpt : excerpts) {
        const std::string name = excerpt.category + ".json";
        if (loaded.count(name) == 0) {
            auto network = engine::load_beat_network(folder / name);
            if (!network) {
                return fail(std::move(network.error()));
            }
            loaded[name] = std::move(*network);
        }
        networks.push_back(loaded[name]);
    }
    return networks;
}

// Runs one of our trackers over the excerpts, each with its network, and stores the beats in
// `folder` if there is one. Empty when a signal came before all excerpts were done.
Expected<std::optional<ScoredTracker>> score_own(const Excerpts& excerpts,
                                                 FileBeatMethod method,
                                                 const Networks& networks,
                                                 const std::string& name,
                                                 const std::optional<Path>& folder) {
    const auto analyzed = analyze_excerpts(excerpts, method, networks, name);
    if (!analyzed) {
        return fail(analyzed.error());
    }
    ScoredTracker tracker{name, {}, {}};
    for (std::size_t i = 0; i < excerpts.size(); ++i) {
        // Not finished when a signal came.
        if (!(*analyzed)[i]) {
            continue;
        }
        const auto& [estimate, warning] = *(*analyzed)[i];
        if (!warning.empty()) {
            say(warning);
        }
        tracker.scores.push_back(audio::score_beats(excerpts[i].reference, estimate));
        tracker.claims.push_back(audio::claims_of(excerpts[i].reference, estimate));
        if (!folder) {
            continue;
        }
        if (auto saved = audio::save_beat_estimate(*folder, excerpts[i].name, estimate); !saved) {
            return fail(std::move(saved.error()));
        }
    }
    // Scores are by position: an incomplete list would be assigned to wrong excerpts.
    const bool is_complete = tracker.scores.size() == excerpts.size();
    return is_complete ? std::optional(std::move(tracker)) : std::nullopt;
}

// One method, with the network that was asked for; stores the beats where asked.
Expected<std::optional<ScoredTracker>> score_method(const EvalBeatsArguments& arguments,
                                                    FileBeatMethod method,
                                                    const Excerpts& excerpts) {
    std::optional<Path> folder;
    if (!arguments.output.empty()) {
        auto created = output_folder(arguments, method);
        if (!created) {
            return fail(std::move(created.error()));
        }
        folder = std::move(*created);
    }
    const auto networks = networks_for(excerpts, arguments.network);
    if (!networks) {
        return fail(networks.error());
    }
    return score_own(excerpts, method, *networks, name_of(method), folder);
}

// The default tracker, each class scored with a network that was trained without it.
Expected<std::optional<ScoredTracker>> score_left_out(const Path& folder,
                                                      const Excerpts& excerpts) {
    const auto networks = networks_by_class(excerpts, folder);
    if (!networks) {
        return fail(networks.error());
    }
    return score_own(excerpts, FileBeatMethod::pointer, *networks, "raks-left-out", std::nullopt);
}

// Scores of all other trackers, computed before ours run: a fault there should not cost minutes.
Expected<std::vector<ScoredTracker>> score_peers(const EvalBeatsArguments& arguments,
                                                 const Excerpts& excerpts) {
    std::vector<ScoredTracker> trackers;
    for (const Path& peers : arguments.peers) {
        const auto folders = tracker_folders(peers);
        if (!folders) {
            return fail(folders.error());
        }
        for (const Path& folder : *folders) {
            auto tracker = score_peer(folder, excerpts);
            if (!tracker) {
                return fail(std::move(tracker.error()));
            }
            trackers.push_back(std::move(*tracker));
        }
    }
    return trackers;
}

}  // namespace

ExitCode eval_beats(const EvalBeatsArguments& arguments) {
    const auto excerpts = load_excerpts(arguments);
    if (!excerpts) {
        return fail(excerpts.error());
    }
    // Estimates must not be written over the corpus' annotations.
    if (auto checked = check_is_no_input(arguments.output, {arguments.corpus}); !checked) {
        return fail(std::move(checked.error()));
    }
    BeatReport report{arguments.corpus.string(), {}, {}};
    for (const audio::BeatExcerpt& excerpt : *excerpts) {
        report.excerpts.push_back({excerpt.name, excerpt.category});
    }
    auto peers = score_peers(arguments, *excerpts);
    if (!peers) {
        return fail(std::move(peers.error()));
    }
    for (const FileBeatMethod method : arguments.methods) {
        auto own = score_method(arguments, method, *excerpts);
        if (!own) {
            return fail(std::move(own.error()));
        }
        if (!*own) {
            return kExitDone;  // stopped: what was written stays, half a table would mislead
        }
        report.trackers.push_back(std::move(**own));
    }
    if (!arguments.left_out.empty()) {
        auto left_out = score_left_out(arguments.left_out, *excerpts);
        if (!left_out) {
            return fail(std::move(left_out.error()));
        }
        if (!*left_out) {
            return kExitDone;
        }
        report.trackers.push_back(std::move(**left_out));
    }
    // Our trackers come first in the tables.
    std::move(peers->begin(), peers->end(), std::back_inserter(report.trackers));
    const Detail detail = arguments.asks_for_each ? Detail::by_excerpt : Detail::by_class;
    if (arguments.as_json) {
        print_json(to_json(report));
    } else {
        print_text(to_text(report, detail));
    }
    return kExitDone;
}

}  // namespace raks::apps
