#include "motion/repertoire.hpp"

#include <utility>

#include "base/assert.hpp"

namespace raks::motion {

Repertoire::Repertoire(DanceId first,
                       std::shared_ptr<const DanceLibrary> library,
                       Fallback otherwise)
    : first_(first), fallback_(otherwise) {
    add(first, std::move(library));
}

std::shared_ptr<const Repertoire> Repertoire::of_one(std::shared_ptr<const DanceLibrary> library) {
    return library ? std::make_shared<const Repertoire>(DanceId{0}, std::move(library)) : nullptr;
}

void Repertoire::add(DanceId id, std::shared_ptr<const DanceLibrary> library) {
    const auto slot = index_of(id);
    RAKS_ASSERT(library != nullptr && slot < owned_.size() && owned_[slot] == nullptr);
    owned_[slot] = std::move(library);
    // release: pairs with the acquire in of(); the dancer sees a dance that is whole.
    dances_[slot].store(owned_[slot].get(), std::memory_order_release);
}

const DanceLibrary* Repertoire::of(DanceId id) const noexcept RAKS_NONBLOCKING {
    return index_of(id) < dances_.size() ? dances_[index_of(id)].load(std::memory_order_acquire)
                                         : nullptr;
}

}  // namespace raks::motion
