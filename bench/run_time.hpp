// What one run took, by three clocks.
#pragma once

#include <chrono>
#include <ctime>

namespace macula::bench {

// Seconds. `cpu` is the process's own time over all threads: on a machine that others use, too, it
// is what stays comparable. `device` is 0 where there is none or the driver's profiling is a dummy.
struct RunTime {
    double wall = 0.0, cpu = 0.0, device = 0.0;
};

class Stopwatch {
  public:
    RunTime elapsed() const {
        const double wall =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count();
        return {wall, cpu_now() - cpu_, 0.0};
    }

  private:
    static double cpu_now() {
        std::timespec t{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
        return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
    }

    std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
    double cpu_ = cpu_now();
};

} // namespace macula::bench
