#pragma once

#include "hal/gl_context.h"
#include "pipeline/enlarge/filter_bank.h"
#include "tests/measure/eval/match_classes.h"
#include "tests/measure/eval/shot.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace mfar::eval {

/// A method that enlarges a video frame to the still's resolution. Pictures are CV_8UC3, B G R.
class SuperResMethod {
public:
    virtual ~SuperResMethod() = default;

    /// `second`: second still, for methods that use two; null if there is none.
    virtual void setStills(const Shot& newest, const Shot* second) = 0;
    struct Result {
        cv::Mat picture;
        double ms = 0;  ///< wall time of a second run on the same frame; the first warms up
    };
    [[nodiscard]] virtual Result run(const Shot& frame) = 0;
};

class StillMatcher {
public:
    virtual ~StillMatcher() = default;

    virtual void setStill(const Shot& still) = 0;
    [[nodiscard]] virtual StillMatch run(const Shot& frame) = 0;
};

[[nodiscard]] const std::vector<std::string>& superResMethodNames();
/// True if measuring this method without a still is useless, because it then has no result, or the
/// result is a plain enlargement or equal to that of `detail`.
[[nodiscard]] bool needsStill(const std::string& method);

/// Makes methods. For the first of mfar's own methods, the factory creates a GL context, which
/// stays current. create() throws std::invalid_argument for an unknown name.
class SuperResFactory {
public:
    explicit SuperResFactory(double alpha) : alpha_(alpha) {}
    /// Sets the filters of mfar's own methods; null: shipped filters.
    void setFilters(std::shared_ptr<const FilterBank> filters) { filters_ = std::move(filters); }
    void requireContext();
    [[nodiscard]] std::unique_ptr<SuperResMethod> create(const std::string& name,
                                                         const StereoRig& rig);
    /// Makes a peer from a model of OpenCV's dnn_superres. Throws EvalError as dnnEnlarger() does.
    [[nodiscard]] static std::unique_ptr<SuperResMethod>
    createModel(const std::filesystem::path& file, const StereoRig& rig);
    [[nodiscard]] std::unique_ptr<StillMatcher> createMatcher(const StereoRig& rig);

private:
    std::shared_ptr<const FilterBank> filters_;
    double alpha_;
    std::unique_ptr<GlContext> context_;
};

}  // namespace mfar::eval
