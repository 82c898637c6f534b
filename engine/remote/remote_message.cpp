#include "engine/remote/remote_message.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include <nlohmann/json.hpp>

#include "engine/control/remote_request.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

using Read = nlohmann::json;

// A moment may lie this far back: delays of a network, not of a person.
constexpr double kLongestAgo = 1'000.0;  // milliseconds

double rounded(double value, double steps) { return std::round(value * steps) / steps; }

// A number keeps all its digits; true is the bare request.
Expected<std::string> value_text(const Read& message) {
    const auto value = message.find("value");
    if (value == message.end() || value->is_null()) {
        return std::string();
    }
    if (value->is_string()) {
        return value->get<std::string>();
    }
    if (value->is_number()) {
        return fmt::format("{}", value->get<double>());
    }
    return fail("\"value\" is a text or a number");
}

// Later than now is a clock that is wrong.
HostTime moment_of(const Read& message, HostTime now) {
    const auto at = message.find("at");
    if (at == message.end() || !at->is_number()) {
        return now;
    }
    const double ago = remote_time(now) - at->get<double>();
    return ago >= 0.0 && ago <= kLongestAgo ? now - nanos_from_seconds(ago * 1e-3) : now;
}

std::string_view kind_word(const ActionRow& row) {
    constexpr std::array<std::string_view, 3> kWords = {"step", "choice", "level"};
    return kWords[static_cast<std::size_t>(row.value->kind)];
}

std::string_view text_word(const ActionRow& row) {
    constexpr std::array<std::string_view, 11> kWords = {"",
                                                         "device",
                                                         "dance",
                                                         "figure",
                                                         "formation",
                                                         "avatar",
                                                         "preset",
                                                         "camera",
                                                         "theme",
                                                         "backdrop",
                                                         "on|off"};
    return kWords[static_cast<std::size_t>(row.text)];
}

Json action_json(const ActionRow& row) {
    Json action = {{"name", row.name}, {"help", row.help}};
    if (row.value) {
        action["kind"] = kind_word(row);
        action["unit"] = symbol_of(row.value->unit);
        action["lowest"] = row.value->lowest;
        action["highest"] = row.value->highest;
    } else if (row.text != TextKind::none) {
        action["takes"] = text_word(row);
    }
    return action;
}

Json names_json(const std::vector<std::string>& names) {
    Json list = Json::array();
    for (const std::string& name : names) {
        list.push_back(name);
    }
    return list;
}

}  // namespace

double remote_time(HostTime moment) noexcept { return to_seconds(moment.time_since_epoch()) * 1e3; }

Expected<RemoteMessage> read_remote_message(std::string_view text, HostTime now) {
    const Read message = Read::parse(text.begin(), text.end(), nullptr, false);
    if (!message.is_object()) {
        return fail("a message is one JSON object");
    }
    if (const auto clock = message.find("clock"); clock != message.end() && clock->is_number()) {
        return RemoteClock{clock->get<double>()};
    }
    const auto action = message.find("do");
    if (action == message.end() || !action->is_string()) {
        return fail("a message has \"do\" with an action's name, or \"clock\"");
    }
    const auto value = value_text(message);
    if (!value) {
        return fail(value.error());
    }
    auto request =
        remote_request(action->get_ref<const std::string&>(), *value, moment_of(message, now));
    return request ? Expected<RemoteMessage>(std::move(*request)) : fail(request.error());
}

std::string remote_clock_answer(const RemoteClock& asked, HostTime now) {
    return Json({{"type", "clock"}, {"clock", asked.sent}, {"now", remote_time(now)}}).text();
}

std::string remote_answer(std::string_view action, std::string_view fault) {
    Json answer = {{"type", "answer"}, {"do", action}, {"ok", fault.empty()}};
    if (!fault.empty()) {
        answer["error"] = fault;
    }
    return answer.text();
}

std::string remote_text(const RemoteState& state) {
    Json beats = Json::array();
    for (const RemoteBeat& beat : state.beats) {
        beats.push_back(
            {{"at", rounded(remote_time(beat.heard_at), 100.0)}, {"count", beat.count}});
    }
    Json targets = Json::array();
    for (const RemoteTarget& target : state.targets) {
        targets.push_back({{"name", target.name},
                           {"sent", target.sent},
                           {"dropped", target.dropped},
                           {"trouble", target.trouble}});
    }
    Json text = {{"type", "state"},
                 {"protocol", kRemoteProtocol},
                 {"now", rounded(remote_time(state.now), 100.0)},
                 {"source", state.source},
                 {"bpm", rounded(state.bpm, 100.0)},
                 {"confidence", rounded(static_cast<double>(state.confidence), 100.0)},
                 {"locked", state.is_locked},
                 {"held", state.is_held},
                 {"silent", state.is_silent},
                 {"count", state.count},
                 {"beats_per_bar", state.beats_per_bar},
                 {"level_dbfs", rounded(static_cast<double>(state.level_dbfs), 10.0)},
                 {"genre", state.genre},
                 {"dance", state.dance},
                 {"figure", state.figure},
                 {"keeps_figure", state.keeps_figure},
                 {"paused", state.is_paused},
                 {"formation", state.formation},
                 {"camera", state.camera},
                 {"theme", state.theme},
                 {"avatar", state.avatar}};
    text["playing"] = {{"player", state.song.player},
                       {"title", state.song.title},
                       {"artist", state.song.artist},
                       {"playing", state.song.is_playing}};
    text["beats"] = std::move(beats);
    text["targets"] = std::move(targets);
    return text.text();
}

std::string remote_text(const RemoteChoices& choices) {
    Json hello = {{"type", "hello"}, {"protocol", kRemoteProtocol}};
    Json actions = Json::array();
    for (const ActionRow& row : action_table()) {
        if (is_remote(row)) {
            actions.push_back(action_json(row));
        }
    }
    hello["actions"] = std::move(actions);
    hello["dances"] = names_json(choices.dances);
    hello["formations"] = names_json(choices.formations);
    hello["cameras"] = names_json(choices.cameras);
    hello["themes"] = names_json(choices.themes);
    hello["avatars"] = names_json(choices.avatars);
    return hello.text();
}

}  // namespace raks::engine
