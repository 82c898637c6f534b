#pragma once

#include <cstddef>
#include <cstdint>

namespace raks::render {

inline constexpr std::size_t kMostModelBytes = std::size_t{900} << 20U;  ///< with its file

/// How much may be allocated for one model, whatever it says.
class ImportBudget {
 public:
    explicit ImportBudget(std::size_t bytes) : left_(bytes) {}
    /// Takes so many elements of so many bytes. False: there are not so many left.
    [[nodiscard]] bool claim(std::uint64_t count, std::size_t size) noexcept {
        if (size != 0 && count > left_ / size) {
            return false;
        }
        left_ -= static_cast<std::size_t>(count) * size;
        return true;
    }
    /// What was claimed and is freed again.
    void give_back(std::size_t count, std::size_t size) noexcept { left_ += count * size; }
    [[nodiscard]] std::size_t left() const noexcept { return left_; }

 private:
    std::size_t left_;
};

}  // namespace raks::render
