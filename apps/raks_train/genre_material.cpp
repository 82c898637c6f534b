#include "apps/raks_train/genre_material.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <iterator>
#include <utility>

#include "apps/raks_train/genre_features.hpp"
#include "apps/terminal/say.hpp"
#include "base/hash.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// For every 6 pieces of the main corpus one in a family of arrangements that may be held out.
constexpr int kRestShare = 6;
// For every 10 pieces one without a beat to dance to, and one of our own generator.
constexpr int kFurtherShare = 10;
// For every 2 pieces one whose sounds are synthesized for it.
constexpr int kSynthesizedShare = 2;

// Features of the chunks, in order; chunks that `is_wanted(i)` refuses stay empty. One after the
// other: the threads work inside a chunk.
template <class IsWanted>
Expected<std::vector<audio::FeatureUnit>> extract_chunks(const GenreOptions& options,
                                                         const std::vector<WrittenChunk>& chunks,
                                                         const IsWanted& is_wanted) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t computed = std::clock();
    std::vector<audio::FeatureUnit> units(chunks.size());
    std::size_t done = 0;
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        if (is_wanted(i)) {
            auto pieces = extract_chunk(options, chunks[i]);
            if (!pieces) {
                return fail(pieces.error());
            }
            units[i].pieces = std::move(*pieces);
        }
        // Refused chunks count as done, so that the time left is about what remains.
        ++done;
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
        say(fmt::format(
            "{}: {} of {} chunks of music played and analyzed ({:.0f} s of computing), {:.0f} s "
            "left",
            chunks[i].name,
            done,
            chunks.size(),
            static_cast<double>(std::clock() - computed) / CLOCKS_PER_SEC,
            spent.count() * static_cast<double>(chunks.size() - done) / static_cast<double>(done)));
    }
    return units;
}

// The chunks of all written music that the options ask for. Families that may be held out are
// written apart, so that a model that leaves them out is trained on the same other music.
std::vector<WrittenChunk> all_chunks(const GenreOptions& options,
                                     const audio::FeaturePlan& feature_plan) {
    using Families = audio::WrittenCorpusPlan::Families;
    audio::WrittenCorpusPlan plan{.soundfonts = options.written.soundfonts,
                                  .families = Families::always,
                                  .pieces = options.written.pieces,
                                  .seed = options.seed,
                                  .feature_plan = {}};
    std::vector<WrittenChunk> chunks = chunks_of(options, feature_plan, "written", plan);
    if (!options.written.leaves_out_families) {
        plan.families = Families::held_out;
        plan.pieces = options.written.pieces / kRestShare;
        auto rest = chunks_of(options, feature_plan, "written-rest", plan);
        std::move(rest.begin(), rest.end(), std::back_inserter(chunks));
    }
    // Editions 1 and 2 are the older corpora, from which a model can be trained again.
    if (options.written.edition >= 3) {
        // Further music: pieces without a beat to dance to, pieces of our own generator, and pieces
        // with drawn sounds; their numbers are shares of the main corpus.
        using Music = audio::WrittenCorpusPlan::Music;
        plan.families = Families::always;
        const auto add = [&](Music music, const char* name, int pieces) {
            plan.music = music;
            plan.pieces = pieces;
            auto more = chunks_of(options, feature_plan, name, plan);
            std::move(more.begin(), more.end(), std::back_inserter(chunks));
        };
        add(Music::undanceable, "written-undanceable", options.written.pieces / kFurtherShare);
        add(Music::own, "written-own", options.written.pieces / kFurtherShare);
        if (options.written.edition >= 4) {
            add(Music::synthesized,
                "written-synthesized",
                options.written.pieces / kSynthesizedShare);
        }
    }
    return chunks;
}

// The soundfonts are credited in the model's file.
std::string credit_of_written(const GenreOptions& options) {
    if (options.written.pieces == 0) {
        return {};
    }
    std::string text = "Music written by this program, played with soundfonts";
    for (const auto& soundfont : options.written.soundfonts) {
        text += " " + soundfont.filename().string();
    }
    return text + ". ";
}

// All units of this machine's share, recordings first. Units are numbered over recordings and
// chunks, so that the shares divide both.
Expected<audio::FeatureMaterial> extract_all(const GenreOptions& options,
                                             const audio::FeaturePlan& feature_plan) {
    audio::FeatureMaterial material;
    material.written_with = credit_of_written(options);
    if (!options.recordings.folder.empty()) {
        auto listed =
            options.recordings.index.empty()
                ? audio::list_music(options.recordings.folder, *options.dances)
                : audio::list_music(
                      options.recordings.folder, options.recordings.index, *options.dances);
        if (!listed) {
            return fail(listed.error());
        }
        material.files = std::move(*listed);
    }
    const auto& kept = options.recordings.kept;
    material.files.insert(material.files.end(), kept.begin(), kept.end());
    if (!material.files.empty()) {
        // The same file under two genres would be trained both ways.
        if (auto distinct = audio::check_distinct(material.files); !distinct) {
            return fail(distinct.error());
        }
        material.units = extract_recordings(material.files, options, feature_plan);
    }
    // The music is played by soundfonts; without one there is no sound.
    if (options.written.pieces > 0) {
        if (options.written.soundfonts.empty()) {
            return fail("--synthesize needs --soundfont X.sf2: what the music is played with");
        }
        const std::size_t first = material.units.size();
        auto more = extract_chunks(options, all_chunks(options, feature_plan), [&](std::size_t i) {
            return options.shards.share.has(first + i);
        });
        if (!more) {
            return fail(more.error());
        }
        std::move(more->begin(), more->end(), std::back_inserter(material.units));
    }
    return material;
}

// Names the recordings that were left out, on stderr. With --strict one of them is an error.
Expected<void> report_faults(const GenreOptions& options, const audio::FeatureMaterial& material) {
    std::size_t skipped = 0;
    const std::string* first = nullptr;
    for (const audio::FeatureUnit& unit : material.units) {
        if (!unit.fault.empty()) {
            say("skipped " + unit.fault);
            first = first == nullptr ? &unit.fault : first;
            ++skipped;
        }
    }
    if (skipped > 0) {
        say(fmt::format("{} of {} files skipped", skipped, material.files.size()));
    }
    if (options.recordings.is_strict && skipped > 0) {
        return fail(fmt::format("{} of {} files cannot be used (--strict): {}",
                                skipped,
                                material.files.size(),
                                *first));
    }
    return {};
}

// Everything that the features depend on, in one line: shards with other lines must not be merged.
std::string plan_text(const GenreOptions& options,
                      const audio::FeaturePlan& feature_plan,
                      const audio::FeatureMaterial& material) {
    // The list of files counts with its groups and genres, as units are numbered by it.
    std::uint64_t files = hash_of("");
    for (const audio::MusicFile& file : material.files) {
        files = hash_of(
            fmt::format("{} {} {}\n", file.name, file.group, audio::shown_genre(file.genre)),
            files);
    }
    return fmt::format(
        "hearing {:x} files {:x} altered {} seed {} edition {} styles {:x} written {} {} {}{}",
        feature_key(feature_plan, options.plan.features),
        files,
        options.augmentation.copies,
        options.seed,
        options.written.edition,
        options.written.pieces > 0 ? fingerprint(options.written.styles) : 0,
        options.written.pieces,
        options.written.leaves_out_families ? "always" : "all",
        material.written_with,
        without(options.augmentation.effects));
}

}  // namespace

Expected<std::vector<audio::PieceFeatures>> written(const GenreOptions& options,
                                                    const audio::FeaturePlan& feature_plan,
                                                    const std::string& name,
                                                    const audio::WrittenCorpusPlan& plan) {
    // Tests write their own music: all chunks, whatever this machine's share.
    auto units = extract_chunks(
        options, chunks_of(options, feature_plan, name, plan), [](auto) { return true; });
    if (!units) {
        return fail(units.error());
    }
    std::vector<audio::PieceFeatures> pieces;
    for (audio::FeatureUnit& unit : *units) {
        std::move(unit.pieces.begin(), unit.pieces.end(), std::back_inserter(pieces));
    }
    return pieces;
}

Expected<void> write_shard(const GenreOptions& options,
                           const audio::FeaturePlan& feature_plan,
                           const std::string& command) {
    auto material = extract_all(options, feature_plan);
    if (!material) {
        return fail(material.error());
    }
    if (auto reported = report_faults(options, *material); !reported) {
        return reported;
    }
    // The faults travel in the shard as well: merging reports them again.
    const std::string plan = plan_text(options, feature_plan, *material);
    return audio::save_shard({options.shards.share, plan, command, std::move(*material)},
                             options.output);
}

Expected<GenreMaterial> gather(const GenreOptions& options,
                               const audio::FeaturePlan& feature_plan) {
    // Shards hold what gather() would have computed, so that both ways lead to the same
    // material.
    auto extracted = options.shards.merged.empty() ? extract_all(options, feature_plan)
                                                   : audio::merge_shards(options.shards.merged);
    if (!extracted) {
        return fail(extracted.error());
    }
    if (auto reported = report_faults(options, *extracted); !reported) {
        return fail(reported.error());
    }
    GenreMaterial material;
    material.files = std::move(extracted->files);
    material.written_with = std::move(extracted->written_with);
    for (audio::FeatureUnit& unit : extracted->units) {
        std::move(unit.pieces.begin(), unit.pieces.end(), std::back_inserter(material.pieces));
    }
    // Music of the beat tracker's corpus: without windows, for the recurrent network alone.
    if (!options.written.beats_corpus.empty()) {
        using Families = audio::WrittenCorpusPlan::Families;
        auto more = audio::read_beats_corpus(
            options.written.beats_corpus,
            options.written.styles,
            options.written.leaves_out_families ? Families::always : Families::all);
        if (!more) {
            return fail(more.error());
        }
        std::move(more->begin(), more->end(), std::back_inserter(material.pieces));
    }
    // Genres to leave out are taken out here, after the cache, which holds all of them.
    std::erase_if(material.pieces, [&](const audio::PieceFeatures& piece) {
        const auto& left_out = options.recordings.left_out_genres;
        return std::find(left_out.begin(), left_out.end(), audio::shown_genre(piece.genre)) !=
               left_out.end();
    });
    if (material.pieces.empty() && !material.files.empty()) {
        return fail(fmt::format("none of the {} files can be learnt from", material.files.size()));
    }
    if (material.pieces.empty()) {
        return fail("no music: name a folder, or --synthesize N with --soundfont X.sf2");
    }
    return material;
}

}  // namespace raks::apps
