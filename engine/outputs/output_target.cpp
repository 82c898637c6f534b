#include "engine/outputs/output_target.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/printable.hpp"
#include "base/suggest.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

constexpr double kLeastLead = -500.0;  // ms
constexpr double kMostLead = 90.0;     // beats are known 100 ms ahead
constexpr std::size_t kLongestHost = 253;

std::pair<std::string, std::string> pair_of(std::string_view option) {
    const std::size_t equals = std::min(option.find('='), option.size());
    return {std::string(option.substr(0, equals)),
            std::string(option.substr(std::min(equals + 1, option.size())))};
}

std::optional<double> number_of(const std::string& text) {
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, value);
    return parsed.ec == std::errc() && parsed.ptr == end && std::isfinite(value)
               ? std::optional(value)
               : std::nullopt;
}

std::optional<std::uint16_t> port_of(std::string_view text) {
    unsigned value = 0;
    const char* const end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, value);
    const bool is_port =
        parsed.ec == std::errc() && parsed.ptr == end && value >= 1 && value <= 65535;
    return is_port ? std::optional(static_cast<std::uint16_t>(value)) : std::nullopt;
}

bool is_host(std::string_view text) {
    return !text.empty() && text.size() <= kLongestHost &&
           std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c < 127; });
}

}  // namespace

std::string HostPort::text() const {
    const bool is_ipv6 = host.find(':') != std::string::npos;
    return is_ipv6 ? fmt::format("[{}]:{}", host, port) : fmt::format("{}:{}", host, port);
}

TargetReader::TargetReader(std::string_view text) {
    std::size_t end = std::min(text.find(','), text.size());
    place_ = text.substr(0, end);
    while (end < text.size()) {
        text.remove_prefix(end + 1);
        end = std::min(text.find(','), text.size());
        options_.push_back(pair_of(text.substr(0, end)));
    }
}

TargetReader TargetReader::of_file(std::string_view text) {
    TargetReader reader;
    for (;;) {
        const std::size_t comma = text.rfind(',');
        if (comma == std::string_view::npos) {
            break;
        }
        auto option = pair_of(text.substr(comma + 1));
        if (option.first != "lead" && option.first != "factor") {
            break;
        }
        reader.options_.push_back(std::move(option));
        text = text.substr(0, comma);
    }
    reader.place_ = text;
    return reader;
}

void TargetReader::complain(const std::string& fault) {
    if (fault_.empty()) {
        fault_ = fault;
    }
}

HostPort TargetReader::host_port(std::optional<std::uint16_t> usual_port) {
    std::string_view host = place_;
    std::optional<std::uint16_t> port = usual_port;
    if (const std::size_t bracket = host.find(']');
        host.starts_with('[') && bracket != std::string_view::npos) {
        const std::string_view behind = host.substr(bracket + 1);
        port = behind.starts_with(':') ? port_of(behind.substr(1))
               : behind.empty()        ? port
                                       : std::nullopt;
        host = host.substr(1, bracket - 1);
    } else if (const std::size_t colon = host.rfind(':'); colon != std::string_view::npos) {
        port = port_of(host.substr(colon + 1));
        host = host.substr(0, colon);
    }
    if (!is_host(host) || !port) {
        complain(fmt::format("\"{}\" is no target; write {}, a port is 1 to 65535",
                             printable(place_),
                             usual_port ? "HOST or HOST:PORT" : "HOST:PORT"));
        return {};
    }
    return {std::string(host), *port};
}

std::optional<std::string> TargetReader::text(std::string_view key) {
    known_.push_back(key);
    std::optional<std::string> value;
    std::erase_if(options_, [&](const auto& option) {
        const bool is_it = option.first == key;
        if (is_it && value) {
            complain(fmt::format("{}= is given twice", key));
        }
        value = is_it ? option.second : value;
        return is_it;
    });
    return value;
}

double TargetReader::number(std::string_view key, double without, double low, double high) {
    const auto given = text(key);
    if (!given) {
        return without;
    }
    const auto value = number_of(*given);
    if (!value || *value < low || *value > high) {
        complain(fmt::format("{}={} must be {:g} to {:g}", key, printable(*given), low, high));
        return without;
    }
    return *value;
}

std::size_t TargetReader::word(std::string_view key, std::span<const std::string_view> words) {
    const auto given = text(key);
    if (!given) {
        return 0;
    }
    const auto found = std::find(words.begin(), words.end(), *given);
    if (found == words.end()) {
        complain(unknown_name(key, *given, words));
        return 0;
    }
    return static_cast<std::size_t>(found - words.begin());
}

Nanos TargetReader::lead() {
    return nanos_from_seconds(number("lead", 0.0, kLeastLead, kMostLead) * 1e-3);
}

OutputTiming TargetReader::timing() {
    const Nanos before = lead();
    const std::string factor = text("factor").value_or("1");
    auto pace = BeatSchedule::Pace::same;
    if (const auto value = number_of(factor); value == 0.5) {
        pace = BeatSchedule::Pace::half;
    } else if (value == 2.0) {
        pace = BeatSchedule::Pace::twice;
    } else if (value != 1.0) {
        complain(fmt::format("factor={} must be 0.5, 1 or 2", printable(factor)));
    }
    return {before, pace};
}

Expected<void> TargetReader::finish() {
    if (!options_.empty()) {
        complain(unknown_name("option", options_.front().first, known_));
    }
    if (!fault_.empty()) {
        return fail(fault_);
    }
    return {};
}

}  // namespace raks::engine
