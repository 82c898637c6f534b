#include "tests/support/file_drop.hpp"

#include <poll.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <stdexcept>

// last, for X.h defines names such as None
#include <X11/Xatom.h>
#include <X11/Xlib.h>

namespace raks::test {
namespace {

constexpr std::chrono::seconds kPatience(20);
constexpr long kVersion = 5;
constexpr long kOneType = 0;  // the list of types is in the message itself

/// One drop: the source's side of XDND.
class Drop {
 public:
    Drop(const std::string& window_id, const std::vector<std::string>& paths)
        : display_(XOpenDisplay(nullptr)), target_(std::stoul(window_id)) {
        if (display_ == nullptr) {
            throw std::runtime_error("no display to drop files on");
        }
        source_ = XCreateSimpleWindow(display_, DefaultRootWindow(display_), 0, 0, 1, 1, 0, 0, 0);
        for (const std::string& path : paths) {
            list_ += "file://" + path + "\r\n";
        }
    }
    Drop(const Drop&) = delete;
    Drop& operator=(const Drop&) = delete;
    ~Drop() { XCloseDisplay(display_); }

    void run() {
        XSetSelectionOwner(display_, atom("XdndSelection"), source_, CurrentTime);
        send("XdndEnter", {kVersion << 24 | kOneType, static_cast<long>(atom("text/uri-list"))});
        send("XdndPosition", {0, 0, CurrentTime, static_cast<long>(atom("XdndActionCopy"))});
        wait_for("XdndStatus");
        send("XdndDrop", {0, CurrentTime});
        wait_for("XdndFinished");
    }

 private:
    [[nodiscard]] Atom atom(const char* name) const { return XInternAtom(display_, name, False); }

    void send(const char* type, const std::array<long, 4>& data) {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.window = target_;
        event.xclient.message_type = atom(type);
        event.xclient.format = 32;
        event.xclient.data.l[0] = static_cast<long>(source_);
        for (std::size_t i = 0; i < data.size(); ++i) {
            event.xclient.data.l[i + 1] = data[i];
        }
        XSendEvent(display_, target_, False, NoEventMask, &event);
        XFlush(display_);
    }

    // Answers what is asked meanwhile.
    void wait_for(const char* type) {
        const auto end = std::chrono::steady_clock::now() + kPatience;
        while (std::chrono::steady_clock::now() < end) {
            while (XPending(display_) > 0) {
                XEvent event{};
                XNextEvent(display_, &event);
                if (event.type == SelectionRequest) {
                    answer(event.xselectionrequest);
                } else if (event.type == ClientMessage &&
                           event.xclient.message_type == atom(type)) {
                    return;
                }
            }
            pollfd more{ConnectionNumber(display_), POLLIN, 0};
            poll(&more, 1, 100);
        }
        throw std::runtime_error(std::string("the window sends no ") + type);
    }

    void answer(const XSelectionRequestEvent& asked) {
        XChangeProperty(display_,
                        asked.requestor,
                        asked.property,
                        asked.target,
                        8,
                        PropModeReplace,
                        reinterpret_cast<const unsigned char*>(list_.data()),
                        static_cast<int>(list_.size()));
        XEvent event{};
        event.xselection.type = SelectionNotify;
        event.xselection.requestor = asked.requestor;
        event.xselection.selection = asked.selection;
        event.xselection.target = asked.target;
        event.xselection.property = asked.property;
        event.xselection.time = asked.time;
        XSendEvent(display_, asked.requestor, False, NoEventMask, &event);
        XFlush(display_);
    }

    Display* display_;
    Window target_;
    Window source_ = 0;
    std::string list_;
};

}  // namespace

void drop_files(const std::string& window_id, const std::vector<std::string>& paths) {
    Drop(window_id, paths).run();
}

}  // namespace raks::test
