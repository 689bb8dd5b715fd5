#pragma once

#include "hal/device/v4l2_device.h"

#include <cstdint>
#include <set>
#include <span>
#include <vector>

namespace mfar::test {

/// A simulated driver. The bytes of a script determine its answers, within the kernel's rules for
/// drivers: it returns an error or fills the structure of a call, it does not change the caller's
/// pointers, and it returns only new descriptors. At each call, the next byte selects the answer:
/// 0 to 7 are errors, 8 to 127 the answer of a correct camera; for larger values, the following
/// bytes fill the structure. After the end of the script, all answers are correct.
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
