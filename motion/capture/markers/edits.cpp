#include "motion/capture/markers/edits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <utility>

#include "base/printable.hpp"
#include "base/suggest.hpp"
#include "motion/skeleton/text_lines.hpp"

namespace raks::capture {
namespace {

using Json = nlohmann::json;

constexpr std::array<std::string_view, 5> kEditNames = {"set", "hide", "swap", "fill", "exchange"};

// The keys that each kind has, beside "edit".
std::span<const std::string_view> keys_of(EditKind kind) {
    static constexpr std::array<std::string_view, 5> kSet = {"frame", "camera", "marker", "u", "v"};
    static constexpr std::array<std::string_view, 4> kHide = {"marker", "camera", "first", "last"};
    static constexpr std::array<std::string_view, 3> kFill = {"marker", "first", "last"};
    static constexpr std::array<std::string_view, 3> kSwap = {"frame", "marker", "other"};
    static constexpr std::array<std::string_view, 4> kExchange = {
        "camera", "limbs", "first", "last"};
    switch (kind) {
        case EditKind::set:
            return kSet;
        case EditKind::swap:
            return kSwap;
        case EditKind::hide:
            return kHide;
        case EditKind::fill:
            return kFill;
        case EditKind::exchange:
            return kExchange;
    }
    return {};
}

Expected<std::string> text_at(const Json& line, const std::string& key) {
    if (!line.contains(key) || !line[key].is_string() || line[key].get<std::string>().empty()) {
        return fail(fmt::format("needs \"{}\" with a name", key));
    }
    return line[key].get<std::string>();
}

Expected<std::string> limbs_at(const Json& line) {
    auto limbs = text_at(line, "limbs");
    return limbs && (*limbs == "arms" || *limbs == "legs")
               ? limbs
               : fail("needs \"limbs\" with arms or legs, or none for both");
}

Expected<std::size_t> frame_at(const Json& line, const std::string& key) {
    constexpr std::uint64_t kMostFrames = 100'000'000;
    if (!line.contains(key) || !line[key].is_number_unsigned() ||
        line[key].get<std::uint64_t>() > kMostFrames) {
        return fail(fmt::format("needs \"{}\" with a frame, a whole number from 0", key));
    }
    return static_cast<std::size_t>(line[key].get<std::uint64_t>());
}

Expected<double> pixel_at(const Json& line, const std::string& key) {
    constexpr double kFarthestEdit = 1e5;
    if (!line.contains(key) || !line[key].is_number() ||
        !(std::abs(line[key].get<double>()) <= kFarthestEdit)) {
        return fail(fmt::format("needs \"{}\" with a number of pixels", key));
    }
    return line[key].get<double>();
}

// Stores a value or keeps the first error.
class EditValues {
 public:
    template <typename Value>
    void take(Expected<Value> value, Value& target) {
        if (value) {
            target = std::move(*value);
        } else if (!fault_) {
            fault_ = std::move(value.error());
        }
    }
    [[nodiscard]] const std::optional<Error>& fault() const { return fault_; }

 private:
    std::optional<Error> fault_;
};

Expected<Edit> edit_of(const Json& line) {
    if (!line.is_object() || !line.contains("edit") || !line["edit"].is_string()) {
        return fail("needs {\"edit\": \"set\", ...}, or hide, swap, fill, exchange");
    }
    const std::string name = line["edit"].get<std::string>();
    const auto* const kind = std::find(kEditNames.begin(), kEditNames.end(), name);
    if (kind == kEditNames.end()) {
        return fail(unknown_name("edit", printable(name, 40), kEditNames));
    }
    Edit edit;
    edit.kind = static_cast<EditKind>(kind - kEditNames.begin());
    const auto keys = keys_of(edit.kind);
    for (const auto& [key, value] : line.items()) {
        if (key != "edit" && std::find(keys.begin(), keys.end(), key) == keys.end()) {
            return fail(unknown_name("key", printable(key, 40), keys));
        }
    }
    EditValues values;
    const bool is_of_camera = line.contains("camera");
    if (edit.kind != EditKind::exchange &&
        (edit.kind != EditKind::hide || !is_of_camera || line.contains("marker"))) {
        values.take(text_at(line, "marker"), edit.marker);
    }
    if (edit.kind == EditKind::set || edit.kind == EditKind::exchange || is_of_camera) {
        values.take(text_at(line, "camera"), edit.camera);
    }
    if (edit.kind == EditKind::set) {
        values.take(pixel_at(line, "u"), edit.pixel.x);
        values.take(pixel_at(line, "v"), edit.pixel.y);
    }
    if (edit.kind == EditKind::swap) {
        values.take(text_at(line, "other"), edit.other);
    }
    if (line.contains("limbs")) {
        values.take(limbs_at(line), edit.limbs);
    }
    const bool is_stretch = edit.kind != EditKind::set && edit.kind != EditKind::swap;
    values.take(frame_at(line, is_stretch ? "first" : "frame"), edit.first);
    edit.last = edit.first;
    if (is_stretch) {
        values.take(frame_at(line, "last"), edit.last);
    }
    if (values.fault()) {
        return fail(*values.fault());
    }
    if (edit.last < edit.first) {
        return fail("its last frame comes before its first");
    }
    if (edit.kind == EditKind::swap && edit.marker == edit.other) {
        return fail("a marker cannot be swapped with itself");
    }
    return edit;
}

Json json_of(const Edit& edit) {
    Json line = {{"edit", kEditNames[static_cast<std::size_t>(edit.kind)]}};
    for (const auto& [key, value] : {std::pair("marker", &edit.marker),
                                     {"other", &edit.other},
                                     {"camera", &edit.camera},
                                     {"limbs", &edit.limbs}}) {
        if (!value->empty()) {
            line[key] = *value;
        }
    }
    if (edit.kind == EditKind::set || edit.kind == EditKind::swap) {
        line["frame"] = edit.first;
    } else {
        line["first"] = edit.first;
        line["last"] = edit.last;
    }
    if (edit.kind == EditKind::set) {
        line["u"] = edit.pixel.x;
        line["v"] = edit.pixel.y;
    }
    return line;
}

}  // namespace

std::string edits_text(const std::vector<Edit>& edits) {
    std::string text;
    for (const Edit& edit : edits) {
        text += json_of(edit).dump() + '\n';
    }
    return text;
}

Expected<std::vector<Edit>> read_edits(std::string_view text, const std::string& file) {
    std::vector<Edit> edits;
    for (const motion::Line& line : motion::split_lines(text)) {
        const Json json = Json::parse(line.text, nullptr, false);
        Expected<Edit> edit = json.is_discarded() ? fail("is not JSON") : edit_of(json);
        if (!edit) {
            return fail(fmt::format("{}: line {}: {}", file, line.number, edit.error().message));
        }
        edits.push_back(std::move(*edit));
    }
    return edits;
}

}  // namespace raks::capture
