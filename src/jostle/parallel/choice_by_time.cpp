#include "jostle/parallel/choice_by_time.hpp"

#include <algorithm>

namespace jostle {

namespace {

constexpr int max_patience = 200;
constexpr double worth_changing = 0.9;  ///< the other number's time over the present one's, at most
constexpr double hopeless = 1.3;        ///< a trial ends where its first step takes this much longer
constexpr double disturbed = 1.5;       ///< steps that have become longer by this much call for a trial

template <std::size_t size>
double median(std::array<double, size> times) {
    std::nth_element(times.begin(), times.begin() + size / 2, times.end());
    return times[size / 2];
}

}  // namespace

int ChoiceByTime::next(int most) {
    if (most != most_) {
        const int count = count_ == most_ ? most : std::min(count_, most);  // all that are worth it, however many
        if (count != count_) timed_ = 0;
        count_ = count;
        most_ = most;
    }
    on_trial_ = std::min(on_trial_, most);
    if (on_trial_ == 0 && most > 1 && timed_ >= times_.size()) begin_trial();
    return on_trial_ > 0 ? on_trial_ : count_;
}

void ChoiceByTime::took(double seconds) {
    if (on_trial_ == 0) {
        times_[timed_++ % times_.size()] = seconds;
        return;
    }
    trial_[tried_++] = seconds;
    if (seconds > hopeless * usual())
        end_trial(false);
    else if (tried_ == trial_.size())
        end_trial(median(trial_) < worth_changing * usual());
}

/// Where it is time for one.
void ChoiceByTime::begin_trial() {
    const auto steps = static_cast<int>(timed_);
    const bool longer = usual_at_trial_ > 0.0 && usual() > disturbed * usual_at_trial_;
    if (!longer && steps < patience_) return;
    if (count_ == 1) fewer_ = false;
    if (count_ == most_) fewer_ = true;
    on_trial_ = fewer_ ? count_ / 2 : std::min(2 * count_, most_);
}

void ChoiceByTime::end_trial(bool faster) {
    if (faster) {
        count_ = on_trial_;
        patience_ = least_patience;
        times_.fill(median(trial_));
    } else {
        patience_ = std::min(2 * patience_, max_patience);
        fewer_ = !fewer_;
    }
    usual_at_trial_ = usual();
    on_trial_ = 0;
    timed_ = tried_ = 0;
}

double ChoiceByTime::usual() const {
    return median(times_);
}

}  // namespace jostle
