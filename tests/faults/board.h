#pragma once

#include "tests/faults/plan.h"

#include <sys/resource.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mfar::faults {

/// The environment of mfard, in the current folder: two simulated cameras, a pipe to a simulated
/// screen, a configuration file, and a disk. Faults act on them.
class Board {
public:
    static Board& get();

    void setUp(const Plan& plan);
    void begin(const Fault& fault);
    void end(const Fault& fault);

    [[nodiscard]] bool readerStalls() const { return readerStalls_ > 0; }
    [[nodiscard]] bool diskIsFull() const { return diskFull_ > 0; }
    /// True if the trigger line is inactive or absent.
    [[nodiscard]] bool lineRests() const;
    [[nodiscard]] bool diskHangs() const { return diskHangs_ > 0; }

    static constexpr const char* kPipe = "screen.y4m";
    static constexpr const char* kSocket = "control";
    static constexpr const char* kGpu = "gpu";  ///< file with the faults of faulty_gl.cpp
    static constexpr int kGain = 100;
    static constexpr const char* kRecording = "disk-";

private:
    void writeDevice(Where which) const;
    void disturb(const Fault& fault, int by);
    void changeConfiguration(const Fault& fault);
    void limitDescriptors(int free);

    std::string configuration_;
    bool hasTrigger_ = false;
    std::vector<const Fault*> active_;
    std::vector<int> clients_;
    std::optional<rlimit> descriptors_;  ///< limit of descriptors before a fault lowered it
    int readerStalls_ = 0, diskFull_ = 0, diskHangs_ = 0;
};

void runScreen();

}  // namespace mfar::faults
