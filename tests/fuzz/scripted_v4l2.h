#pragma once

#include "hal/device/v4l2_device.h"

#include <cstdint>
#include <set>
#include <span>
#include <vector>

namespace mfar::test {

/// A driver whose answers are bytes of a script, within the kernel's rules for drivers. It returns
/// an error or fills the structure of a call. It does not change the caller's pointers, and it
/// returns only new descriptors. The first byte of each call selects the answer: 0 to 7 are errors;
/// 8 to 127 are answers of a correct camera; for larger values the script fills the structure.
/// After the end of the script all answers are correct.
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
