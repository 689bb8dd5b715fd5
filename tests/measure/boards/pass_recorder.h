#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace mfar::boards {

/// One draw or dispatch.
struct PassWork {
    std::string shader;   ///< of the compute or the fragment shader, as gles_shaders/ names it
    std::string defines;  ///< "#define LEARNED", or empty
    std::int64_t invocations = 0;  ///< of the compute or the fragment shader
    std::int64_t vertices = 0;
    std::int64_t bytesRead = 0;         ///< of what it reads, each byte once
    std::int64_t bytesWritten = 0;      ///< of what it writes, each byte once
    std::map<std::string, int> params;  ///< integers of the block Params
};

/// Everything that this thread's context is given to do while an object of this class lives. The
/// linker puts this before the GL functions that start work (--wrap), so that the
/// product's own calls are counted, unchanged. One at a time. Waits for the GPU wherever a list
/// decides how much there is to do.
class PassRecorder {
public:
    PassRecorder();
    PassRecorder(const PassRecorder&) = delete;
    PassRecorder& operator=(const PassRecorder&) = delete;
    ~PassRecorder();

    [[nodiscard]] const std::vector<PassWork>& passes() const { return passes_; }
    void add(PassWork work) { passes_.push_back(std::move(work)); }

private:
    std::vector<PassWork> passes_;
};

[[nodiscard]] nlohmann::json jsonOf(const PassWork& work);

}  // namespace mfar::boards
