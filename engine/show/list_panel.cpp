#include "engine/show/list_panel.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace raks::engine {
namespace {

constexpr std::ptrdiff_t kFarRows = 8;  // of PgUp and PgDn
constexpr std::size_t kMostTyped = 64;  // bytes
constexpr std::ptrdiff_t kAllRows = 1'000'000;

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

// Appends a character as UTF-8.
void append(std::string& text, char32_t c) {
    const auto byte = [&](char32_t value) { text.push_back(static_cast<char>(value)); };
    if (c < 0x80) {
        byte(c);
    } else if (c < 0x800) {
        byte(0xC0 | (c >> 6));
        byte(0x80 | (c & 0x3F));
    } else if (c < 0x10000) {
        byte(0xE0 | (c >> 12));
        byte(0x80 | ((c >> 6) & 0x3F));
        byte(0x80 | (c & 0x3F));
    } else {
        byte(0xF0 | (c >> 18));
        byte(0x80 | ((c >> 12) & 0x3F));
        byte(0x80 | ((c >> 6) & 0x3F));
        byte(0x80 | (c & 0x3F));
    }
}

// Takes the last character away, all of its bytes.
void take_last(std::string& text) {
    while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U) {
        text.pop_back();
    }
    if (!text.empty()) {
        text.pop_back();
    }
}

}  // namespace

bool is_found(std::string_view typed, std::string_view text) {
    std::string in(text);
    std::transform(in.begin(), in.end(), in.begin(), lower);
    std::string word;
    for (const char c : std::string(typed) + ' ') {
        if (c != ' ') {
            word.push_back(lower(c));
        } else if (in.find(std::exchange(word, {})) == std::string::npos) {
            return false;
        }
    }
    return true;
}

void ListPanel::open(std::unique_ptr<ListOffer> offer, std::string_view name, std::size_t page) {
    offer_ = std::move(offer);
    name_ = name;
    turn_to(page);
}

std::string_view ListPanel::name() const noexcept { return is_open() ? name_ : std::string_view(); }

// What is in use is chosen first.
void ListPanel::turn_to(std::size_t page) {
    page_ = page;
    typed_.clear();
    refresh();
    choose_first();
}

void ListPanel::choose_first() {
    const auto current = std::find_if(
        shown_.begin(), shown_.end(), [](const render::ListRow& row) { return row.is_current; });
    chosen_ = current != shown_.end() ? static_cast<std::size_t>(current - shown_.begin()) : 0;
    if (!is_choosable(chosen_)) {
        move(1);
    }
}

bool ListPanel::is_choosable(std::size_t row) const {
    return row < shown_.size() && !shown_[row].is_title;
}

void ListPanel::refresh() {
    pages_ = offer_->pages();
    titles_.clear();
    for (const ListPage& page : pages_) {
        titles_.push_back(page.title);
    }
    page_ = std::min(page_, pages_.size() - 1);
    ListPage& page = pages_[page_];
    const std::optional<std::size_t> before =
        chosen_ < numbers_.size() ? std::optional(numbers_[chosen_]) : std::nullopt;
    shown_.clear();
    numbers_.clear();
    for (std::size_t i = 0; i < page.rows.size(); ++i) {
        render::ListRow& row = page.rows[i];
        // Titles are of use only where all is shown.
        const bool is_there = !page.finds_typed || typed_.empty() ||
                              (!row.is_title && is_found(typed_, row.text + ' ' + row.detail));
        if (is_there) {
            shown_.push_back(std::move(row));
            numbers_.push_back(i);
        }
    }
    // The row that was chosen stays so while others come and go.
    const auto same =
        std::find(numbers_.begin(), numbers_.end(), before.value_or(page.rows.size()));
    chosen_ = same != numbers_.end()
                  ? static_cast<std::size_t>(same - numbers_.begin())
                  : std::min(chosen_, std::max<std::size_t>(shown_.size(), 1) - 1);
}

// Over titles, and not beyond the ends.
void ListPanel::move(std::ptrdiff_t rows) {
    const std::ptrdiff_t step = rows < 0 ? -1 : 1;
    std::ptrdiff_t left = std::abs(rows);
    for (auto at = static_cast<std::ptrdiff_t>(chosen_) + step;
         left > 0 && at >= 0 && at < static_cast<std::ptrdiff_t>(shown_.size());
         at += step) {
        if (is_choosable(static_cast<std::size_t>(at))) {
            chosen_ = static_cast<std::size_t>(at);
            --left;
        }
    }
}

void ListPanel::take() {
    if (!is_choosable(chosen_)) {
        return;
    }
    const std::string typed = typed_;
    if (offer_->take(page_, numbers_[chosen_], typed)) {
        close();
    } else {
        refresh();
    }
}

void ListPanel::check() {
    if (is_choosable(chosen_) && shown_[chosen_].is_checked) {
        offer_->check(page_, numbers_[chosen_]);
        refresh();
    }
}

// Characters, and taking them back.
bool ListPanel::edit(const KeyEvent& key) {
    if (key.key == Key::backspace) {
        take_last(typed_);
    } else if (key.key < Key::escape && key.key >= Key::space && !key.has_control) {
        auto c = static_cast<char32_t>(key.key);
        // Keys have small letters.
        if (key.has_shift && c >= U'a' && c <= U'z') {
            c = c - U'a' + U'A';
        }
        if (typed_.size() < kMostTyped) {
            append(typed_, c);
        }
    } else {
        return false;
    }
    refresh();
    choose_first();
    return true;
}

bool ListPanel::handle(const KeyEvent& key) {
    if (!is_open()) {
        return false;
    }
    const std::size_t pages = pages_.size();
    switch (key.key) {
        case Key::escape:
            close();
            return true;
        case Key::enter:
            take();
            return true;
        case Key::up:
            move(-1);
            return true;
        case Key::down:
            move(1);
            return true;
        case Key::page_up:
            move(-kFarRows);
            return true;
        case Key::page_down:
            move(kFarRows);
            return true;
        case Key::home:
            move(-kAllRows);
            return true;
        case Key::end:
            move(kAllRows);
            return true;
        case Key::tab:
        case Key::right:
            turn_to((page_ + 1) % pages);
            return true;
        case Key::left:
            turn_to((page_ + pages - 1) % pages);
            return true;
        case Key::space:
            if (is_choosable(chosen_) && shown_[chosen_].is_checked) {
                check();
                return true;
            }
            break;
        default:
            break;
    }
    return edit(key);
}

void ListPanel::click(const std::optional<render::OverlaySpot>& spot) {
    if (!spot) {
        close();
        return;
    }
    if (spot->part == render::PanelPart::list_page) {
        turn_to(spot->row);
        return;
    }
    const bool is_box = spot->part == render::PanelPart::list_box;
    if (spot->row < shown_.size() && (is_box || spot->part == render::PanelPart::list_row)) {
        chosen_ = spot->row;
        is_box ? check() : take();
    }
}

void ListPanel::scroll(double steps) {
    if (is_open()) {
        move(-static_cast<std::ptrdiff_t>(std::lround(steps)));
    }
}

std::optional<render::OverlayList> ListPanel::look() {
    if (!is_open()) {
        return std::nullopt;
    }
    refresh();
    const ListPage& page = pages_[page_];
    return render::OverlayList{.pages = titles_,
                               .page = page_,
                               .rows = shown_,
                               .chosen = chosen_,
                               .typed = typed_,
                               .prompt = page.prompt,
                               .hint = page.hint};
}

}  // namespace raks::engine
