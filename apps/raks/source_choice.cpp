#include "apps/raks/source_choice.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include <fmt/format.h>

namespace raks::apps {
namespace {

constexpr Nanos kBetween = std::chrono::seconds(2);
constexpr std::size_t kMostFiles = 1000;  // that are listed

}  // namespace

class SourceChoice::Offer final : public engine::ListOffer {
 public:
    explicit Offer(SourceChoice& choice) : choice_(choice) {}

    [[nodiscard]] std::vector<engine::ListPage> pages() override;
    [[nodiscard]] bool take(std::size_t page, std::size_t row, std::string_view typed) override;

 private:
    // What a row of the first page is.
    struct Entry {
        std::string name;  // empty: a title
        bool is_input = false;
    };
    [[nodiscard]] engine::ListPage devices();
    [[nodiscard]] engine::ListPage files() const;
    void add_title(std::string text, engine::ListPage& page);
    void add_inputs(engine::ListPage& page);
    void add_outputs(engine::ListPage& page);
    [[nodiscard]] std::optional<float> level_of_output(const std::string& name) const;

    SourceChoice& choice_;
    std::vector<Entry> entries_;
};

SourceChoice::~SourceChoice() = default;

std::unique_ptr<engine::ListOffer> SourceChoice::offer() { return std::make_unique<Offer>(*this); }

// Called with each picture while the list is open.
void SourceChoice::look_around() {
    const HostTime now = HostClock::now();
    if (asking_.valid() && asking_.wait_for(Nanos(0)) == std::future_status::ready) {
        if (auto devices = asking_.get()) {
            devices_ = std::move(*devices);
            trouble_ = "no sound device was found";
        } else {
            devices_.clear();
            trouble_ = devices.error().message;
        }
        asked_ = now;
    }
    if (!asking_.valid() && (asked_ == HostTime{} || now - asked_ >= kBetween)) {
        asking_ = std::async(std::launch::async, engine::ask_for_devices);
    }
}

std::vector<engine::ListPage> SourceChoice::Offer::pages() {
    choice_.look_around();
    return {devices(), files()};
}

engine::ListPage SourceChoice::Offer::devices() {
    engine::ListPage page{.title = "Sources and loudspeakers",
                          .hint = "Enter: take it   Tab: the files that play   Esc: close"};
    entries_.clear();
    if (choice_.devices_.empty()) {
        add_title(choice_.trouble_, page);
        return page;
    }
    add_inputs(page);
    add_outputs(page);
    return page;
}

void SourceChoice::Offer::add_title(std::string text, engine::ListPage& page) {
    page.rows.push_back({.text = std::move(text), .is_title = true});
    entries_.push_back({});
}

// What the computer plays comes first, as most want it.
void SourceChoice::Offer::add_inputs(engine::ListPage& page) {
    add_title("LISTEN TO", page);
    const std::string now = choice_.means_.input();
    for (const bool is_monitor : {true, false}) {
        for (const engine::ListedDevice& device : choice_.devices_) {
            if (!device.is_input || device.is_monitor != is_monitor) {
                continue;
            }
            const bool is_current = device.name == now;
            page.rows.push_back(
                {.text = device.name,
                 .detail = device.is_monitor ? "what this computer plays" : device.system,
                 .level_dbfs =
                     is_current ? std::optional(choice_.means_.level_dbfs()) : device.level_dbfs,
                 .is_current = is_current});
            entries_.push_back({device.name, true});
        }
    }
}

std::optional<float> SourceChoice::Offer::level_of_output(const std::string& name) const {
    const auto monitor = std::find_if(
        choice_.devices_.begin(), choice_.devices_.end(), [&](const engine::ListedDevice& device) {
            return device.is_monitor && device.monitor_of == name;
        });
    return monitor != choice_.devices_.end() ? monitor->level_dbfs : std::nullopt;
}

void SourceChoice::Offer::add_outputs(engine::ListPage& page) {
    add_title("PLAY FILES ON", page);
    const std::string now = choice_.means_.output();
    for (const engine::ListedDevice& device : choice_.devices_) {
        if (device.is_output) {
            page.rows.push_back({.text = device.name,
                                 .detail = device.system,
                                 .level_dbfs = level_of_output(device.name),
                                 .is_current = device.name == now});
            entries_.push_back({device.name, false});
        }
    }
}

engine::ListPage SourceChoice::Offer::files() const {
    engine::ListPage page{.title = "Files",
                          .hint = "Enter: play it   drop music here to add it   Esc: close"};
    const PlayQueue* const queue = choice_.means_.queue();
    if (queue == nullptr) {
        page.rows.push_back({.text = "no files play: drop music here", .is_title = true});
        return page;
    }
    const std::vector<std::string> names = queue->names(kMostFiles);
    for (std::size_t i = 0; i < names.size(); ++i) {
        page.rows.push_back({.text = names[i], .is_current = i == queue->place()});
    }
    if (queue->size() > names.size()) {
        page.rows.push_back(
            {.text = fmt::format("and {} more", queue->size() - names.size()), .is_title = true});
    }
    return page;
}

bool SourceChoice::Offer::take(std::size_t page, std::size_t row, std::string_view /*typed*/) {
    if (page == kQueuePage) {
        if (choice_.means_.queue() != nullptr) {
            choice_.means_.play_file(row);
        }
        return true;
    }
    if (row >= entries_.size() || entries_[row].name.empty()) {
        return false;
    }
    const Entry entry = entries_[row];
    entry.is_input ? choice_.means_.listen(entry.name) : choice_.means_.play_on(entry.name);
    return true;
}

}  // namespace raks::apps
