#include "engine/outputs/osc_target.hpp"

#include <algorithm>
#include <array>

#include "base/printable.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

constexpr std::array<std::string_view, 3> kPresets = {"raks", "plain", "resolume"};
constexpr std::uint16_t kResolumePort = 7000;
constexpr std::size_t kLongestPrefix = 64;
constexpr double kMostRate = 120.0;

// What OSC allows in an address.
bool is_prefix(std::string_view text) {
    const bool is_plain = std::all_of(text.begin(), text.end(), [](char c) {
        return c > ' ' && c < 127 && std::string_view("#*,?[]{}").find(c) == std::string_view::npos;
    });
    return text.empty() ||
           (is_plain && text.front() == '/' && text.back() != '/' && text.size() <= kLongestPrefix);
}

}  // namespace

Expected<OscTarget> read_osc_target(const std::string& target) {
    TargetReader reader(target);
    OscTarget read;
    read.preset = static_cast<OscPreset>(reader.word("preset", kPresets));
    read.place =
        reader.host_port(read.preset == OscPreset::resolume ? std::optional(kResolumePort)
                                                            : std::optional<std::uint16_t>());
    const auto prefix = reader.text("prefix");
    read.prefix = prefix.value_or(read.preset == OscPreset::raks ? "/raks" : "");
    if (!is_prefix(read.prefix)) {
        reader.complain(fmt::format("prefix={} must begin with / and have none of #*,?[]{{}}",
                                    printable(read.prefix)));
    }
    read.rate = reader.number("rate", 0.0, 0.0, kMostRate);
    if (read.rate > 0.0 && (read.rate < 1.0 || read.preset != OscPreset::raks)) {
        reader.complain("rate= is 1 to 120 a second, with preset=raks alone");
    }
    read.timing = reader.timing();
    if (auto done = reader.finish(); !done) {
        return fail(done.error());
    }
    return read;
}

}  // namespace raks::engine
