#include "engine/setup/play_order.hpp"

#include <numeric>
#include <utility>

#include "base/random.hpp"

namespace raks::engine {

PlayOrder::PlayOrder(std::size_t count, const PlayOrderOptions& options)
    : options_(options), order_(count) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    mix();
}

// Fisher and Yates, with numbers of this round.
void PlayOrder::mix() {
    if (!options_.shuffle_seed || order_.size() < 2) {
        return;
    }
    const CounterRandom random(*options_.shuffle_seed, rounds_);
    const std::size_t last = order_.back();
    for (std::size_t i = order_.size() - 1; i > 0; --i) {
        std::swap(order_[i], order_[random.below(i, i + 1)]);
    }
    if (rounds_ > 0 && order_.front() == last) {
        std::swap(order_.front(), order_.back());
    }
}

std::optional<std::size_t> PlayOrder::current() const noexcept {
    return at_ < order_.size() ? std::optional(order_[at_]) : std::nullopt;
}

bool PlayOrder::has_next() const noexcept {
    return at_ + 1 < order_.size() || (options_.repeats && !order_.empty());
}

std::optional<std::size_t> PlayOrder::next() const noexcept {
    if (at_ + 1 < order_.size()) {
        return order_[at_ + 1];
    }
    const bool is_known = options_.repeats && !options_.shuffle_seed && at_ > 0;
    return is_known && at_ < order_.size() ? std::optional(order_.front()) : std::nullopt;
}

void PlayOrder::go_on() {
    if (at_ < order_.size()) {
        ++at_;
    }
    if (at_ == order_.size() && options_.repeats) {
        ++rounds_;
        mix();
        at_ = 0;
    }
}

void PlayOrder::go_back() {
    if (at_ > 0) {
        --at_;
    } else if (options_.repeats && !order_.empty()) {
        at_ = order_.size() - 1;
    }
}

// Also where the files are mixed: who adds one wants to hear it after the others.
void PlayOrder::append(std::size_t first, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        order_.push_back(first + i);
    }
}

void PlayOrder::drop_current() {
    if (at_ >= order_.size()) {
        return;
    }
    order_.erase(order_.begin() + static_cast<std::ptrdiff_t>(at_));
    // Its successor stands in its place now, unless it was the last.
    if (at_ == order_.size() && options_.repeats) {
        at_ = 0;
    }
}

void PlayOrder::drop_next() {
    if (at_ + 1 < order_.size()) {
        order_.erase(order_.begin() + static_cast<std::ptrdiff_t>(at_) + 1);
    } else if (at_ > 0 && at_ < order_.size()) {
        order_.erase(order_.begin());
        --at_;
    }
}

}  // namespace raks::engine
