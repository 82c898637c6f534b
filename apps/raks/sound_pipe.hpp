#pragma once

#include <memory>

#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "audio/io/pipe_reader.hpp"
#include "base/expected.hpp"

namespace raks::apps {

/// Opens what comes through a pipe; a signal ends the waiting for it. Errors: as PipeReader::open.
[[nodiscard]] inline Expected<std::unique_ptr<audio::PipeReader>> open_sound_pipe(
    const Path& path) {
    audio::PipeOptions options;
    options.is_stop_requested = [] { return stop_signal().has_value(); };
    say_detail("waiting for the pipe " + path.string());
    return audio::PipeReader::open(path, options);
}

}  // namespace raks::apps
