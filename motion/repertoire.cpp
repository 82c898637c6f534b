#include "motion/repertoire.hpp"

#include <utility>

#include "base/assert.hpp"

namespace raks::motion {

Repertoire::Repertoire(Genre first,
                       std::shared_ptr<const DanceLibrary> library,
                       Otherwise otherwise)
    : first_(first), otherwise_(otherwise) {
    add(first, std::move(library));
}

std::shared_ptr<const Repertoire> Repertoire::of_one(std::shared_ptr<const DanceLibrary> library) {
    return library ? std::make_shared<const Repertoire>(Genre::salsa, std::move(library)) : nullptr;
}

void Repertoire::add(Genre genre, std::shared_ptr<const DanceLibrary> library) {
    const auto slot = static_cast<std::size_t>(genre);
    RAKS_ASSERT(library != nullptr && owned_[slot] == nullptr);
    owned_[slot] = std::move(library);
    // release: pairs with the acquire in of(); the dancer sees a dance that is whole.
    dances_[slot].store(owned_[slot].get(), std::memory_order_release);
}

const DanceLibrary* Repertoire::of(Genre genre) const noexcept {
    return dances_[static_cast<std::size_t>(genre)].load(std::memory_order_acquire);
}

}  // namespace raks::motion
