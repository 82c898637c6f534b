// Dances that were solved and kept, pretrained weights, and postures.
#include <array>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "audio/beat/network/beatnet.hpp"
#include "audio/genre/tagger_file.hpp"
#include "base/file.hpp"
#include "base/hash.hpp"
#include "engine/show/pose_file.hpp"
#include "motion/cells/cell_file.hpp"
#include "motion/dance_library.hpp"
#include "motion/dancer.hpp"
#include "motion/figures/figure_grammar.hpp"
#include "motion/figures/figure_model.hpp"
#include "tests/fuzz/promise.hpp"
#include "tests/fuzz/readers.hpp"
#include "tests/support/made_cells.hpp"

namespace raks::fuzz {
namespace {

/// A dance of one figure, and as it is kept.
struct KeptDance {
    motion::FigureGrammar grammar;
    std::string bytes;
};

KeptDance keep_dance() {
    const auto text =
        read_file(std::string(RAKS_SOURCE_DIR) + "/models/trained/salsa_basic_lead.json");
    const auto figure = motion::parse_figure(text.value(), "x.json");
    KeptDance kept;
    kept.grammar.rules.push_back({.figure = figure->name, .after = {1.0}});
    const auto library =
        motion::DanceLibrary::build({&*figure, 1}, motion::mannequin_skeleton(), &kept.grammar);
    must(library.has_value());
    kept.bytes = (*library)->packed();
    return kept;
}

// The bytes with changes, each by four bytes for its place and one to put there; where four bytes
// are left, it is cut there. The hash at the end is made to fit again, else nothing behind it would
// be tried.
using Hash = std::uint64_t (*)(std::string_view bytes);
std::string changed(
    std::string bytes, std::string_view changes, Hash hash = [](std::string_view text) {
        return fast_hash_of(text);
    }) {
    std::size_t body = bytes.size() - sizeof(std::uint64_t);
    for (; changes.size() >= 5; changes.remove_prefix(5)) {
        std::uint32_t place = 0;
        std::memcpy(&place, changes.data(), sizeof place);
        bytes[place % body] = changes[4];
    }
    if (std::uint32_t place = 0; changes.size() == sizeof place) {
        std::memcpy(&place, changes.data(), sizeof place);
        body = place % body;
        bytes.resize(body + sizeof(std::uint64_t));
    }
    const std::uint64_t sum = hash(std::string_view(bytes).substr(0, body));
    std::memcpy(bytes.data() + body, &sum, sizeof sum);
    return bytes;
}

void read_kept_cells(std::string_view changes) {
    static const std::string good = [] {
        // Only what was read from a file has all that a model of states needs.
        const auto dance =
            motion::parse_cells(motion::cell_text(motion::test::made_cells(
                                    std::string(RAKS_SOURCE_DIR) + "/models/trained", "x")),
                                "x.cells");
        must(dance.has_value());
        const auto library = motion::DanceLibrary::build(*dance, motion::mannequin_skeleton());
        must(library.has_value());
        return (*library)->packed();
    }();
    const auto library = motion::DanceLibrary::unpack(
        std::make_shared<const std::string>(changed(good, changes)), motion::mannequin_skeleton());
    if (!library) {
        must_be_one_line(library.error().message);
        return;
    }
    // Its takes are read wherever a piece of them may be.
    const motion::CellGraph& graph = *(*library)->cells();
    for (std::size_t take = 0; take < graph.takes.size(); ++take) {
        for (int beat = -1; beat <= graph.takes[take].beats + 1; ++beat) {
            static_cast<void>((*library)->pose_at(take, beat));
        }
    }
}

}  // namespace

bool read_cells(std::string_view changes) {
    static const std::string good = motion::cell_text(
        motion::test::made_cells(std::string(RAKS_SOURCE_DIR) + "/models/trained", "x"));
    const auto dance = motion::parse_cells(changed(good, changes), "x.cells");
    if (!dance) {
        must_be_one_line(dance.error().message);
        return false;
    }
    const auto library = motion::DanceLibrary::build(*dance, motion::mannequin_skeleton());
    if (!library) {
        must_be_one_line(library.error().message);
        return false;
    }
    motion::Dancer dancer;
    must(dancer.prepare(*library, motion::mannequin_skeleton(), std::uint64_t{1}).has_value());
    motion::PoseTrack track;
    for (HopIndex hop = 0; hop < 400; ++hop) {
        MusicState state;
        state.hop = hop;
        state.time = time_of_hop(hop);
        state.grid.confidence = 1.0F;
        state.is_silent = false;
        dancer.advance(state, track);
    }
    return true;
}

bool read_tagger(std::string_view changes) {
    static const std::string good =
        read_file(std::string(RAKS_SOURCE_DIR) + "/models/pretrained/msd_musicnn.tagger").value();
    const auto network = audio::parse_tagger(
        changed(good, changes, [](std::string_view text) { return hash_of(text); }));
    if (!network) {
        must_be_one_line(network.error().message);
        return false;
    }
    std::vector<float> mel(audio::kTagFrames * audio::kTagBands);
    for (std::size_t i = 0; i < mel.size(); ++i) {
        mel[i] = static_cast<float>(i % 37) * 0.1F;
    }
    audio::TaggerRun run;
    run.compute(*network, std::span(mel).first<audio::kTagFrames * audio::kTagBands>());
    return true;
}

bool read_beatnet(std::string_view changes) {
    static const std::string good =
        read_file(std::string(RAKS_SOURCE_DIR) + "/models/pretrained/beatnet.weights").value();
    auto network = audio::parse_beatnet(
        changed(good, changes, [](std::string_view text) { return hash_of(text); }));
    if (!network) {
        must_be_one_line(network.error().message);
        return false;
    }
    audio::BeatNetStream stream(std::make_shared<const audio::BeatNet>(std::move(*network)));
    std::array<float, audio::BeatNetStream::kWindow> samples{};
    for (std::size_t frame = 0; frame < 10; ++frame) {
        for (std::size_t i = 0; i < samples.size(); ++i) {
            samples[i] = static_cast<float>((i + 5 * frame) % 61) / 61.0F - 0.5F;
        }
        // Probabilities, whatever the weights are.
        const audio::BeatNetEvidence evidence = stream.next(samples);
        must(evidence.downbeat >= 0.0F && evidence.downbeat <= evidence.beat);
        must(evidence.beat <= 1.0F + 1e-5F);
    }
    return true;
}

// A kept dance is of one machine and one build, so none can lie in a corpus: the bytes say what of
// a good one is changed, one of figures and one of cells.
bool read_kept_dance(std::string_view changes) {
    read_kept_cells(changes);
    static const KeptDance kept = keep_dance();
    std::string bytes = changed(kept.bytes, changes);
    const auto library =
        motion::DanceLibrary::unpack(std::make_shared<const std::string>(std::move(bytes)),
                                     motion::mannequin_skeleton(),
                                     kept.grammar);
    if (!library) {
        must_be_one_line(library.error().message);
        return false;
    }
    must((*library)->figure_names().size() == kept.grammar.rules.size());
    return true;
}

bool read_posture(std::string_view text) {
    const auto pose = engine::parse_pose(text, "");
    if (!pose) {
        must_be_one_line(pose.error().message);
    }
    return pose.has_value();
}

}  // namespace raks::fuzz
