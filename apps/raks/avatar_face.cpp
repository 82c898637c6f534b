#include "apps/raks/avatar_face.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <string>
#include <system_error>

#include "base/printable.hpp"
#include "base/suggest.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

Expected<float> parse_weight(std::string_view text, std::string_view name) {
    float weight = 0.0F;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, weight);
    // Written so that NaN is a fault.
    if (error != std::errc() || rest != end || !(weight >= 0.0F && weight <= 1.0F)) {
        return fail(fmt::format("--expression: {} is \"{}\", must be a number from 0 to 1",
                                printable(std::string(name)),
                                printable(std::string(text))));
    }
    return weight;
}

Expected<std::size_t> find_expression(std::string_view name, const render::AvatarRig& rig) {
    const int index = rig.expressions.find(name);
    if (index >= 0) {
        return static_cast<std::size_t>(index);
    }
    if (rig.expressions.size() == 0) {
        return fail("--expression: the model has no expressions");
    }
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < rig.expressions.size(); ++i) {
        names.push_back(rig.expressions.name(i));
    }
    return fail(unknown_name("expression", printable(std::string(name)), names));
}

Expected<void> put_on_one(std::string_view word,
                          const render::AvatarRig& rig,
                          render::RigState& state) {
    const std::size_t equals = word.rfind('=');
    if (equals == std::string_view::npos || equals == 0) {
        return fail(fmt::format("--expression is \"{}\", must be like happy=1,blink=0.6",
                                printable(std::string(word))));
    }
    const auto index = find_expression(word.substr(0, equals), rig);
    if (!index) {
        return fail(index.error());
    }
    const auto weight = parse_weight(word.substr(equals + 1), word.substr(0, equals));
    if (!weight) {
        return fail(weight.error());
    }
    state.weights[*index] = *weight;
    return {};
}

}  // namespace

Expected<void> put_on_face(std::string_view text,
                           const render::AvatarRig& rig,
                           render::RigState& state) {
    std::fill(state.weights.begin(), state.weights.end(), 0.0F);
    while (!text.empty()) {
        const std::size_t comma = std::min(text.find(','), text.size());
        if (auto done = put_on_one(text.substr(0, comma), rig, state); !done) {
            return done;
        }
        text.remove_prefix(std::min(comma + 1, text.size()));
    }
    rig.expressions.apply(state.weights, state.face);
    return {};
}

std::vector<MorphWeight> morph_weights(const render::Model& model,
                                       const render::AvatarRig& rig,
                                       const render::RigState& state) {
    std::vector<MorphWeight> weights;
    for (std::size_t node = 0; node < model.nodes.size(); ++node) {
        const render::MorphRange range = rig.expressions.morphs_of(static_cast<int>(node));
        for (std::size_t target = 0; target < range.count; ++target) {
            const float weight = state.face.morphs[range.first + target];
            if (weight != 0.0F) {
                weights.push_back({static_cast<int>(node), target, weight});
            }
        }
    }
    return weights;
}

}  // namespace raks::apps
