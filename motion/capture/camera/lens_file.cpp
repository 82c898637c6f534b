#include "motion/capture/camera/lens_file.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/file.hpp"
#include "base/printable.hpp"

namespace raks::capture {

namespace {

constexpr std::size_t kLongestFile = std::size_t{1} << 20U;
constexpr std::string_view kMatrixTag = "!!opencv-matrix";

std::string_view trimmed(std::string_view text) noexcept {
    constexpr std::string_view kBlanks = " \t\r";
    const std::size_t from = std::min(text.find_first_not_of(kBlanks), text.size());
    text.remove_prefix(from);
    return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

// "10.", "1e+02" and "-.5" are numbers; ".Nan" and "nan" are none that is of use.
std::optional<double> finite_number(std::string_view text) noexcept {
    text = trimmed(text);
    double value = 0.0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_whole_text = result.ptr == text.data() + text.size();
    return result.ec == std::errc() && is_whole_text && std::isfinite(value) ? std::optional(value)
                                                                             : std::nullopt;
}

// The value of a key at the outermost level, and for a matrix those within.
struct Entry {
    std::size_t line = 0;
    std::string value;
    std::map<std::string, std::string, std::less<>> inner;
};
using Entries = std::map<std::string, Entry, std::less<>>;

// Splits the text into its keys. Lines that go on (a list in brackets) are joined.
Expected<Entries> split(std::string_view text, const std::string& name) {
    Entries entries;
    Entry* entry = nullptr;
    std::string* open_value = nullptr;
    std::size_t number = 0;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        ++number;
        const std::string_view content = trimmed(line);
        const std::size_t colon = content.find(": ");
        const bool is_heading = content.ends_with(':');
        if (content.empty() || content.front() == '#' || content.front() == '%' ||
            content == "---" || content == "...") {
            continue;
        }
        const bool is_inner = line.front() == ' ' || line.front() == '\t';
        if (colon == std::string_view::npos && !is_heading) {
            if (open_value != nullptr && is_inner) {
                *open_value += ' ';
                *open_value += content;
            }
            continue;
        }
        const std::string key(content.substr(0, is_heading ? content.size() - 1 : colon));
        const std::string_view value =
            is_heading ? std::string_view() : trimmed(content.substr(colon + 1));
        if (!is_inner) {
            const auto [place, is_new] = entries.try_emplace(key);
            if (!is_new) {
                return fail(fmt::format(
                    "{}: line {}: key {} is there twice", name, number, printable(key)));
            }
            entry = &place->second;
            entry->line = number;
            entry->value = value;
            open_value = &entry->value;
        } else if (entry != nullptr) {
            open_value = &entry->inner.try_emplace(key).first->second;
            *open_value = value;
        }
    }
    return entries;
}

// Reads single values, and keeps where they stood for messages.
class EntryReader {
 public:
    EntryReader(const Entries& entries, const std::string& name) : entries_(entries), name_(name) {}

    Expected<const Entry*> entry(std::string_view key) const {
        const auto found = entries_.find(key);
        if (found == entries_.end()) {
            return fail(
                fmt::format("{}: has no {}: is it a lens that OpenCV calibrated?", name_, key));
        }
        return &found->second;
    }

    Expected<int> picture_size(std::string_view key) const {
        const auto found = entry(key);
        if (!found) {
            return fail(found.error());
        }
        constexpr double kLargest = 65'535.0;
        const std::optional<double> value = finite_number((*found)->value);
        if (!value || *value < 1.0 || *value > kLargest || *value != std::floor(*value)) {
            return fail(complaint(**found, key, "must be a whole number of pixels"));
        }
        return static_cast<int>(*value);
    }

    Expected<std::vector<double>> matrix(std::string_view key) const {
        const auto found = entry(key);
        if (!found) {
            return fail(found.error());
        }
        const Entry& matrix = **found;
        const auto inner = [&](std::string_view part) -> std::string_view {
            const auto at = matrix.inner.find(part);
            return at == matrix.inner.end() ? std::string_view() : std::string_view(at->second);
        };
        const std::optional<double> rows = finite_number(inner("rows"));
        const std::optional<double> columns = finite_number(inner("cols"));
        std::string_view data = inner("data");
        if (matrix.value != kMatrixTag || !rows || !columns || !data.starts_with('[') ||
            !data.ends_with(']')) {
            return fail(complaint(
                matrix, key, "must be an !!opencv-matrix with rows, cols, dt and data: [ ... ]"));
        }
        data = data.substr(1, data.size() - 2);
        std::vector<double> numbers;
        while (!trimmed(data).empty()) {
            const std::string_view word = data.substr(0, data.find(','));
            data.remove_prefix(std::min(word.size() + 1, data.size()));
            const std::optional<double> number = finite_number(word);
            if (!number) {
                return fail(complaint(
                    matrix, key, fmt::format("\"{}\" is no number", printable(trimmed(word), 40))));
            }
            numbers.push_back(*number);
        }
        if (static_cast<double>(numbers.size()) != *rows * *columns) {
            return fail(complaint(
                matrix,
                key,
                fmt::format("has {} numbers, not {} x {}", numbers.size(), *rows, *columns)));
        }
        return numbers;
    }

    std::string complaint(const Entry& entry, std::string_view key, std::string_view what) const {
        return fmt::format("{}: line {}: {} {}", name_, entry.line, key, what);
    }

 private:
    const Entries& entries_;
    const std::string& name_;
};

Expected<void> read_camera_matrix(const EntryReader& reader, Lens& lens) {
    constexpr std::string_view kKey = "camera_matrix";
    const auto m = reader.matrix(kKey);
    if (!m) {
        return fail(m.error());
    }
    const Entry& entry = **reader.entry(kKey);
    if (m->size() != 9) {
        return fail(reader.complaint(entry, kKey, "must be 3 x 3"));
    }
    const std::vector<double>& k = *m;
    if (k[1] != 0.0 || k[3] != 0.0 || k[6] != 0.0 || k[7] != 0.0 || k[8] != 1.0) {
        return fail(
            reader.complaint(entry, kKey, "must be fx 0 cx 0 fy cy 0 0 1: skew is not known"));
    }
    if (!(k[0] > 0.0) || !(k[4] > 0.0)) {
        return fail(reader.complaint(entry, kKey, "has a focal length that is not positive"));
    }
    lens.fx = k[0];
    lens.cx = k[2];
    lens.fy = k[4];
    lens.cy = k[5];
    return {};
}

Expected<void> read_distortion(const EntryReader& reader, Lens& lens) {
    constexpr std::string_view kKey = "distortion_coefficients";
    const auto k = reader.matrix(kKey);
    if (!k) {
        return fail(k.error());
    }
    if (k->size() != 4 && k->size() != 5 && k->size() != 8) {
        return fail(reader.complaint(
            **reader.entry(kKey), kKey, "must be 4, 5 or 8 numbers: k1 k2 p1 p2 k3 ..."));
    }
    std::copy(k->begin(), k->end(), lens.distortion.begin());
    return {};
}

std::string numbers_text(const std::vector<double>& numbers) {
    std::string text;
    for (const double number : numbers) {
        std::string word = fmt::format("{}", number);
        if (word.find_first_of(".e") == std::string::npos) {
            word += '.';
        }
        text += (text.empty() ? " " : ", ") + word;
    }
    return text;
}

std::string matrix_text(std::string_view key, int rows, const std::vector<double>& numbers) {
    return fmt::format("{}: {}\n   rows: {}\n   cols: {}\n   dt: d\n   data: [{} ]\n",
                       key,
                       kMatrixTag,
                       rows,
                       static_cast<int>(numbers.size()) / rows,
                       numbers_text(numbers));
}

}  // namespace

Expected<Lens> parse_lens_yaml(std::string_view text, const std::string& name) {
    if (text.size() > kLongestFile) {
        return fail(fmt::format("{}: has {} bytes, more than {}", name, text.size(), kLongestFile));
    }
    if (!text.starts_with("%YAML")) {
        return fail(fmt::format("{}: line 1: does not begin with %YAML:1.0", name));
    }
    const Expected<Entries> entries = split(text, name);
    if (!entries) {
        return fail(entries.error());
    }
    const EntryReader reader(*entries, name);
    const Expected<int> width = reader.picture_size("image_width");
    const Expected<int> height = reader.picture_size("image_height");
    if (!width || !height) {
        return fail(!width ? width.error() : height.error());
    }
    Lens lens;
    lens.width = *width;
    lens.height = *height;
    if (const Expected<void> read = read_camera_matrix(reader, lens); !read) {
        return fail(read.error());
    }
    if (const Expected<void> read = read_distortion(reader, lens); !read) {
        return fail(read.error());
    }
    return lens;
}

Expected<Lens> read_lens_yaml(const std::filesystem::path& path) {
    const Expected<std::string> text = read_text_file(path, kLongestFile);
    return text ? parse_lens_yaml(*text, path.string()) : fail(text.error());
}

std::string lens_yaml_text(const Lens& lens) {
    const auto& k = lens.distortion;
    const bool is_long = k[5] != 0.0 || k[6] != 0.0 || k[7] != 0.0;
    return fmt::format(
               "%YAML:1.0\n---\nimage_width: {}\nimage_height: {}\n", lens.width, lens.height) +
           matrix_text(
               "camera_matrix", 3, {lens.fx, 0.0, lens.cx, 0.0, lens.fy, lens.cy, 0.0, 0.0, 1.0}) +
           matrix_text("distortion_coefficients", 1, {k.begin(), k.begin() + (is_long ? 8 : 5)});
}

}  // namespace raks::capture
