#include "base/channels/realtime_log.hpp"

#include <fmt/format.h>

namespace raks {
namespace {

void replace_token(std::string& line, const char* token, double value) {
    const std::size_t at = line.find(token);
    if (at != std::string::npos) {
        line.replace(at, 2, fmt::format("{:.6g}", value));
    }
}

}  // namespace

bool RealtimeLog::drain_line(std::string& line) {
    LogRecord record;
    if (!queue_.pop(record)) {
        return false;
    }
    line = fmt::format("[{:9.3f} s] {}", to_seconds(record.time), record.text);
    replace_token(line, "%a", record.a);
    replace_token(line, "%b", record.b);
    return true;
}

}  // namespace raks
