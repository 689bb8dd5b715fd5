#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace mfar::boards {

/// One draw or dispatch. A byte that is accessed several times counts once.
struct PassWork {
    std::string shader;  ///< name of the compute or fragment shader, as in gles_shaders/
    std::string defines;
    std::int64_t invocations = 0;
    std::int64_t vertices = 0;
    std::int64_t bytesRead = 0;
    std::int64_t bytesWritten = 0;
    std::map<std::string, int> params;  ///< integers of the uniform block Params
};

/// Records all work that this thread's GL context receives while the object exists. The linker's
/// option --wrap redirects the GL functions that start work. Only one object may exist at a time.
/// If a list on the GPU determines the amount of work, the recorder waits for the GPU and reads the
/// list's length.
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
