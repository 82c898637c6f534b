// What other programs and pages may send: packets of OSC, messages of a WebSocket.
#include <chrono>
#include <string_view>
#include <variant>

#include "engine/control/remote_request.hpp"
#include "engine/remote/osc_requests.hpp"
#include "engine/remote/remote_message.hpp"
#include "tests/fuzz/promise.hpp"
#include "tests/fuzz/readers.hpp"

namespace raks::fuzz {
namespace {

const HostTime kMoment = HostTime(std::chrono::hours(1));

// Whatever is asked for, the table allows it, and it names no path where it names a file.
void check_request(const engine::ActionRequest& request) {
    const engine::ActionRow& row = engine::row_of(request.action);
    must(engine::is_remote(row));
    must(engine::take_value(row, request.value).has_value());
    must(request.text.empty() || engine::check_text(row, request.text).has_value());
    const bool is_a_name =
        row.text == engine::TextKind::avatar || row.text == engine::TextKind::theme;
    must(!is_a_name || request.text.find('/') == std::string::npos);
    must(request.came && *request.came <= kMoment &&
         *request.came >= kMoment - std::chrono::seconds(2));
}

}  // namespace

bool read_osc_packet(std::string_view bytes) {
    const engine::OscRequests read = engine::read_osc_requests(bytes, kMoment);
    for (const engine::ActionRequest& request : read.requests) {
        check_request(request);
    }
    must((read.faults > 0) != read.fault.empty());
    return !read.requests.empty();
}

bool read_remote_text(std::string_view text) {
    const auto message = engine::read_remote_message(text, kMoment);
    if (!message) {
        must(!message.error().message.empty());
        must(!engine::remote_answer("", message.error().message).empty());
        return false;
    }
    if (const auto* const request = std::get_if<engine::ActionRequest>(&*message)) {
        check_request(*request);
    } else {
        must(
            !engine::remote_clock_answer(std::get<engine::RemoteClock>(*message), kMoment).empty());
    }
    return true;
}

}  // namespace raks::fuzz
