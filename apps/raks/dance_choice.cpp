#include "apps/raks/dance_choice.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/suggest.hpp"
#include "motion/dance_library.hpp"
#include "render/overlay/text_format.hpp"

#include <fmt/format.h>

namespace raks::apps {

using DancerKind = motion::DancerCommand::Kind;

// Rows: the recognised one, then each dance; below the danced one its figures.
class DanceChoice::Offer final : public engine::ListOffer {
 public:
    explicit Offer(DanceChoice& choice) : choice_(choice) {}

    [[nodiscard]] std::vector<engine::ListPage> pages() override;
    [[nodiscard]] bool take(std::size_t page, std::size_t row, std::string_view typed) override;
    void check(std::size_t page, std::size_t row) override;

 private:
    // What a row is.
    struct Entry {
        DanceId dance = DanceId::none;  // none: as it is heard, or a figure
        bool is_figure = false;
        std::size_t figure = 0;
    };
    void add_dance(DanceId dance, const Dancers& dancers, std::vector<render::ListRow>& rows);
    void add_figures(const Dancers& dancers, std::vector<render::ListRow>& rows);

    DanceChoice& choice_;
    std::vector<Entry> entries_;
};

DanceChoice::DanceChoice(const engine::Settings& settings,
                         std::shared_ptr<const DanceList> dances,
                         engine::LiveActions& actions,
                         std::function<Dancers()> look,
                         engine::SayLine say)
    : settings_(settings),
      dances_(std::move(dances)),
      actions_(actions),
      look_(std::move(look)),
      say_(std::move(say)) {}

void DanceChoice::set_dances(std::shared_ptr<const DanceList> dances) {
    dances_ = std::move(dances);
    selected_ = DanceId::none;
    forbidden_.reset();
}

// They start with the recognised dance, and every dance allowed.
void DanceChoice::brief_dancers() {
    if (selected_ != DanceId::none) {
        actions_.ask(DancerKind::select_dance, static_cast<double>(selected_));
    }
    for (std::size_t number = 0; number < dances_->size(); ++number) {
        if (forbidden_[number]) {
            actions_.ask(DancerKind::forbid_dance, static_cast<double>(number));
        }
    }
}

std::string_view DanceChoice::name() const {
    if (selected_ != DanceId::none) {
        return dances_->name_of(selected_);
    }
    return is_fixed() ? std::string_view(settings_.dance) : std::string_view();
}

std::vector<std::string> DanceChoice::forbidden() const {
    std::vector<std::string> names;
    for (std::size_t number = 0; number < dances_->size(); ++number) {
        if (forbidden_[number]) {
            names.emplace_back(dances_->name_of(static_cast<DanceId>(number)));
        }
    }
    return names;
}

std::string DanceChoice::fixed_line() const {
    return fmt::format("only {} is danced, as asked for: start without --dance for the others",
                       settings_.dance);
}

void DanceChoice::select_next() {
    if (is_fixed()) {
        say_(fixed_line());
        return;
    }
    const std::size_t next = selected_ == DanceId::none ? 0 : index_of(selected_) + 1;
    select(next < dances_->size() ? static_cast<DanceId>(next) : DanceId::none);
}

void DanceChoice::select(DanceId dance) {
    selected_ = dance;
    // Who asks for a dance wants it.
    if (dance != DanceId::none && forbidden_[index_of(dance)]) {
        static_cast<void>(allow(dance, true));
    }
    actions_.ask(DancerKind::select_dance, static_cast<double>(dance));
    const motion::DancerStatus status = look_().status;
    say_(engine::chosen_dance_line(dance == DanceId::none ? "" : dances_->name_of(dance),
                                   status.is_dancing && status.dance == dance));
}

Expected<DanceId> DanceChoice::find(std::string_view name) const {
    std::vector<std::string_view> names;
    for (std::size_t number = 0; number < dances_->size(); ++number) {
        names.push_back(dances_->name_of(static_cast<DanceId>(number)));
        if (names.back() == name) {
            return static_cast<DanceId>(number);
        }
    }
    return fail(unknown_name("dance", name, names));
}

Expected<void> DanceChoice::select(std::string_view name) {
    if (is_fixed() && name != settings_.dance) {
        return fail(fixed_line());
    }
    if (name.empty() || name == "auto") {
        select(DanceId::none);
        return {};
    }
    const auto dance = find(name);
    if (!dance) {
        return fail(dance.error());
    }
    select(*dance);
    return {};
}

Expected<void> DanceChoice::select_figure(std::string_view name) {
    const Dancers dancers = look_();
    const motion::DanceLibrary* const library =
        dancers.status.is_dancing ? dancers.repertoire->of(dancers.status.dance) : nullptr;
    if (library == nullptr) {
        return fail("nobody dances: there is no figure to choose");
    }
    const std::vector<std::string_view> names = library->figure_names();
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end()) {
        return fail(unknown_name("figure", name, names));
    }
    actions_.ask(DancerKind::select_figure, static_cast<double>(at - names.begin()));
    return {};
}

Expected<void> DanceChoice::allow(std::string_view name, bool is_allowed) {
    const auto dance = find(name);
    return dance ? allow(*dance, is_allowed) : fail(dance.error());
}

// Dances that are still being learnt count, too.
Expected<void> DanceChoice::allow(DanceId dance, bool is_allowed) {
    motion::DanceSet wished = forbidden_;
    wished.set(index_of(dance), !is_allowed);
    if (wished.count() >= dances_->size()) {
        return fail(fmt::format("{} stays allowed: it is the last one", dances_->name_of(dance)));
    }
    forbidden_ = wished;
    actions_.ask(is_allowed ? DancerKind::allow_dance : DancerKind::forbid_dance,
                 static_cast<double>(dance));
    return {};
}

void DanceChoice::forbid_only(const std::vector<std::string>& names) {
    const motion::DanceSet before = std::exchange(forbidden_, {});
    for (std::size_t number = 0; number < dances_->size(); ++number) {
        if (before[number]) {
            actions_.ask(DancerKind::allow_dance, static_cast<double>(number));
        }
    }
    for (const std::string& name : names) {
        if (const auto forbidden = allow(name, false); !forbidden) {
            say_(forbidden.error().message);
        }
    }
}

std::unique_ptr<engine::ListOffer> DanceChoice::offer() { return std::make_unique<Offer>(*this); }

std::vector<engine::ListPage> DanceChoice::Offer::pages() {
    engine::ListPage page{.title = "Dances",
                          .hint = "Enter: dance it   Space: forbid, allow   Esc: close"};
    entries_.clear();
    const Dancers dancers = choice_.look_();
    if (!choice_.is_fixed()) {
        page.rows.push_back(
            {.text = "as it is heard", .is_current = choice_.selected_ == DanceId::none});
        entries_.push_back({});
    }
    for (std::size_t number = 0; number < choice_.dances_->size(); ++number) {
        const auto dance = static_cast<DanceId>(number);
        if (!choice_.is_fixed() || choice_.dances_->name_of(dance) == choice_.settings_.dance) {
            add_dance(dance, dancers, page.rows);
        }
    }
    return {std::move(page)};
}

void DanceChoice::Offer::add_dance(DanceId dance,
                                   const Dancers& dancers,
                                   std::vector<render::ListRow>& rows) {
    const bool is_danced = dancers.status.is_dancing && dancers.status.dance == dance;
    const bool is_chosen = choice_.selected_ == dance || choice_.is_fixed();
    const bool is_ready = dancers.repertoire != nullptr && dancers.repertoire->of(dance) != nullptr;
    rows.push_back({.text = std::string(choice_.dances_->title_of(dance)),
                    .detail = is_danced  ? "danced now"
                              : is_ready ? ""
                                         : "is being learnt",
                    .is_checked = !choice_.forbidden_[index_of(dance)],
                    .is_current = is_chosen});
    entries_.push_back({.dance = dance});
    if (is_danced) {
        add_figures(dancers, rows);
    }
}

// Of whole takes there is none to choose.
void DanceChoice::Offer::add_figures(const Dancers& dancers, std::vector<render::ListRow>& rows) {
    const motion::DanceLibrary* const library =
        dancers.repertoire != nullptr ? dancers.repertoire->of(dancers.status.dance) : nullptr;
    if (library == nullptr || library->cells() != nullptr) {
        return;
    }
    const std::string_view now(dancers.status.figure.data(),
                               strnlen(dancers.status.figure.data(), dancers.status.figure.size()));
    std::size_t number = 0;
    for (const std::string_view name : library->figure_names()) {
        std::string text(name);
        std::replace(text.begin(), text.end(), '_', ' ');
        rows.push_back({.text = "      " + text, .is_current = name == now});
        entries_.push_back({.is_figure = true, .figure = number++});
    }
}

// A figure leaves the list open, as several may be tried.
bool DanceChoice::Offer::take(std::size_t /*page*/, std::size_t row, std::string_view /*typed*/) {
    if (row >= entries_.size()) {
        return false;
    }
    const Entry& entry = entries_[row];
    if (entry.is_figure) {
        choice_.actions_.ask(DancerKind::select_figure, static_cast<double>(entry.figure));
        return false;
    }
    if (choice_.is_fixed()) {
        choice_.say_(choice_.fixed_line());
        return false;
    }
    choice_.select(entry.dance);
    return true;
}

void DanceChoice::Offer::check(std::size_t /*page*/, std::size_t row) {
    if (row >= entries_.size() || entries_[row].dance == DanceId::none) {
        return;
    }
    const DanceId dance = entries_[row].dance;
    if (const auto done = choice_.allow(dance, choice_.forbidden_[index_of(dance)]); !done) {
        choice_.say_(done.error().message);
    }
}

}  // namespace raks::apps
