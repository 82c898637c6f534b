#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/key.hpp"
#include "render/overlay/overlay.hpp"

namespace raks::engine {

/// One page of a list in the window.
struct ListPage {
    std::string title{};                  ///< "Sources"
    std::vector<render::ListRow> rows{};  ///< in their order
    /// Typing finds rows by their text; else it gives the text that take() gets.
    bool finds_typed = true;
    std::string prompt = "type to search";          ///< what typing does
    std::string hint = "Enter: take   Esc: close";  ///< the keys that the page knows
};

/// What a list offers, and what happens when something of it is taken. Threads: main.
class ListOffer {
 public:
    virtual ~ListOffer() = default;  ///< offers are owned by their interface

    /// All pages as they are now, at least one; asked before each picture.
    [[nodiscard]] virtual std::vector<ListPage> pages() = 0;
    /// Takes a row. `typed`: what was typed. Returns whether the list closes.
    [[nodiscard]] virtual bool take(std::size_t page, std::size_t row, std::string_view typed) = 0;
    /// Checks the box of a row, or takes the check away; only of rows that have one.
    virtual void check(std::size_t /*page*/, std::size_t /*row*/) {}
};

/// A list over the picture that keys and pointer work alike: arrows, PgUp, PgDn, Home and End
/// choose a row, Enter takes it, Space checks its box, Tab and arrows to the side turn the pages,
/// letters search, Esc closes. Threads: main.
class ListPanel {
 public:
    /// Opens at a page, in the place of what is open. `name`: of the list.
    void open(std::unique_ptr<ListOffer> offer, std::string_view name, std::size_t page = 0);
    void close() { offer_.reset(); }  ///< nothing is shown from here on
    /// Whether a list is open.
    [[nodiscard]] bool is_open() const noexcept { return offer_ != nullptr; }
    /// The name of the open list and the page that is seen; empty: none.
    [[nodiscard]] std::string_view name() const noexcept;
    [[nodiscard]] std::size_t page() const noexcept { return page_; }  ///< of the open list

    /// A key; returns whether the list used it. None is used while it is closed.
    bool handle(const KeyEvent& key);
    /// A click on one of its spots; one beside it closes the list.
    void click(const std::optional<render::OverlaySpot>& spot);
    /// Steps of the wheel, up is positive.
    void scroll(double steps);

    /// The list as it is drawn; valid until the next call of any of these. None while it is closed.
    [[nodiscard]] std::optional<render::OverlayList> look();

 private:
    void turn_to(std::size_t page);
    void refresh();
    void move(std::ptrdiff_t rows);
    void take();
    void check();
    [[nodiscard]] bool edit(const KeyEvent& key);
    [[nodiscard]] bool is_choosable(std::size_t row) const;
    void choose_first();

    std::unique_ptr<ListOffer> offer_;
    std::string name_;
    std::size_t page_ = 0;
    std::size_t chosen_ = 0;  // of shown_
    std::string typed_;
    // As of the last refresh().
    std::vector<ListPage> pages_;
    std::vector<std::string> titles_;
    std::vector<render::ListRow> shown_;  // rows of the page that are found
    std::vector<std::size_t> numbers_;    // which of the page's rows these are
};

/// Whether a text holds each word of what was typed, in any order; case does not matter. Pure.
[[nodiscard]] bool is_found(std::string_view typed, std::string_view text);

}  // namespace raks::engine
