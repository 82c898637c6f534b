#include "render/avatar/surface_images.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <utility>

namespace raks::render {
namespace {

/// glibc keeps what is freed for itself where anything lies behind it: 90 MB of one model.
void give_freed_memory_back() noexcept {
#ifdef __GLIBC__
    malloc_trim(0);  // NOLINT(concurrency-mt-unsafe): it takes the allocator's own locks
#endif
}

}  // namespace

SurfaceImages::SurfaceImages(std::vector<Image> images, std::function<std::vector<Image>()> again)
    : again_(std::move(again)),
      images_(std::make_shared<const std::vector<Image>>(std::move(images))) {}

SurfaceImages::Images SurfaceImages::get() {
    const std::scoped_lock lock(mutex_);
    if (images_ == nullptr) {
        images_ = held_.lock();
    }
    if (images_ == nullptr) {
        images_ = std::make_shared<const std::vector<Image>>(again_());
    }
    return images_;
}

void SurfaceImages::let_go() {
    const std::scoped_lock lock(mutex_);
    if (again_ != nullptr && images_ != nullptr) {
        held_ = images_;
        images_.reset();
        if (held_.expired()) {
            give_freed_memory_back();
        }
    }
}

}  // namespace raks::render
