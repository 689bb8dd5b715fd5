#include "hal/frame.h"

#include "base/image_layout.h"

namespace mfar {

FramePool::FramePool(Size size, PixelFormat format, int count)
    : size_(size), format_(format), shared_(std::make_shared<Shared>()) {
    const std::size_t bytes = packedBytes(format, size);
    shared_->free.reserve(count);
    for (int i = 0; i < count; ++i) {
        shared_->buffers.emplace_back(bytes);
        shared_->free.push_back(i);
    }
}

std::optional<FramePool::Slot> FramePool::acquire(std::chrono::milliseconds timeout) {
    std::unique_lock lock(shared_->mutex);
    if (!shared_->returned.wait_for(lock, timeout, [&] { return !shared_->free.empty(); }))
        return std::nullopt;
    const int index = shared_->free.back();
    shared_->free.pop_back();
    return Slot{shared_->buffers[index].data(),
                static_cast<std::size_t>(size_.width) * bytesPerPixel(format_), index};
}

Frame FramePool::lend(const Slot& slot, Timestamp time) const {
    return lend(slot, packedView(slot.data, size_, format_), time);
}

Frame FramePool::lend(const Slot& slot, const ImageView& view, Timestamp time) const {
    return Frame(view, time, [shared = shared_, index = slot.index] {
        {
            std::lock_guard lock(shared->mutex);
            shared->free.push_back(index);
        }
        shared->returned.notify_one();
    });
}

void FramePool::giveBack(const Slot& slot) const {
    {
        std::lock_guard lock(shared_->mutex);
        shared_->free.push_back(slot.index);
    }
    shared_->returned.notify_one();
}

}  // namespace mfar
