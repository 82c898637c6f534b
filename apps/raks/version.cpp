#include "apps/raks/version.hpp"

#include <optional>
#include <string_view>

#include "apps/raks/build_facts.hpp"
#include "base/program_parts.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Of a function that takes nothing and says something of its library; nothing: the module, or the
// library that it is linked with, is not there. A module gives the functions of its libraries, too.
std::optional<std::string> said_by(const char* module, const char* variable, const char* function) {
    const auto found = load_program_part(module, "lib/raks", variable, function);
    if (!found) {
        return std::nullopt;
    }
    return reinterpret_cast<const char* (*)()>(*found)();
}

std::optional<std::string> said_by_films(const char* function) {
    return said_by("raks-film.so", "RAKS_FILM_MODULE", function);
}

// FFmpeg says under which licence it was built: Debian's, with x264, is under the GPL.
std::string licence_with(const std::optional<std::string>& of_ffmpeg) {
    constexpr std::string_view kOwn = "Raks's own code: MIT OR Apache-2.0";
    return of_ffmpeg ? fmt::format("{}, as of its FFmpeg; {}", *of_ffmpeg, kOwn)
                     : fmt::format("{}; raks-decode is under that of its FFmpeg", kOwn);
}

}  // namespace

std::string version_text() {
    const BuildFacts facts = build_facts();
    const auto pipewire =
        said_by("raks-pipewire.so", "RAKS_PIPEWIRE_MODULE", "pw_get_library_version");
    return fmt::format(
        "raks {}\n"
        "commit    {}\n"
        "compiler  {}\n"
        "FFmpeg    {}\n"
        "PipeWire  {}\n"
        "licence   {}",
        facts.version,
        facts.commit,
        facts.compiler,
        said_by_films("av_version_info").value_or("none: no films, but folders of pictures"),
        pipewire.value_or("none: no --video-out pipewire"),
        licence_with(said_by_films("avcodec_license")));
}

}  // namespace raks::apps
