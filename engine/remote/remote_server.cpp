#include "engine/remote/remote_server.hpp"

#include <civetweb.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstring>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>

#include "base/descriptor.hpp"
#include "engine/control/remote_request.hpp"
#include "engine/remote/remote_guard.hpp"
#include "engine/remote/remote_page.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

constexpr std::string_view kDo = "/do/";
constexpr const char* kPages = "/ws";
constexpr Nanos kKnocksApart = std::chrono::milliseconds(5);
constexpr Nanos kPatience = std::chrono::seconds(1);  // for the main thread

struct Answer {
    int code;
    std::string_view type = "application/json";
    std::string body;
};

std::string_view reason_of(int code) {
    switch (code) {
        case 200:
            return "OK";
        case 202:
            return "Accepted";
        case 400:
            return "Bad Request";
        case 403:
            return "Forbidden";
        case 404:
            return "Not Found";
        case 405:
            return "Method Not Allowed";
        case 409:
            return "Conflict";
        case 413:
            return "Content Too Large";
        case 426:
            return "Upgrade Required";
        default:
            return "Service Unavailable";
    }
}

// Nothing of it is kept by browsers, framed by pages of others, or guessed at.
int send(mg_connection* connection, const Answer& answer) {
    const std::string head = fmt::format(
        "HTTP/1.1 {} {}\r\n"
        "Content-Type: {}; charset=utf-8\r\n"
        "Content-Length: {}\r\n"
        "Cache-Control: no-store\r\n"
        "Referrer-Policy: no-referrer\r\n"
        "X-Content-Type-Options: nosniff\r\n"
        "X-Frame-Options: DENY\r\n"
        "Content-Security-Policy: default-src 'none'; style-src 'unsafe-inline'; "
        "script-src 'unsafe-inline'; connect-src 'self'; img-src data:\r\n"
        "Connection: close\r\n\r\n",
        answer.code,
        reason_of(answer.code),
        answer.type,
        answer.body.size());
    mg_write(connection, head.data(), head.size());
    mg_write(connection, answer.body.data(), answer.body.size());
    return answer.code;
}

Answer refused(int code, std::string_view why) {
    return {code, "application/json", Json({{"ok", false}, {"error", why}}).text() + "\n"};
}

std::string text_of(const char* text) { return text == nullptr ? std::string() : text; }

std::string token_of(const mg_connection* connection, const mg_request_info& info) {
    std::array<char, 128> token{};
    if (info.query_string != nullptr && mg_get_var(info.query_string,
                                                   std::strlen(info.query_string),
                                                   "token",
                                                   token.data(),
                                                   token.size()) > 0) {
        return token.data();
    }
    constexpr std::string_view kBearer = "Bearer ";
    const std::string given = text_of(mg_get_header(connection, "Authorization"));
    return given.starts_with(kBearer) ? given.substr(kBearer.size()) : std::string();
}

/// Counts one more while it lives.
class Counted {
 public:
    explicit Counted(std::atomic<int>& count) : count_(count), number_(++count) {}
    ~Counted() { --count_; }
    Counted(const Counted&) = delete;
    Counted& operator=(const Counted&) = delete;
    [[nodiscard]] int number() const { return number_; }

 private:
    std::atomic<int>& count_;
    int number_;
};

/// What pages are told, and the condition that it is new.
struct News {
    std::mutex mutex;
    std::condition_variable is_new;
    std::string state = "{}";
    std::uint64_t states = 0;
    std::string hello;
    std::uint64_t hellos = 0;
    bool is_ending = false;
};

/// A page that is connected. It has a thread of its own that writes, so that a slow one keeps
/// nobody waiting.
class Page {
 public:
    Page(mg_connection* connection, News& news, std::atomic<int>& count)
        : connection_(connection), news_(news), counted_(count), thread_([this] { run(); }) {}
    ~Page() {
        {
            const std::lock_guard lock(news_.mutex);
            has_left_ = true;
        }
        news_.is_new.notify_all();
        thread_.join();
    }
    Page(const Page&) = delete;
    Page& operator=(const Page&) = delete;

    bool write(const std::string& text) {
        return mg_websocket_write(connection_, MG_WEBSOCKET_OPCODE_TEXT, text.data(), text.size()) >
               0;
    }
    /// Whether one more message is taken.
    bool has_budget(HostTime now) {
        constexpr double kMost = RemoteServer::kMostMessages;
        budget_ = std::min(kMost, budget_ + to_seconds(now - refilled_) * kMost);
        refilled_ = now;
        budget_ -= 1.0;
        return budget_ >= 0.0;
    }

 private:
    // The text that is due, if it is not over.
    std::optional<std::string> next() {
        std::unique_lock lock(news_.mutex);
        news_.is_new.wait(lock, [this] {
            return has_left_ || news_.is_ending || news_.hellos != hellos_ ||
                   news_.states != states_;
        });
        if (has_left_ || news_.is_ending) {
            return std::nullopt;
        }
        if (news_.hellos != hellos_) {
            hellos_ = news_.hellos;
            return news_.hello;
        }
        states_ = news_.states;
        return news_.state;
    }
    void run() {
        while (const auto text = next()) {
            if (!write(*text)) {
                return;
            }
        }
        // Where the server ends, the page is told, and the thread that reads from it ends soon.
        mg_websocket_write(connection_, MG_WEBSOCKET_OPCODE_CONNECTION_CLOSE, nullptr, 0);
    }

    mg_connection* connection_;
    News& news_;
    Counted counted_;
    std::uint64_t states_ = 0;
    std::uint64_t hellos_ = 0;
    bool has_left_ = false;
    double budget_ = RemoteServer::kMostMessages;  // of the thread that reads
    HostTime refilled_ = HostClock::now();
    std::thread thread_;
};

/// The server, by civetweb.
class CivetServer final : public RemoteServer {
 public:
    CivetServer(ListenPlace place, const std::string& token, RequestInbox& inbox)
        : place_(std::move(place)), guard_(token, place_.address, place_.port), inbox_(inbox) {}
    ~CivetServer() override {
        {
            const std::lock_guard lock(news_.mutex);
            news_.is_ending = true;
        }
        news_.is_new.notify_all();
        if (context_ != nullptr) {
            stop();
        }
    }

    /// Errors: the library's.
    Expected<void> start();

    [[nodiscard]] const ListenPlace& place() const noexcept override { return place_; }
    void publish(const RemoteState& state) override;
    void publish(const RemoteChoices& choices) override;
    [[nodiscard]] int pages() const noexcept override { return pages_; }

 private:
    void stop();
    [[nodiscard]] std::string_view refusal(const mg_connection* connection) const;
    int begin(mg_connection* connection);
    [[nodiscard]] Answer answer(mg_connection* connection, const mg_request_info& info);
    [[nodiscard]] Answer carry_out(mg_connection* connection, const mg_request_info& info);
    void ready(mg_connection* connection);
    bool take(mg_connection* connection, int bits, std::string_view text);
    void take(Page& page, std::string_view text);

    ListenPlace place_;
    RemoteGuard guard_;
    RequestInbox& inbox_;
    News news_;
    std::atomic<int> connections_{0};
    std::atomic<int> pages_{0};
    mg_context* context_ = nullptr;
};

CivetServer& server_of(const mg_connection* connection) {
    return *static_cast<CivetServer*>(mg_get_user_data(mg_get_context(connection)));
}

Page* page_of(const mg_connection* connection) {
    return static_cast<Page*>(mg_get_user_connection_data(connection));
}

Expected<void> CivetServer::start() {
    static const unsigned kInitialised = mg_init_library(MG_FEATURES_DEFAULT);
    static_cast<void>(kInitialised);
    mg_callbacks callbacks{};
    callbacks.begin_request = [](mg_connection* connection) {
        return server_of(connection).begin(connection);
    };
    callbacks.log_message = [](const mg_connection*, const char*) { return 1; };
    callbacks.log_access = [](const mg_connection*, const char*) { return 1; };
    // Two more than are served, which say so.
    const std::string threads = std::to_string(kMostConnections + 2);
    const std::string listens = place_.text();
    const std::array<const char*, 17> options = {"listening_ports",
                                                 listens.c_str(),
                                                 "num_threads",
                                                 threads.c_str(),
                                                 "request_timeout_ms",
                                                 "10000",
                                                 "websocket_timeout_ms",
                                                 "30000",
                                                 "enable_keep_alive",
                                                 "no",
                                                 "enable_directory_listing",
                                                 "no",
                                                 "tcp_nodelay",
                                                 "1",
                                                 "max_request_size",
                                                 "16384",
                                                 nullptr};
    auto* const options_of_library = const_cast<const char**>(options.data());
    context_ = mg_start(&callbacks, this, options_of_library);
    if (context_ == nullptr) {
        return fail(place_.text() + ": it cannot be listened to");
    }
    mg_set_websocket_handler(
        context_,
        kPages,
        [](const mg_connection* connection, void* self) {
            return static_cast<CivetServer*>(self)->refusal(connection).empty() ? 0 : 1;
        },
        [](mg_connection* connection, void* self) {
            static_cast<CivetServer*>(self)->ready(connection);
        },
        [](mg_connection* connection, int bits, char* text, std::size_t size, void* self) {
            return static_cast<CivetServer*>(self)->take(connection, bits, {text, size}) ? 1 : 0;
        },
        [](const mg_connection* connection, void*) {
            delete page_of(connection);
            mg_set_user_connection_data(connection, nullptr);
        },
        this);
    return {};
}

// The library looks up from its port every 2 s, or when somebody knocks.
void CivetServer::stop() {
    std::atomic<bool> has_stopped{false};
    std::thread knocks([&] {
        while (!has_stopped) {
            knock_at(place_);
            std::this_thread::sleep_for(kKnocksApart);
        }
    });
    mg_stop(context_);
    has_stopped = true;
    knocks.join();
}

void CivetServer::publish(const RemoteState& state) {
    std::string text = remote_text(state);
    {
        const std::lock_guard lock(news_.mutex);
        news_.state = std::move(text);
        ++news_.states;
    }
    news_.is_new.notify_all();
}

void CivetServer::publish(const RemoteChoices& choices) {
    std::string text = remote_text(choices);
    {
        const std::lock_guard lock(news_.mutex);
        if (text == news_.hello) {
            return;
        }
        news_.hello = std::move(text);
        ++news_.hellos;
    }
    news_.is_new.notify_all();
}

std::string_view CivetServer::refusal(const mg_connection* connection) const {
    const mg_request_info& info = *mg_get_request_info(connection);
    const char* const origin = mg_get_header(connection, "Origin");
    return guard_.refusal({info.remote_addr,
                           text_of(mg_get_header(connection, "Host")),
                           origin == nullptr ? std::nullopt : std::optional<std::string>(origin),
                           token_of(connection, info)});
}

// 0: the library goes on with the handshake of a page.
int CivetServer::begin(mg_connection* connection) {
    const mg_request_info& info = *mg_get_request_info(connection);
    const Counted counted(connections_);
    if (counted.number() + pages_ > kMostConnections) {
        return send(connection, refused(503, "8 connections are open already"));
    }
    if (const std::string_view why = refusal(connection); !why.empty()) {
        return send(connection, refused(403, why));
    }
    const bool is_page = text_of(info.local_uri) == kPages;
    if (is_page && mg_get_header(connection, "Upgrade") != nullptr) {
        return 0;
    }
    return send(connection,
                is_page ? refused(426, "this is a WebSocket") : answer(connection, info));
}

Answer CivetServer::answer(mg_connection* connection, const mg_request_info& info) {
    const std::string path = text_of(info.local_uri);
    const std::string method = text_of(info.request_method);
    if (path.starts_with(kDo)) {
        return method == "POST" ? carry_out(connection, info)
                                : refused(405, "POST asks for an action");
    }
    if (path != "/" && path != "/state") {
        return refused(404, "there are /, /state, /do/ACTION and /ws");
    }
    if (method != "GET") {
        return refused(405, "GET is all that this takes");
    }
    if (path == "/") {
        return {200, "text/html", std::string(remote_page())};
    }
    const std::lock_guard lock(news_.mutex);
    return {200, "application/json", news_.state + "\n"};
}

Answer CivetServer::carry_out(mg_connection* connection, const mg_request_info& info) {
    const HostTime came = HostClock::now();
    if (info.content_length > static_cast<long long>(kLongestRequest)) {
        return refused(413, "a value has 64 KiB at most");
    }
    std::string value;
    std::array<char, 4096> part{};
    for (int size = 0; (size = mg_read(connection, part.data(), part.size())) > 0;) {
        value.append(part.data(), static_cast<std::size_t>(size));
        if (value.size() > kLongestRequest) {
            return refused(413, "a value has 64 KiB at most");
        }
    }
    auto request = remote_request(text_of(info.local_uri).substr(kDo.size()), value, came);
    if (!request) {
        return refused(400, request.error().message);
    }
    const auto done = inbox_.ask(std::move(*request), kPatience);
    if (!done) {
        return {202, "application/json", "{\"ok\":true,\"waits\":true}\n"};
    }
    return *done ? Answer{200, "application/json", "{\"ok\":true}\n"}
                 : refused(409, done->error().message);
}

void CivetServer::ready(mg_connection* connection) {
    mg_set_user_connection_data(connection, new Page(connection, news_, pages_));
}

// False: the page is let go.
bool CivetServer::take(mg_connection* connection, int bits, std::string_view text) {
    constexpr int kOpcode = 0x0F;
    constexpr int kIsLast = 0x80;
    Page* const page = page_of(connection);
    if (page == nullptr || !page->has_budget(HostClock::now()) || text.size() > kLongestRequest) {
        return false;
    }
    if ((bits & kOpcode) == MG_WEBSOCKET_OPCODE_TEXT && (bits & kIsLast) != 0) {
        take(*page, text);
        return true;
    }
    return (bits & kOpcode) != MG_WEBSOCKET_OPCODE_CONNECTION_CLOSE;
}

void CivetServer::take(Page& page, std::string_view text) {
    const HostTime now = HostClock::now();
    auto message = read_remote_message(text, now);
    if (!message) {
        page.write(remote_answer("", message.error().message));
        return;
    }
    if (const auto* const clock = std::get_if<RemoteClock>(&*message)) {
        page.write(remote_clock_answer(*clock, now));
        return;
    }
    const std::string_view action = row_of(std::get<ActionRequest>(*message).action).name;
    const auto done = inbox_.ask(std::get<ActionRequest>(std::move(*message)), kPatience);
    page.write(remote_answer(action, !done || *done ? "" : done->error().message));
}

}  // namespace

bool RemoteServer::is_built() noexcept { return true; }

Expected<std::unique_ptr<RemoteServer>> RemoteServer::open(const ListenPlace& place,
                                                           const std::string& token,
                                                           RequestInbox& inbox) {
    // Where the library would say nothing of what is wrong. Of port 0 it also finds one.
    ListenPlace found = place;
    {
        const auto bound = bind_to(place, SOCK_STREAM);
        if (!bound) {
            return fail("--remote-address " + bound.error().message);
        }
        const Descriptor socket(*bound);
        if (place.port == 0) {
            found.port = port_of_socket(socket.number);
        }
    }
    auto server = std::make_unique<CivetServer>(found, token, inbox);
    if (auto started = server->start(); !started) {
        return fail("--remote-address " + started.error().message);
    }
    return server;
}

}  // namespace raks::engine
