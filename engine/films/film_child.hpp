#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "audio/io/decode_protocol.hpp"
#include "audio/io/decoder_spawn.hpp"
#include "base/descriptor.hpp"
#include "engine/films/film_reader.hpp"

namespace raks::engine {

/// A running raks-decode --pictures, which decodes one film after the other. Trusts nothing that it
/// says. For engine/films alone. Threads: one. Real-time: no.
class FilmChild {
 public:
    /// A new one. Errors: it is not installed, cannot be started.
    [[nodiscard]] static Expected<std::unique_ptr<FilmChild>> start(
        std::function<bool()> is_stop_requested);
    /// Kills it and waits for its end.
    ~FilmChild();
    FilmChild(const FilmChild&) = delete;             ///< one owner
    FilmChild& operator=(const FilmChild&) = delete;  ///< likewise

    /// Opens the next film, of which all pictures must have been read before.
    [[nodiscard]] Expected<FilmInfo> open(const std::filesystem::path& path);
    /// The next picture; none at the end, or where the child broke off: see warning().
    [[nodiscard]] Expected<std::optional<FilmPicture>> next();
    /// Of the film that was opened last.
    [[nodiscard]] const std::string& warning() const noexcept { return warning_; }

 private:
    FilmChild() = default;
    [[nodiscard]] audio::Waited wait(int descriptor) const;
    [[nodiscard]] audio::Waited receive();
    [[nodiscard]] audio::Waited read_pixels(std::span<std::uint8_t> bytes);
    [[nodiscard]] std::string end(audio::Waited why);
    [[nodiscard]] Expected<std::optional<FilmPicture>> break_off(audio::Waited why);

    pid_t pid_ = -1;
    Descriptor socket_;
    Descriptor pictures_;
    Descriptor lifeline_;
    std::function<bool()> is_stop_requested_;
    std::string name_;
    std::string warning_;
    bool has_film_ = false;
    std::optional<double> newest_;  // seconds
    audio::DecodeMessage message_;
};

}  // namespace raks::engine
