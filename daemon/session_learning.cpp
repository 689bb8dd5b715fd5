#include "daemon/budgets.h"
#include "daemon/filter_learning.h"
#include "daemon/session.h"

#include <stdexcept>
#include <utility>

namespace mfar {

void Session::setLearning(bool wanted) {
    if (wanted == (learning_ != nullptr)) return;
    endLearning();
    drawing_->pipeline.setMatchListener(nullptr);
    drawing_->pipeline.setFilters(filters_ = nullptr);
    learning_.reset();
    if (wanted) {
        learning_ = std::make_unique<FilterLearning>(FilterLearningOptions{
            learnedFiltersFile(sensors_),
            sensors_,
            rig_.handOver() == HandOver::Lossless,
            rig_.geometry(),
            {&stats_.heartbeats(), "filter learning", budget::kLearning, ThreadRole::Helper}});
        drawing_->pipeline.setMatchListener(learning_.get());
        takeFilters();
    }
    tellLearning();
}

void Session::takeFilters() {
    auto others = learning_->takeFilters();
    if (others) drawing_->pipeline.setFilters(filters_ = std::move(others));
}

void Session::endLearning() {
    if (!learning_) return;
    learning_->stop();
    tellLearning();
}

void Session::resetLearning() {
    if (!learning_)
        throw std::runtime_error("mfard does not learn filters, because superres.learn is false");
    learning_->reset();
}

void Session::tellLearning() {
    stats_.learning(learning_ ? std::optional(learning_->counts()) : std::nullopt);
    if (!learning_) return;
    for (std::string& text : learning_->takeWarnings())
        stats_.warn(std::move(text), {message::kLearning});
}

}  // namespace mfar
