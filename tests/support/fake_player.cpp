#include "tests/support/fake_player.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <systemd/sd-bus.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "base/descriptor.hpp"
#include "tests/support/server_start.hpp"

namespace raks::test {
namespace {

constexpr const char* kPath = "/org/mpris/MediaPlayer2";
constexpr const char* kInterface = "org.mpris.MediaPlayer2.Player";

void must_be(int result, const char* what) {
    if (result < 0) {
        throw std::runtime_error(std::string("a player of a test: ") + what);
    }
}

void add_text(sd_bus_message* message, const char* name, const std::string& value) {
    if (!value.empty()) {
        must_be(sd_bus_message_append(message, "{sv}", name, "s", value.c_str()), name);
    }
}

void add_texts(sd_bus_message* message, const char* name, const std::string& value) {
    if (!value.empty()) {
        must_be(sd_bus_message_append(message, "{sv}", name, "as", 1, value.c_str()), name);
    }
}

}  // namespace

SessionBus::SessionBus() {
    set_variable("DBUS_SESSION_BUS_ADDRESS", "unix:path=" + (folder_ / "bus").string());
    start();
}

void SessionBus::start() {
    const std::string socket = (folder_ / "bus").string();
    unlink(socket.c_str());
    process_ = std::make_unique<ChildProcess>(
        std::vector<std::string>{
            "dbus-daemon", "--session", "--nofork", "--address=unix:path=" + socket},
        (folder_ / "bus.log").string());
    const bool answers = wait_for_answer([&] {
        sd_bus* bus = nullptr;
        const bool is_there =
            sd_bus_open_user(&bus) >= 0 && sd_bus_call_method(bus,
                                                              "org.freedesktop.DBus",
                                                              "/org/freedesktop/DBus",
                                                              "org.freedesktop.DBus",
                                                              "GetId",
                                                              nullptr,
                                                              nullptr,
                                                              "") >= 0;
        sd_bus_close_unref(bus);
        return is_there;
    });
    problem_ = answers ? "" : "dbus-daemon does not start (is dbus installed?)";
}

void SessionBus::kill() { process_.reset(); }

struct FakePlayer::Impl {
    explicit Impl(Answers when) : answers(when == Answers::at_once) {}
    ~Impl() { sd_bus_flush_close_unref(bus); }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    // Until the end; whoever says something has the lock meanwhile.
    void run() {
        while (!is_stopping) {
            {
                const std::lock_guard lock(mutex);
                while (answers && sd_bus_process(bus, nullptr) > 0) {
                }
            }
            std::array<pollfd, 2> files = {
                {{wake.number, POLLIN, 0}, {answers ? sd_bus_get_fd(bus) : -1, POLLIN, 0}}};
            poll(files.data(), files.size(), -1);
            eventfd_t count = 0;
            eventfd_read(wake.number, &count);
        }
    }
    void rouse() const { eventfd_write(wake.number, 1); }
    void say(const std::vector<const char*>& properties) {
        std::vector<char*> names;
        for (const char* name : properties) {
            names.push_back(const_cast<char*>(name));
        }
        names.push_back(nullptr);
        must_be(sd_bus_emit_properties_changed_strv(bus, kPath, kInterface, names.data()),
                "signal");
        must_be(sd_bus_flush(bus), "flush");
    }

    static int status_of(sd_bus* /*bus*/,
                         const char* /*path*/,
                         const char* /*interface*/,
                         const char* /*property*/,
                         sd_bus_message* reply,
                         void* self,
                         sd_bus_error* /*error*/) {
        return sd_bus_message_append(reply, "s", static_cast<Impl*>(self)->status.c_str());
    }
    static int song_of(sd_bus* /*bus*/,
                       const char* /*path*/,
                       const char* /*interface*/,
                       const char* /*property*/,
                       sd_bus_message* reply,
                       void* self,
                       sd_bus_error* /*error*/) {
        const FakeSong& song = static_cast<Impl*>(self)->song;
        must_be(sd_bus_message_open_container(reply, 'a', "{sv}"), "metadata");
        must_be(sd_bus_message_append(reply, "{sv}", "mpris:length", "x", song.length), "length");
        if (!song.track.empty()) {
            must_be(sd_bus_message_append(reply, "{sv}", "mpris:trackid", "o", song.track.c_str()),
                    "track");
        }
        add_text(reply, "xesam:title", song.title);
        add_texts(reply, "xesam:artist", song.artist);
        add_texts(reply, "xesam:genre", song.genre);
        add_text(reply, "xesam:url", song.url);
        if (song.bpm != 0) {
            must_be(sd_bus_message_append(reply, "{sv}", "xesam:audioBPM", "i", song.bpm), "bpm");
        }
        return sd_bus_message_close_container(reply);
    }

    sd_bus* bus = nullptr;
    std::mutex mutex;  // of all that follows, and of the bus
    std::string status = "Stopped";
    FakeSong song;
    Descriptor wake{eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)};
    std::atomic<bool> answers;
    std::atomic<bool> is_stopping{false};
    std::thread thread;
};

FakePlayer::FakePlayer(const std::string& name, Answers answers)
    : impl_(std::make_unique<Impl>(answers)) {
    static const std::array<sd_bus_vtable, 5> kTable = {
        {SD_BUS_VTABLE_START(0),
         SD_BUS_PROPERTY(
             "PlaybackStatus", "s", Impl::status_of, 0, SD_BUS_VTABLE_PROPERTY_EMITS_CHANGE),
         SD_BUS_PROPERTY(
             "Metadata", "a{sv}", Impl::song_of, 0, SD_BUS_VTABLE_PROPERTY_EMITS_CHANGE),
         SD_BUS_SIGNAL("Seeked", "x", 0),
         SD_BUS_VTABLE_END}};
    must_be(sd_bus_open_user(&impl_->bus), "no bus");
    must_be(sd_bus_add_object_vtable(
                impl_->bus, nullptr, kPath, kInterface, kTable.data(), impl_.get()),
            "object");
    must_be(sd_bus_request_name(impl_->bus, ("org.mpris.MediaPlayer2." + name).c_str(), 0), "name");
    impl_->thread = std::thread([this] { impl_->run(); });
}

FakePlayer::~FakePlayer() {
    impl_->is_stopping = true;
    impl_->rouse();
    impl_->thread.join();
}

void FakePlayer::set_status(const std::string& status) {
    const std::lock_guard lock(impl_->mutex);
    impl_->status = status;
    impl_->say({"PlaybackStatus"});
}

void FakePlayer::set_song(const FakeSong& song) {
    const std::lock_guard lock(impl_->mutex);
    impl_->song = song;
    impl_->say({"Metadata"});
}

void FakePlayer::play(const FakeSong& song) {
    const std::lock_guard lock(impl_->mutex);
    impl_->song = song;
    impl_->status = "Playing";
    impl_->say({"PlaybackStatus", "Metadata"});
}

void FakePlayer::seek() {
    const std::lock_guard lock(impl_->mutex);
    must_be(sd_bus_emit_signal(impl_->bus, kPath, kInterface, "Seeked", "x", std::int64_t{-1}),
            "seek");
    must_be(sd_bus_flush(impl_->bus), "flush");
}

void FakePlayer::flood(int messages) {
    const std::lock_guard lock(impl_->mutex);
    for (int i = 0; i < messages; ++i) {
        impl_->say({"PlaybackStatus", "Metadata"});
    }
}

void FakePlayer::answer() {
    impl_->answers = true;
    impl_->rouse();
}

}  // namespace raks::test
