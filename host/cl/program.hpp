/// A built OpenCL program.
#pragma once

#include "host/cl/kernel.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace macula::compute {

struct ProgramState;

class Program {
  public:
    explicit Program(std::shared_ptr<ProgramState> state);

    /// A fresh kernel object for the function `entry`. Throws Error that lists the program's
    /// kernels when there is none of that name.
    Kernel kernel(const std::string& entry) const;

    /// The compiler's messages of a build that succeeded (warnings), often empty.
    std::string log() const;

    /// What Device::load() takes; empty when the driver gives none.
    std::vector<std::byte> binary() const;

  private:
    std::shared_ptr<ProgramState> state_;
};

} // namespace macula::compute
