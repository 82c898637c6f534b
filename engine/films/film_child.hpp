#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "audio/io/decode_protocol.hpp"
#include "base/descriptor.hpp"
#include "base/talking_child.hpp"
#include "engine/films/film_reader.hpp"

namespace raks::engine {

/// A running raks-decode --pictures, which decodes one film after the other. Trusts nothing that it
/// says. For engine/films alone. Threads: one. Real-time: no.
class FilmChild {
 public:
    /// A new one. Errors: it is not installed, cannot be started.
    [[nodiscard]] static Expected<std::unique_ptr<FilmChild>> start(
        std::function<bool()> is_stop_requested);
    /// Opens the next film, of which all pictures must have been read before.
    [[nodiscard]] Expected<FilmInfo> open(const std::filesystem::path& path);
    /// The next picture; none at the end, or where the child broke off: see warning().
    [[nodiscard]] Expected<std::optional<FilmPicture>> next();
    /// Of the film that was opened last.
    [[nodiscard]] const std::string& warning() const noexcept { return warning_; }

 private:
    FilmChild() = default;
    [[nodiscard]] Patience patience() const;
    [[nodiscard]] Talk receive();
    [[nodiscard]] std::string end(Talk why);
    [[nodiscard]] Expected<std::optional<FilmPicture>> break_off(Talk why);

    std::optional<TalkingChild> child_;
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
