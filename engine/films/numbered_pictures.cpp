#include "engine/films/numbered_pictures.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <string>

#include "base/file.hpp"

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

bool is_digit(char character) { return character >= '0' && character <= '9'; }

bool is_picture(const fs::path& path) {
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char letter) {
        return static_cast<char>(std::tolower(letter));
    });
    return ending == ".png" || ending == ".jpg" || ending == ".jpeg";
}

// The last number in a name; none where there is no digit, or too many.
std::optional<std::int64_t> last_number(const std::string& stem) {
    const auto end = std::find_if(stem.rbegin(), stem.rend(), is_digit).base();
    const auto begin =
        std::find_if_not(std::make_reverse_iterator(end), stem.rend(), is_digit).base();
    std::int64_t number = 0;
    const std::string digits(begin, end);
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return read.ec == std::errc() ? std::optional(number) : std::nullopt;
}

}  // namespace

Expected<std::vector<NumberedPicture>> list_numbered_pictures(const fs::path& folder) {
    const auto files = list_folder(folder);
    if (!files) {
        return fail(files.error());
    }
    std::vector<NumberedPicture> pictures;
    for (const fs::path& file : *files) {
        const auto number = is_picture(file) ? last_number(file.stem().string()) : std::nullopt;
        if (number) {
            pictures.push_back({file, *number});
        }
    }
    if (pictures.empty()) {
        return fail(folder.string() + ": has no numbered pictures (such as 0001.png or 0001.jpg)");
    }
    std::stable_sort(pictures.begin(), pictures.end(), [](const auto& a, const auto& b) {
        return a.number < b.number;
    });
    const auto twice =
        std::adjacent_find(pictures.begin(), pictures.end(), [](const auto& a, const auto& b) {
            return a.number == b.number;
        });
    if (twice != pictures.end()) {
        return fail(folder.string() + ": " + twice->path.filename().string() + " and " +
                    std::next(twice)->path.filename().string() +
                    " have the same number; keep one of them");
    }
    return pictures;
}

}  // namespace raks::engine
