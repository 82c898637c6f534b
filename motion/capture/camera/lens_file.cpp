#include "motion/capture/camera/lens_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "base/file.hpp"

namespace raks::capture {

namespace {

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
                       kYamlMatrixTag,
                       rows,
                       static_cast<int>(numbers.size()) / rows,
                       numbers_text(numbers));
}

}  // namespace

Expected<void> read_lens_matrix(const YamlEntries& reader, std::string_view key, Lens& lens) {
    const auto m = reader.matrix(key);
    if (!m) {
        return fail(m.error());
    }
    if (m->size() != 9) {
        return fail(reader.complaint(key, "must be 3 x 3"));
    }
    const std::vector<double>& k = *m;
    if (k[1] != 0.0 || k[3] != 0.0 || k[6] != 0.0 || k[7] != 0.0 || k[8] != 1.0) {
        return fail(
            reader.complaint(key, "must be fx 0 cx 0 fy cy 0 0 1: a skewed lens cannot be used"));
    }
    if (!(k[0] > 0.0) || !(k[4] > 0.0)) {
        return fail(reader.complaint(key, "has a focal length that is not positive"));
    }
    lens.fx = k[0];
    lens.cx = k[2];
    lens.fy = k[4];
    lens.cy = k[5];
    return {};
}

Expected<void> read_lens_distortion(const YamlEntries& reader, std::string_view key, Lens& lens) {
    const auto k = reader.matrix(key);
    if (!k) {
        return fail(k.error());
    }
    if (k->size() != 4 && k->size() != 5 && k->size() != 8) {
        return fail(reader.complaint(key, "must be 4, 5 or 8 numbers: k1 k2 p1 p2 k3 ..."));
    }
    std::copy(k->begin(), k->end(), lens.distortion.begin());
    return {};
}

Expected<Lens> parse_lens_yaml(std::string_view text, const std::string& name) {
    const Expected<YamlEntries> read = YamlEntries::parse(text, name);
    if (!read) {
        return fail(read.error());
    }
    const YamlEntries& reader = *read;
    const Expected<int> width = reader.picture_size("image_width");
    const Expected<int> height = reader.picture_size("image_height");
    if (!width || !height) {
        return fail(!width ? width.error() : height.error());
    }
    Lens lens;
    lens.width = *width;
    lens.height = *height;
    auto done = read_lens_matrix(reader, "camera_matrix", lens);
    if (done) {
        done = read_lens_distortion(reader, "distortion_coefficients", lens);
    }
    return done ? Expected<Lens>(lens) : fail(std::move(done.error()));
}

Expected<Lens> read_lens_yaml(const std::filesystem::path& path) {
    const Expected<std::string> text = read_text_file(path, kLongestYaml);
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
