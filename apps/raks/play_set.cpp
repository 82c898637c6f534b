#include "apps/raks/play_set.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>

#include "apps/raks/sound_pipe.hpp"
#include "apps/terminal/program.hpp"
#include "audio/io/audio_file.hpp"
#include "engine/offline/music_source.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// The part of the arguments that says in which order files are played.
engine::PlayOrderOptions order_of(const PlayArguments& arguments) {
    engine::PlayOrderOptions options;
    if (arguments.is_shuffled) {
        options.shuffle_seed = static_cast<std::uint64_t>(arguments.settings.seed);
    }
    options.repeats = arguments.repeats;
    return options;
}

}  // namespace

Expected<std::unique_ptr<audio::PipeReader>> open_pipe(const Path& path, const Section& section) {
    if (section.start > 0.0) {
        return fail(path.string() +
                    ": comes through a pipe, which plays from its beginning; "
                    "leave --start out");
    }
    return open_sound_pipe(path);
}

Expected<void> check_file(const Path& path, const Section& section, const IsStopped& is_stopped) {
    const auto file = audio::open_audio_file(path, is_stopped);
    if (!file) {
        return fail(file.error());
    }
    const auto length = (*file)->info().claimed_seconds;
    return length && section.start >= *length && section.start > 0.0
               ? fail(engine::starts_behind_end(path, *length, section.start))
               : Expected<void>();
}

std::string nothing_played(const engine::SkippedFiles& skipped) {
    const std::string& first = skipped.lines().front();
    return skipped.count() == 1 ? first
                                : fmt::format("{} (and {} more; none of the files can be played)",
                                              first,
                                              skipped.count() - 1);
}

PlaySet::PlaySet(engine::PlayList list, const PlayArguments& arguments)
    : list_(std::move(list)),
      section_(arguments.section),
      order_(list_.files.size(), order_of(arguments)),
      is_stopped_([] { return stop_signal().has_value(); }) {}

Expected<void> PlaySet::check(const Path& path) const {
    return engine::is_pipe(path) ? Expected<void>() : check_file(path, section_, is_stopped_);
}

Expected<void> PlaySet::open_first() {
    const Path& path = *current();
    if (!engine::is_pipe(path)) {
        return check(path);
    }
    auto pipe = open_pipe(path, section_);
    if (!pipe) {
        return fail(pipe.error());
    }
    pipe_ = std::move(*pipe);
    return {};
}

Expected<void> PlaySet::begin() {
    while (current() != nullptr) {
        const auto opened = open_first();
        if (opened) {
            return {};
        }
        if (stop_signal()) {
            return fail("stopped before anything was played");
        }
        skip_current(opened.error().message);
    }
    return fail(nothing_played(skipped()));
}

const Path* PlaySet::current() const {
    const auto file = order_.current();
    return file ? &list_.files[*file] : nullptr;
}

bool PlaySet::has_next() {
    while (const auto next = order_.next()) {
        const auto checked = check(list_.files[*next]);
        if (checked || is_stopped_()) {
            break;
        }
        list_.skipped.add(checked.error().message);
        order_.drop_next();
    }
    return order_.has_next();
}

Path PlaySet::next() const {
    const auto next = order_.next();
    return next && !engine::is_pipe(list_.files[*next]) ? list_.files[*next] : Path();
}

std::vector<std::string> PlaySet::names(std::size_t most) const {
    std::vector<std::string> names;
    const auto files = std::span(order_.files()).first(std::min(most, size()));
    std::transform(files.begin(), files.end(), std::back_inserter(names), [this](std::size_t file) {
        const Path& path = list_.files[file];
        return path == "-" ? std::string("standard input") : path.filename().string();
    });
    return names;
}

Expected<std::size_t> PlaySet::add(const std::vector<Path>& given) {
    auto list = engine::read_play_list(given);
    if (!list) {
        return fail(list.error());
    }
    order_.append(list_.files.size(), list->files.size());
    list_.files.insert(list_.files.end(), list->files.begin(), list->files.end());
    for (const std::string& line : list->skipped.lines()) {
        list_.skipped.add(line);
    }
    return list->files.size();
}

}  // namespace raks::apps
