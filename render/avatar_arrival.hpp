#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "base/expected.hpp"
#include "render/avatar/avatar.hpp"
#include "render/avatar_painter.hpp"
#include "render/surface_upload.hpp"

namespace raks::render {

/// An avatar on its way into the driver's memory, in pieces: none keeps a picture waiting for long.
/// Threads: the context's.
class AvatarArrival {
 public:
    /// The programs must live as long as what it makes.
    AvatarArrival(std::shared_ptr<const Avatar> avatar,
                  const BodyPrograms& body_programs,
                  SurfacePrograms& surface_programs);

    /// Uploads the next piece. True: there are no more. Errors: a shader that the driver refuses.
    [[nodiscard]] Expected<bool> next();

    /// Draws what makes the driver finish another shader, once all is uploaded: one step a picture,
    /// into a target that is cleared behind it.
    void warm_up();

    /// Nothing is left to be drawn for the first time.
    [[nodiscard]] bool is_warm() const noexcept { return is_warm_; }

    /// Who paints it. Precondition: next() has returned true.
    [[nodiscard]] std::unique_ptr<AvatarPainter> painter() && noexcept {
        return std::move(painter_);
    }

 private:
    std::shared_ptr<const Avatar> avatar_;
    std::unique_ptr<AvatarPainter> painter_;
    std::optional<SurfaceUpload> upload_;  // none: all is there
    std::size_t warmed_up_ = 0;            // steps
    bool is_warm_ = false;
};

}  // namespace raks::render
