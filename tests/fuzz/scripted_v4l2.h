#pragma once

#include "hal/device/v4l2_device.h"

#include <cstdint>
#include <set>
#include <span>
#include <vector>

namespace mfar::test {

/// A driver whose answers are bytes of a script, as far as the kernel lets a driver choose: it
/// gives an error or fills the structure of a call, but neither moves the caller's pointers nor
/// gives away descriptors that are not new. Each call takes a byte first: 0 to 7 are errors; with 8
/// to 127 the answer is the one a sound camera would give, with more the script fills it. Once the
/// script is at its end, the answers are sound.
class ScriptedV4l2 final : public V4l2Api {
public:
    explicit ScriptedV4l2(std::span<const std::uint8_t> script) : script_(script) {}

    [[nodiscard]] std::vector<std::string> nodes() override { return {"/dev/video0"}; }
    [[nodiscard]] int open(const char* path) override;
    int ioctl(int fd, unsigned long request, void* argument) override;
    [[nodiscard]] void* map(int fd, std::size_t length, std::int64_t offset) override;

private:
    std::uint8_t next();
    void fill(void* to, std::size_t bytes);
    [[nodiscard]] int sound(unsigned long request, void* argument);
    [[nodiscard]] int hostile(unsigned long request, void* argument);

    std::span<const std::uint8_t> script_;
    std::uint32_t filled_ = 0;
};

}  // namespace mfar::test
