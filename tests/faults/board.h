#pragma once

#include "tests/faults/plan.h"

#include <sys/resource.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mfar::faults {

/// What surrounds mfard: two pretended cameras, a pipe whose other end is the screen, a file of
/// configuration, a disk; in the current folder. Faults act on it.
class Board {
public:
    static Board& get();

    /// Makes the files.
    void setUp(const Plan& plan);
    void begin(const Fault& fault);
    void end(const Fault& fault);

    [[nodiscard]] bool readerStalls() const { return readerStalls_ > 0; }
    [[nodiscard]] bool diskIsFull() const { return diskFull_ > 0; }
    /// The trigger's line is as it is without a pulse, or there is none.
    [[nodiscard]] bool lineRests() const;
    [[nodiscard]] bool diskHangs() const { return diskHangs_ > 0; }

    static constexpr const char* kPipe = "screen.y4m";
    static constexpr const char* kSocket = "control";
    static constexpr const char* kGpu = "gpu";  ///< what is wrong with it, see faulty_gl.cpp
    static constexpr int kGain = 100;           ///< of both cameras, as configured
    static constexpr const char* kRecording = "disk-";  ///< and what follows

private:
    void writeDevice(Where which) const;
    void disturb(const Fault& fault, int by);
    void changeConfiguration(const Fault& fault);
    void limitDescriptors(int free);

    std::string configuration_;
    bool hasTrigger_ = false;
    std::vector<const Fault*> active_;
    std::vector<int> clients_;
    std::optional<rlimit> descriptors_;  ///< before they were limited
    int readerStalls_ = 0, diskFull_ = 0, diskHangs_ = 0;
};

/// Reads the pipe and tells the judge what is shown. Never returns.
void runScreen();

}  // namespace mfar::faults
