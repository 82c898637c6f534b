#include "audio/evaluate/text_lines.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

namespace raks::audio {
namespace {

constexpr std::array<const char*, 6> kSoundExtensions = {
    ".ogg", ".wav", ".flac", ".mp3", ".opus", ".m4a"};

}  // namespace

bool TextLines::next() {
    while (!rest_.empty()) {
        const std::size_t end = std::min(rest_.find('\n'), rest_.size());
        line_ = rest_.substr(0, end);
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
        ++number_;
        if (!line_.empty() && line_.back() == '\r') {
            line_.remove_suffix(1);
        }
        if (line_.find_first_not_of(" \t") != std::string_view::npos && line_.front() != '#') {
            return true;
        }
    }
    return false;
}

std::string TextLines::place_in(const std::string& file) const {
    return fmt::format("{}: line {}", file, number_);
}

std::string shown(std::string_view text) {
    std::string result(text.substr(0, 20));
    std::replace_if(
        result.begin(), result.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return result;
}

std::string_view take_word(std::string_view& line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(" \t"));
    line.remove_prefix(word.size());
    return word;
}

// from_chars ignores the locale, and it reads "inf" and "nan", which are refused here.
std::optional<double> number_of(std::string_view word) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool is_number = error == std::errc() && end == word.data() + word.size();
    return is_number && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

Expected<std::filesystem::path> find_sound(const std::filesystem::path& folder,
                                           const std::string& name) {
    for (const char* extension : kSoundExtensions) {
        const std::filesystem::path path = folder / (name + extension);
        std::error_code ignored;
        if (std::filesystem::is_regular_file(path, ignored)) {
            return path;
        }
    }
    return fail(fmt::format("{}: is missing; neither is there a {}",
                            (folder / (name + kSoundExtensions.front())).string(),
                            fmt::join(kSoundExtensions.begin() + 1, kSoundExtensions.end(), ", ")));
}

}  // namespace raks::audio
