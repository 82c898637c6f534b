#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "render/model/image.hpp"

namespace raks::render {

/// The images of a surface, unpacked. A driver has a copy of its own, with which they would take
/// twice their memory: whoever has handed them over lets them go. Those that can be unpacked again
/// are then freed, as soon as nobody else holds them. Threads: any. Real-time: no (a lock, and
/// unpacking may take a second).
///
///     SurfaceImages images(unpack(), unpack);
///     upload(*images.get());
///     images.let_go();         // frees them
///     upload(*images.get());   // unpacks again
class SurfaceImages {
 public:
    using Images = std::shared_ptr<const std::vector<Image>>;

    /// `again`: unpacks the same images once more; null: they cannot be had again, and stay.
    explicit SurfaceImages(std::vector<Image> images,
                           std::function<std::vector<Image>()> again = nullptr);

    /// The images, never null.
    [[nodiscard]] Images get();
    /// Frees them where they can be unpacked again and nobody holds them.
    void let_go();

 private:
    std::mutex mutex_;
    std::function<std::vector<Image>()> again_;
    Images images_;                                 // null: let go
    std::weak_ptr<const std::vector<Image>> held_;  // of others, where they were let go
};

}  // namespace raks::render
