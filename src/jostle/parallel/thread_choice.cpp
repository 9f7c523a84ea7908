#include "jostle/parallel/thread_choice.hpp"

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

void ThreadChoice::begin_step(std::size_t rods) {
    if (!parallel::thread_count_is_free()) return;
    parallel::suit_thread_count(choice_.next(parallel::worthwhile_thread_count(rods)));
    began_ = std::chrono::steady_clock::now();
}

void ThreadChoice::end_step() {
    if (!parallel::thread_count_is_free() || !choice_.has_begun()) return;
    choice_.took(std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count());
}

}  // namespace jostle
