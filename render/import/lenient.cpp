#include "render/import/lenient.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/printable.hpp"

namespace raks::render {
namespace {

constexpr std::size_t kLongestText = 397;  // bytes of a line that says who made a model
constexpr float kMost = std::numeric_limits<float>::max();

/// Reads by `read(field)`, with `remedy` as a warning after a fault.
template <typename Read>
bool is_read(const JsonField& field, std::string_view remedy, Model& model, const Read& read) {
    JsonFaults faults;
    read(field.noting_to(faults));
    const Expected<void> done = faults.finish();
    if (!done) {
        warn(model, field.line(fmt::format("{}; {}", done.error().message, remedy)));
    }
    return done.has_value();
}

float clamped(const JsonField& field, float number, NumberLimits limits, Model& model) {
    const float inside = std::clamp(number, limits.lowest, limits.highest);
    if (inside != number) {
        warn(model,
             field.line(fmt::format("{} is not in {} .. {}; taken as {}",
                                    number,
                                    limits.lowest,
                                    limits.highest,
                                    inside)));
    }
    return inside;
}

}  // namespace

float lenient_number(const JsonField& field, NumberLimits limits, Model& model) {
    if (!field.exists()) {
        return limits.otherwise;
    }
    float number = limits.otherwise;
    const bool is_number =
        is_read(field, fmt::format("taken as {}", limits.otherwise), model, [&](JsonField own) {
            number = own.number(-kMost, kMost);
        });
    return is_number ? clamped(field, number, limits, model) : limits.otherwise;
}

glm::vec3 lenient_vector(const JsonField& field,
                         NumberLimits limits,
                         const glm::vec3& otherwise,
                         Model& model) {
    std::array<float, 3> numbers = {otherwise.x, otherwise.y, otherwise.z};
    if (!field.exists()) {
        return otherwise;
    }
    const bool is_vector =
        is_read(field, "the default is taken", model, [&numbers](const JsonField& own) {
            numbers = own.numbers_or(numbers);
        });
    if (!is_vector) {
        return otherwise;
    }
    return {clamped(field, numbers[0], limits, model),
            clamped(field, numbers[1], limits, model),
            clamped(field, numbers[2], limits, model)};
}

glm::vec3 lenient_xyz(const JsonField& field, NumberLimits limits, Model& model) {
    return {lenient_number(field["x"], limits, model),
            lenient_number(field["y"], limits, model),
            lenient_number(field["z"], limits, model)};
}

bool lenient_truth(const JsonField& field, bool otherwise, Model& model) {
    bool truth = otherwise;
    if (!is_read(field, "left out", model, [&](const JsonField& own) {
            truth = own.truth_or(otherwise);
        })) {
        return otherwise;
    }
    return truth;
}

std::string lenient_text(const JsonField& field, Model& model) {
    std::string_view text;
    if (!is_read(
            field, "left out", model, [&text](const JsonField& own) { text = own.text_or({}); })) {
        return {};
    }
    std::string fit = printable(text, kLongestText);
    if (fit != text) {
        warn(model, field.line("is too long for a line, or holds control characters; mended"));
    }
    return fit;
}

std::size_t lenient_choice(const JsonField& field,
                           std::initializer_list<std::string_view> words,
                           Model& model) {
    std::size_t choice = 0;
    const std::string remedy = fmt::format("taken as {}", *words.begin());
    const bool is_one = is_read(
        field, remedy, model, [&](const JsonField& own) { choice = own.choice_or(0, words); });
    return is_one ? choice : 0;
}

TextureUse lenient_texture(const JsonField& field, Model& model) {
    TextureUse use;
    if (!is_read(field, "drawn without", model, [&](const JsonField& own) {
            use = read_texture_use(own, model);
        })) {
        return {};
    }
    return use;
}

}  // namespace raks::render
