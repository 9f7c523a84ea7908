// Not a test of jostle but of the thread sanitizer: a loop that breaks the rule of parallel_for, as every body adds to
// one sum. `check` demands that the sanitizer finds the race, and that it finds none when the program is called with
// "apart".

#include <cstdio>
#include <string_view>
#include <vector>

#include "jostle/parallel/parallel_for.hpp"

int main(int count, char** words) {
    using namespace jostle;
    parallel::set_thread_count(2);
    std::vector<double> value(100 * parallel::serial_limit, 1.0);
    parallel_for(value.size(), [&](std::size_t k) { value[k] *= 2.0; });
    double sum = parallel_sum<double>(value.size(), [&](std::size_t k) { return value[k]; });
    if (count < 2 || std::string_view(words[1]) != "apart")
        parallel_for(value.size(), [&](std::size_t k) { sum += value[k]; });
    std::printf("%g\n", sum);
}
